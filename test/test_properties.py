"""Laws of rocon URIs, on generated ones and on any text at all."""
from __future__ import annotations

import copy
import gc
import itertools
import pickle
import re
import sys

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rocon_uri import (Relation, RoconURI, RoconURIValueError, Vocabulary, explain, is_compatible,
                       parse, relation)
from rocon_uri.grammar import VOCABULARY_FIELDS
from rocon_uri.vocabulary import complete

quick = settings(deadline=None)
known = complete()

# URIs of the complete vocabulary

base_names = st.from_regex('[A-Za-z][A-Za-z0-9_]{0,8}', fullmatch=True)
concerts = st.one_of(st.just(''), base_names, st.sampled_from(['pr2', 'pc', 'robot', 'ros']))
names = st.one_of(st.just('*'), base_names, st.sampled_from([
    'bob_*', '*_left', 'r*_*', 'bob[0-9]+', '(bob|alice)_\\d{2}', 'bob?[0-9]', 'a(|b)c', '.*',
    '^b[^a-f_]{2,}$', '(?:ab){0,3}\\D+']))
apps = st.one_of(st.just(''), base_names, st.tuples(base_names, base_names).map('/'.join))


def alternatives(field):
    return st.lists(st.sampled_from(['*', *known.field(field)]), min_size=1, max_size=4)


platforms, frameworks, systems = map(alternatives, VOCABULARY_FIELDS)
uris = st.builds(RoconURI.from_fields, concerts, platforms, names, frameworks, systems, apps)


@st.composite
def texts(draw):
    """URIs as people write them: what can be left out may be, what can be escaped may be."""
    def written(text):
        if draw(st.booleans()):
            return text
        positions = draw(st.sets(st.integers(0, max(0, len(text) - 1)), max_size=3))
        return ''.join('%%%02x' % ord(c) if index in positions and c != '/' else c
                       for index, c in enumerate(text))
    # what is read with one slash is not the matter here
    concert = draw(concerts.filter(lambda name: name not in known.field('hardware_platform')))
    fields = ['|'.join(draw(platforms)), draw(names), '|'.join(draw(frameworks)),
              '|'.join(draw(systems)), '']
    fields = [draw(st.sampled_from([written(field), '', '*'])) if field else '' for field in fields]
    fields = fields[:draw(st.integers(0, 5))]
    app = draw(apps)
    return ''.join([draw(st.sampled_from(['rocon:', 'ROCON:', 'rOcon:'])),
                    '//' + written(concert) if concert or fields[:1] == ['']
                    or draw(st.booleans()) else '',
                    '/' + '/'.join(fields) if fields or concert else '',
                    '#' + written(app) if app or draw(st.booleans()) else ''])


@quick
@given(uris)
def test_every_text_of_a_uri_reads_as_that_uri(uri):
    for text in (str(uri), uri.short, uri.to_rfc3986()):
        assert parse(text) == uri
        assert str(parse(text)) == str(uri)
    assert parse(str(uri), strict=True) == uri
    assert len(uri.short) <= len(str(uri))


@quick
@given(texts())
def test_what_people_write_is_read_as_its_canonical_text(text):
    uri = parse(text)
    assert parse(str(uri)) == parse(uri.short) == parse(uri.to_rfc3986()) == uri
    assert not any(parse(same).read_with_one_slash for same in (str(uri), uri.short))


@quick
@given(texts())
def test_a_text_reads_the_same_whatever_was_read_before(text):
    first = parse(text)
    known.uris_read.clear()         # with its fields remembered
    second = parse(text)
    for read in known.fields_read.values():
        read.clear()
    known.uris_read.clear()
    third = parse(text)
    assert first == second == third
    assert str(first) == str(second) == str(third)
    assert (first.read_with_one_slash == second.read_with_one_slash == third.read_with_one_slash)


