"""Rocon URIs, two at a time: read as a second reading of the grammar says, and compared soundly."""
from __future__ import annotations

import json
import pickle
import re
import urllib.parse

from fuzz.damage import ROOT, damaged, files
from fuzz.name_pattern import GOOD as PATTERNS

from rocon_uri import (
    PatternTooComplex, Relation, RoconURIValueError, Vocabulary, explain, is_compatible,
    name_pattern, parse, relation)
from rocon_uri.grammar import VOCABULARY_FIELDS, is_rocon_app
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.vocabulary import complete

CASES = json.loads((ROOT / 'test/conformance/rocon_uri.json').read_text())
GOOD = [case['uri'] for kind in ('parse', 'reject') for case in CASES[kind]]
GOOD += re.findall(r'rocon:\S+', '\n'.join(
    path.read_text() for path in files('*.txt', '*.rapp', '*.interactions')))
TOKENS = ['rocon:', '/', '//', '|', '*', '#', '?', '%', '%7C', '%2F', '%20', '%C3%A9', '%ff',
          '[0-9]', '+', '(a|b)', '{2}', 'pr2', 'pc', 'robot', 'turtlebot2', 'nobody', 'bob',
          'bob_*', 'ros', 'noetic', 'linux', 'focal', 'ubuntu', 'rocon_apps/teleop', ' ', '\n',
          '\0', '\x85', '\u2028', '\xe9', '\ud800', '\U0001f916', 'a' * 256]
# few values, and groups that have them: so that two URIs have something in common
VALUES = {
    'hardware_platform': ['*', '*', 'robot', 'pr2', 'turtlebot2', 'pc', 'mobile_device', 'note3'],
    'application_framework': ['*', '*', 'ros', 'noetic', 'indigo', 'opros'],
    'operating_system': ['*', '*', 'linux', 'ubuntu', 'focal', 'bionic', 'windows']}
KNOWN = complete()
FIELDS = ('hardware_platform', 'name', 'application_framework', 'operating_system')
MIRRORED = {Relation.SUBSET: Relation.SUPERSET, Relation.SUPERSET: Relation.SUBSET}


def make(rng):
    return tuple(damaged(rng, rng.choice(GOOD), TOKENS) if rng.random() < 0.4 else made_up(rng)
                 for _ in range(2))


def made_up(rng):
    """A URI of registered values and good patterns, as a rule."""
    fields = ['|'.join(rng.choice(VALUES[field]) for _ in range(rng.choice((1, 1, 1, 2, 3))))
              for field in VOCABULARY_FIELDS]
    fields.insert(1, rng.choice(PATTERNS))
    text = 'rocon:%s/%s%s' % (rng.choice(('', '', '', '//', '//north', '//pc')),
                              '/'.join(fields[:rng.choice((1, 2, 3, 4, 4, 4))]),
                              rng.choice(('', '', '#teleop', '#rocon_apps/teleop')))
    return damaged(rng, text, TOKENS) if rng.random() < 0.2 else text


def check(pair):
    a, b = map(check_one, pair)
    answers = [answer(is_compatible, *pair), answer(is_compatible, *pair[::-1])]
    assert answers[0] == answers[1]
    if a is None or b is None:
        return
    meets, related = answers[0], answer(relation, a, b)
    assert answer(relation, b, a) == MIRRORED.get(related, related)
    explained = answer(explain, a, b)
    if PatternTooComplex in (meets, related, explained):
        return
    assert meets is (related is not Relation.DISJOINT) is bool(explained) is not a.isdisjoint(b)
    assert a.issubset(b) is b.issuperset(a) is (related in (Relation.SUBSET, Relation.EQUAL))
    assert related is Relation.EQUAL or (a.sets != b.sets and a != b)
    assert all(line.isprintable() for line in str(explained).splitlines())


def answer(function, *arguments):
    try:
        return function(*arguments)
    except PatternTooComplex:
        return PatternTooComplex
    except RoconURIValueError:
        return RoconURIValueError


