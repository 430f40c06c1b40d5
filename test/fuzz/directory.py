"""
A live directory among hostile announcers: what it holds and finds, against a list that is simple.

The announcements and requests are those that its node hands over, in whatever order; time is
pretended.
"""
from __future__ import annotations

from fuzz.damage import damaged
from fuzz.uri import GOOD, TOKENS, made_up

from rocon_uri import PatternTooComplex, RoconURIValueError, Vocabulary, is_compatible, parse
from rocon_uri.announcement import LIFETIMES, values_of
from rocon_uri.parts import FIELDS
from rocon_uri.resource_directory import ResourceDirectory, What
from rocon_uri.uri import RoconURI

ANNOUNCERS = ['/bob', '/alice', '/bob\n', '', '/\u202eeve']
KEYS = ['', '', 'left', 'right', 'a' * 255, 'a' * 256, '\0']
TIMES = [0.0, 0.05, 0.1, 1.0, 10.0, 3600.0, 3600.1, -1.0, float('inf'), float('nan')]


def make(rng):
    """The steps: an announcement, a request, a question, or seconds that pass."""
    return [make_step(rng) for _ in range(rng.choice((1, 3, 10, 30)))]


def make_step(rng):
    kind = rng.choice(('announce', 'announce', 'find', 'explain', 'pass'))
    if kind == 'announce':
        return (kind, rng.choice(ANNOUNCERS), rng.choice(KEYS), make_values(rng),
                rng.choice(TIMES[3:6] * 5 + TIMES))
    if kind == 'pass':
        return kind, rng.choice(TIMES[:5])
    return (kind, *(make_text(rng) for _ in range(1 + (kind == 'explain'))))


def make_text(rng):
    return made_up(rng) if rng.random() < 0.8 else damaged(rng, rng.choice(GOOD), TOKENS)


def make_values(rng):
    """The fields of a resource, as a message has them."""
    try:
        values = list(values_of(make_text(rng)))
    except RoconURIValueError:
        values = list(values_of('rocon:/pr2/bob'))
    if rng.random() < 0.3:
        number = rng.randrange(len(FIELDS))
        if isinstance(values[number], str):
            values[number] = damaged(rng, values[number], TOKENS)
        else:
            values[number] = rng.choice((1, 1, 2, 150)) * (
                damaged(rng, values[number][0], TOKENS), *values[number])
    return tuple(values)


def check(steps):
    now, held, told, reported = [0.0], {}, {}, []

    def changed(change):
        who = change.announcer, change.key
        assert told.get(who) == (change.before if change.what is What.CHANGED else
                                 None if change.what is What.APPEARED else change.uri)
        told[who] = change.uri if change.what in (What.APPEARED, What.CHANGED) else None

    directory = ResourceDirectory(changed, reported.append, lambda: now[0])
    for kind, *given in steps:
        if kind == 'pass':
            now[0] += given[0]
        elif kind == 'announce':
            check_announcement(directory, held, now[0], *given)
        elif kind == 'find':
            check_request(directory, held, now[0], *given)
        else:
            check_question(directory, *given)
        directory.expire()
        alive = {who: uri for who, (uri, expires) in held.items() if expires > now[0]}
        assert {who: uri for who, uri in told.items() if uri is not None} == alive
        assert len(directory) == len(alive)
        there = list(map(parse_open, directory.uris()))
        assert set(there) == set(alive.values()) and len(there) == len(set(there))
    assert all(text.isprintable() for text in reported)


def parse_open(text):
    return parse(text, Vocabulary.open())


def check_announcement(directory, held, now, announcer, key, values, lifetime):
    """Taken, it is held for its lifetime; refused, it is counted and changes nothing."""
    refused = directory.refused
    taken = directory.announce(announcer, key, values, lifetime)
    assert directory.refused == refused + (not taken)
    if lifetime == 0.0:
        assert taken
        held.pop((announcer, key), None)
    elif taken:
        assert LIFETIMES[0] <= lifetime <= LIFETIMES[1] and len(key) <= 255
        held[announcer, key] = announced(values), now + lifetime


def announced(values):
    """The URI of fields that are legal, whatever is registered."""
    return RoconURI.from_fields(**dict(zip(FIELDS, values)), vocabulary=Vocabulary.open())


def check_request(directory, held, now, request):
    """What is found is what fits of all that there is, each once."""
    alive = {uri for uri, expires in held.values() if expires > now}
    try:
        found = directory.find(request)
    except RoconURIValueError as error:
        assert str(error).isprintable()
        return
    assert len(set(found)) == len(found)
    asked = parse_open(request)
    for uri in alive:
        try:
            fits = is_compatible(asked, uri)
        except PatternTooComplex:
            continue
        assert fits is (uri in set(map(parse_open, found))), (request, uri)
    assert set(map(parse_open, found)) <= alive


def check_question(directory, request, uri):
    try:
        explanation = directory.explain(request, uri)
    except RoconURIValueError as error:
        assert str(error).isprintable()
        return
    assert all(line.isprintable() for line in str(explanation).splitlines())
    try:
        assert bool(explanation) is is_compatible(request, uri)
    except PatternTooComplex:
        pass