@quick
@given(uris)
def test_the_web_text_has_only_what_rfc_3986_allows(uri):
    allowed = set("-._~!$&'()*+,;=:@/#%")
    text = uri.to_rfc3986()
    assert [c for c in text if not (c.isascii() and c.isalnum() or c in allowed)] == []
    assert text.count('#') <= 1
    assert not set('<>"\'&') & set(text)


@quick
@given(uris)
def test_fields_make_the_uri_that_they_are_of(uri):
    fields = {name: getattr(uri, name) for name in (
        'concert_name', 'hardware_platform', 'name', 'application_framework', 'operating_system',
        'rocon_app')}
    assert RoconURI.from_fields(**fields) == uri.replace() == uri
    assert RoconURI().replace(**fields) == uri
    as_lists = {name: fields[name].list for name in VOCABULARY_FIELDS}
    assert str(uri.replace(**as_lists)) == str(uri)


@quick
@given(uris)
def test_copies_are_equal(uri):
    for same in (copy.copy(uri), copy.deepcopy(uri), pickle.loads(pickle.dumps(uri)),
                 eval(repr(uri))):
        assert same == uri
        assert hash(same) == hash(uri)
        assert not same != uri


@quick
@given(uris, uris)
def test_equality_is_of_the_sets_of_alternatives(a, b):
    def key(uri):
        return [uri.concert_name, uri.name.string, uri.rocon_app] + [
            frozenset(getattr(uri, field).list) for field in VOCABULARY_FIELDS]
    assert (a == b) is (key(a) == key(b))
    turned = a.replace(**{field: getattr(a, field).list[::-1] * 2 for field in VOCABULARY_FIELDS})
    assert turned == a
    assert hash(turned) == hash(a)


# Sets, by counting them out: a vocabulary so small that all resources of two URIs can be listed.

SMALL = Vocabulary({'hardware_platform': [{'a': ['a1', 'a2']}, 'b'],
                    'application_framework': [{'f': ['f1', 'f2']}],
                    'operating_system': [{'o': ['o1', {'p': ['p1', 'p2']}]}]})
# One name for each way to be admitted by some patterns and refused by the others.
PATTERNS = {'*': '.*', 'bob': 'bob', 'alice': 'alice', 'bob*': 'bob.*', '*7': '.*7', '.+': '.+',
            'bob.*': 'bob.*', 'bob7?': 'bob7?', 'b.*7': 'b.*7', '[^x]*7': '[^x]*7'}


def names_of_patterns():
    candidates = ['alice', *(first + ''.join(more) for length in range(5) for first in 'box'
                             for more in itertools.product('box7', repeat=length))]
    matches = [re.compile(expression).fullmatch for expression in PATTERNS.values()]
    told_apart = {tuple(bool(match(name)) for match in matches): name for name in candidates}
    return {pattern: {name for name in told_apart.values() if match(name)}
            for pattern, match in zip(PATTERNS, matches)}


NAMES = names_of_patterns()
CONCERTS = {'': {'north', 'south', 'others'}, 'north': {'north'}, 'south': {'south'}}


def few(*values):
    return st.lists(st.sampled_from(values), min_size=1, max_size=2)


small_uris = st.builds(
    RoconURI.from_fields, st.sampled_from(sorted(CONCERTS)), few('*', 'a', 'a1', 'a2', 'b'),
    st.sampled_from(sorted(NAMES)), few('*', 'f', 'f1', 'f2'), few('*', 'o', 'o1', 'p', 'p1', 'p2'),
    st.sampled_from(['', 'app']), st.just(SMALL))


def resources(uri):
    """Everything that a URI of the small vocabulary stands for."""
    def values(field):
        found = set(getattr(uri, field).expand())
        return found | {'something_else'} if getattr(uri, field).is_any else found
    return set(itertools.product(CONCERTS[uri.concert_name], NAMES[uri.name.string],
                                 *map(values, VOCABULARY_FIELDS)))