def check_one(text):
    """The URI of a text, or None if it rightly has none."""
    uri = read(text, strict=False)
    strict = read(text, strict=True)
    if uri is None:
        return None
    assert strict is None or (strict == uri) is not uri.read_with_one_slash
    for same in (parse(str(uri)), parse(uri.short), parse(uri.to_rfc3986()),
                 parse(str(uri), strict=True), parse(str(uri), Vocabulary.open()),
                 pickle.loads(pickle.dumps(uri)), uri.replace(), parse(uri, Vocabulary.open())):
        assert same == uri and hash(same) == hash(uri)
        assert str(same) == str(uri)
    assert len(uri.short) <= len(str(uri))
    assert re.fullmatch("(?:[A-Za-z0-9._~!$'()*+,;=:@/?&-]|%[0-9A-F]{2})*(?:#[a-zA-Z0-9_/]+)?",
                        uri.to_rfc3986())
    assert relation(uri, uri) is Relation.EQUAL
    return uri


def read(text, strict):
    expected = second_reading(text, strict)
    try:
        uri = parse(text, strict=strict)
    except RoconURIValueError as error:
        assert expected is None
        check_error(error, text)
        return None
    values = [uri.hardware_platform.list, uri.name.string, uri.application_framework.list,
              uri.operating_system.list]
    assert (uri.concert_name, values, uri.rocon_app, uri.read_with_one_slash) == expected
    return uri


def check_error(error, text):
    start, end = error.span
    assert error.uri == text and 0 <= start <= end <= len(text)
    assert error.field in ('uri', 'concert_name', 'rocon_app') + FIELDS
    assert len(error.suggestions) <= 3
    assert str(error).isprintable() and len(str(error)) < 3000
    assert all(line.isprintable() and len(line) < 3000 for line in error.pretty().splitlines())
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


def second_reading(text, strict):
    """(concert, [platforms, name, frameworks, systems], app, read with one slash?), or None."""
    scheme, colon, rest = text.partition(':')
    if scheme.lower() != 'rocon' or not colon or len(text) > 65536:
        return None
    if any(c.isspace() or c < ' ' or '\x7f' <= c <= '\x9f' for c in text):
        return None
    rest, _, app = rest.partition('#')
    concert = ''
    if rest.startswith('//'):
        concert, _, rest = rest[2:].partition('/')
    elif rest.startswith('/'):
        rest = rest[1:]
    elif rest and strict:
        return None
    fields = rest.split('/')
    fields += [''] * (4 - len(fields))
    one_slash = (not strict and concert != '' and fields[3:] == [''] and are_platforms(concert)
                 and not are_platforms(fields[0]))
    if one_slash:
        concert, fields = '', [concert] + fields
    if fields[4:] not in ([], ['']) or '?' in concert + fields[0] + fields[2] + fields[3] + app:
        return None
    try:
        concert, app, *fields = [decoded(part) for part in [concert, app] + fields[:4]]
        platforms, frameworks, systems = map(values, VOCABULARY_FIELDS, fields[:1] + fields[2:])
        name_pattern.read(fields[1] or '*')
    except ValueError:
        return None
    if concert and not (is_legal_base_name(concert) and len(concert) <= 255):
        return None
    if app and not is_rocon_app(app):
        return None
    return concert, [platforms, fields[1] or '*', frameworks, systems], app, one_slash


def are_platforms(raw):
    try:
        return all(value in KNOWN.field('hardware_platform')
                   for value in decoded(raw).split('|'))
    except ValueError:
        return False


def decoded(raw):
    if re.search('%(?![0-9A-Fa-f]{2})', raw) or re.search('%2f', raw, re.IGNORECASE):
        raise ValueError(raw)
    return urllib.parse.unquote_to_bytes(raw).decode() if '%' in raw else raw


def values(field, text):
    alternatives = (text or '*').split('|')
    if len(alternatives) > 256 or not all(
            value == '*' or value in KNOWN.field(field) for value in alternatives):
        raise ValueError(text)
    return ['*'] if '*' in alternatives else sorted(set(alternatives), key=alternatives.index)