@settings(quick, max_examples=300)
@given(small_uris, small_uris)
def test_relations_are_those_of_the_sets_of_resources(a, b):
    ours, theirs = resources(a), resources(b)
    assert is_compatible(a, b) is not ours.isdisjoint(theirs)
    assert a.isdisjoint(b) is ours.isdisjoint(theirs)
    assert a.issubset(b) is (ours <= theirs)
    assert a.issuperset(b) is (ours >= theirs)
    expected = (Relation.EQUAL if ours == theirs else Relation.SUBSET if ours < theirs
                else Relation.SUPERSET if ours > theirs
                else Relation.OVERLAP if ours & theirs else Relation.DISJOINT)
    assert relation(a, b) is expected
    for field in (*VOCABULARY_FIELDS, 'name'):
        row, = (row for row in explain(a, b).fields if row.field == field)
        assert row.is_compatible is bool(row.shared)
        if field != 'name' and row.shared:
            shared = RoconURI.from_fields(vocabulary=SMALL, **{field: row.shared})
            assert resources(shared) == (
                resources(RoconURI.from_fields(vocabulary=SMALL, **{field: row.a}))
                & resources(RoconURI.from_fields(vocabulary=SMALL, **{field: row.b})))
    assert bool(explain(a, b)) is is_compatible(a, b)


MIRRORED = {Relation.SUBSET: Relation.SUPERSET, Relation.SUPERSET: Relation.SUBSET}


@quick
@given(uris, uris)
def test_relations_agree_with_each_other(a, b):
    lies = relation(a, b)
    assert relation(b, a) is MIRRORED.get(lies, lies)
    assert is_compatible(a, b) is is_compatible(b, a) is (lies is not Relation.DISJOINT)
    assert explain(a, b).is_compatible is explain(b, a).is_compatible is is_compatible(a, b)
    assert a.isdisjoint(b) is b.isdisjoint(a) is (lies is Relation.DISJOINT)
    assert a.issubset(b) is b.issuperset(a) is (lies in (Relation.EQUAL, Relation.SUBSET))
    assert is_compatible(str(a), b.short) is is_compatible(a, b)
    assert relation(a, a) is Relation.EQUAL


@quick
@given(st.lists(small_uris, min_size=3, max_size=3))
def test_a_subset_of_a_subset_is_a_subset(found):
    grown = [found[0]]
    for uri in found[1:]:
        grown.append(grown[-1].replace(concert_name='', **{
            field: getattr(grown[-1], field).list + getattr(uri, field).list
            for field in VOCABULARY_FIELDS}))
    for a, b, c in itertools.permutations(found + grown, 3):
        if a.issubset(b) and b.issubset(c):
            assert a.issubset(c)
    assert grown[0].issubset(grown[1]) and grown[1].issubset(grown[2])


@quick
@given(uris)
def test_any_resource_is_the_largest_set(uri):
    assert uri.issubset('rocon:/')
    assert is_compatible(uri, 'rocon:/')


# Any text at all

anything = st.text(st.characters(blacklist_categories=()), max_size=40)
fragments = st.one_of(anything, st.sampled_from([
    'rocon:', 'rocon:/', 'rocon://', '/', '//', '#', '|', '*', '%', '%7C', '%2F', '%C3', '%B6',
    '%00', 'pr2', 'kobuki', 'turtelbot2', 'north', 'bob', 'ros', 'focal', 'a/b', '[', ']', '(?',
    '(', ')', '+', '{', '}', '{2}', '\\', '\\d', '^', '$', '-', '?', ' ', '\n', '\ud800',
    '\u0130']))
nearly_uris = st.lists(fragments, max_size=12).map(''.join)


@settings(quick, max_examples=200)
@example('rocon:/\ud800')
@example('rocon:/%ED%A0%80')
@example('rocon:/pr2/\ud800%41')
@example('\u212aocon:/')
@given(st.one_of(anything, nearly_uris, nearly_uris.map('rocon:{}'.format),
                 nearly_uris.map('rocon:/pr2/{}'.format)))
def test_any_text_is_read_or_refused(text):
    for vocabulary in (None, Vocabulary.open()):
        for strict in (False, True):
            try:
                uri = parse(text, vocabulary, strict)
            except RoconURIValueError:
                continue
            assert parse(str(uri), vocabulary) == uri
            assert parse(uri.short, vocabulary) == uri
    for a, b in ((text, 'rocon:/'), ('rocon:/', text)):
        try:
            is_compatible(a, b)
        except RoconURIValueError:
            continue


def work(function, *arguments):
    """How much is done in a call: lines and calls of Python, calls of what is written in C."""
    done = 0

    def count(frame, event, argument):
        nonlocal done
        done += 1
        return count
    others = sys.gettrace(), sys.getprofile()      # of who measures what the tests cover
    gc.disable()        # hypothesis has it call back
    sys.settrace(count)
    sys.setprofile(count)
    try:
        function(*arguments)
    except RoconURIValueError:
        pass
    finally:
        sys.settrace(others[0])
        sys.setprofile(others[1])
        gc.enable()
    return done


LONG = ['a', '/', '|', '#', '%', '%41', '%7C', '%2F', '%C3%B6', '?', ' ', '*', '(', '[', '\n',
        '\ud800', 'pr2|', 'foo|', '*|', '//', '%/', '(a|b)*', '.*', 'a{2}', '\xf6', '%F']
BEFORE = ['', 'rocon:', 'rocon:/', 'rocon://', 'rocon:/pr2/', 'rocon:/pr2/b/', 'rocon:/pr2/b/ros/',
          'rocon:/pr2#', 'rocon:/pr2#a/', 'rocon://pr2|', 'rocon://pr2/b']


@pytest.mark.parametrize('before', BEFORE)
def test_the_work_of_reading_grows_no_faster_than_the_text(before):
    def half_and_whole(piece, length):
        for repeated in (length // 2, length):
            text = before + piece * (repeated // len(piece))
            yield work(parse, text), work(parse, text, Vocabulary.open())
    parse(before + 'x' * 300 if 'x' in before else 'rocon:/pr2/b/ros')      # nothing is new to it
    for piece in LONG:
        for half, whole in zip(*half_and_whole(piece, 4000)):
            assert whole <= 2.1 * half + 500, piece


@pytest.mark.parametrize('text', [
    'a' * 10000000, 'rocon:/' + 'a' * 10000000, 'rocon:/' + 'pr2|' * 1000000,
    'rocon:/' + '|' * 1000000, 'rocon:/' + 'foo|' * 1000000, 'rocon:' + '/' * 10000000,
    'rocon:/pr2/' + '%41' * 3000000, 'rocon:/pr2/' + '(' * 10000000, ' ' * 10000000,
    'rocon:/pr2#' + 'a/' * 5000000,
], ids=lambda text: text[:15])
def test_a_text_of_megabytes_costs_nothing(text):
    for vocabulary in (None, Vocabulary.open()):
        assert work(parse, text, vocabulary) < 100
    with pytest.raises(RoconURIValueError) as caught:
        parse(text)
    assert len(str(caught.value)) < 400
    assert len(caught.value.pretty()) < 600


@pytest.mark.parametrize('before', BEFORE)
def test_the_longest_texts_are_read_or_refused(before):
    for piece in LONG:
        text = before + piece * (65536 // len(piece))
        try:
            parse(text[:65536], Vocabulary.open())
        except RoconURIValueError as error:
            assert len(str(error)) < 1200


def test_near_misses_are_looked_for_when_the_error_is_shown():
    text = 'rocon:/turtelbot2'
    parse_only = work(parse, text)

    def parse_and_show():
        try:
            parse(text)
        except RoconURIValueError as error:
            str(error)
    assert work(parse_and_show) > 10 * parse_only
