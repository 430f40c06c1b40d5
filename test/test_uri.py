"""Rocon URIs as values: read, made of fields, changed into others, kept and passed on."""
from __future__ import annotations

import copy
import gc
import itertools
import pickle
import weakref

import pytest

import rocon_uri
from rocon_uri import Field, RoconURI, RoconURIValueError, Vocabulary, parse
from rocon_uri.vocabulary import current

FIELDS = ['hardware_platform', 'name', 'application_framework', 'operating_system']


# What consumers of the old package use.

def test_consumers_of_the_old_package_find_what_they_use():
    uri = rocon_uri.parse('rocon:/turtlebot2|pr2/bob#rocon_apps/teleop')
    assert uri.hardware_platform.list == ['turtlebot2', 'pr2']
    assert uri.hardware_platform.string == 'turtlebot2|pr2'
    assert uri.name.string == 'bob'
    assert uri.name.list == ['bob']
    assert uri.operating_system.string == '*'
    assert uri.operating_system.list == ['*']
    assert uri.rapp == uri.rocon_app == 'rocon_apps/teleop'
    assert uri.concert_name == ''
    assert str(RoconURI('rocon:/pr2')) == 'rocon:/pr2/*/*/*'


def test_the_default_is_anything():
    assert rocon_uri.default_uri_string == 'rocon://'
    assert parse(rocon_uri.default_uri_string) == parse() == RoconURI() == RoconURI('rocon:/')


def test_the_error_is_found_where_the_old_package_had_it():
    import rocon_uri.exceptions
    assert rocon_uri.exceptions.RoconURIValueError is RoconURIValueError
    with pytest.raises(ValueError, match='not registered'):
        rocon_uri.parse('rocon:/turtelbot2')


# The two slashes, by trying them all: reading a text with the rule is reading it by its letter,
# with one slash or with two.

CONCERTS = ['', 'north', 'pr2', 'pr2|kobuki', 'robot', 'pr2|foo', 'foo|pr2', 'pr2|', '*', '%70r2']
FIRST_FIELDS = ['', '*', 'bob', 'kobuki', 'kobuki|robot', 'kobuki|foo', '*|kobuki', 'k*', '3']
MORE_FIELDS = ['', '/', '/*', '/ros', '/*/ros', '/*/ros/', '/*/ros/linux', '/*/ros/linux/',
               '/*/ros//', '/*/ros/linux/x', '/*/ros//x']


def is_platform(text):
    registered = Vocabulary.bundled().field('hardware_platform')
    return all(alternative in registered for alternative in text.replace('%70', 'p').split('|'))


def is_read_with_one_slash(concert, fields):
    first, *_ = fields
    all_four = len(fields) > 4 or len(fields) == 4 and fields[3] != ''
    return is_platform(concert) and not is_platform(first) and not all_four


def outcome(text, more_slashes=0, **options):
    try:
        uri = parse(text, **options)
    except RoconURIValueError as error:
        start, end = error.span
        return error.problem, error.field, start + more_slashes, end + more_slashes
    return uri


@pytest.mark.parametrize('concert', CONCERTS)
def test_what_follows_two_slashes_is_a_platform_where_it_can_only_be_that(concert):
    all_fields = [''] + ['/' + first + more for first in FIRST_FIELDS for more in MORE_FIELDS]
    for fields, app in itertools.product(all_fields, ['', '#a']):
        text = 'rocon://' + concert + fields + app
        with_one_slash = is_read_with_one_slash(concert, (fields or '/')[1:].split('/'))
        if with_one_slash:
            expected = outcome('rocon:/' + concert + fields + app, 1, strict=True)
        else:
            expected = outcome(text, strict=True)
        got = outcome(text)
        assert got == expected, text
        if isinstance(got, RoconURI):
            assert got.read_with_one_slash == with_one_slash, text


def test_strict_takes_a_text_by_its_letter():
    assert parse('rocon://turtlebot2/pr2', strict=True).concert_name == 'turtlebot2'
    assert parse('rocon://turtlebot2', strict=True).concert_name == 'turtlebot2'
    assert parse('rocon://turtlebot2').concert_name == ''       # and is not remembered for it
    assert parse('rocon:', strict=True) == parse('rocon:#', strict=True) == parse('rocon:/')
    with pytest.raises(RoconURIValueError) as caught:
        parse('rocon:pr2/bob', strict=True)
    assert (caught.value.field, caught.value.span) == ('uri', (6, 9))
    assert not parse('rocon:pr2/bob').read_with_one_slash


def test_an_unregistered_platform_after_two_slashes_is_a_concert():
    everything = Vocabulary.bundled().opened()
    assert parse('rocon://bender/pr2', everything).concert_name == 'bender'
    assert parse('rocon://bender', everything).concert_name == 'bender'


@pytest.mark.parametrize('concert', ['north', 'pr2', 'robot'])
@pytest.mark.parametrize('platform', ['*', 'kobuki', 'kobuki|robot', 'bender'])
@pytest.mark.parametrize('name', ['*', 'bob', 'kobuki'])
@pytest.mark.parametrize('system', ['*', 'focal'])
def test_a_concert_that_bears_the_name_of_a_platform_stays_one(concert, platform, name, system):
    everything = Vocabulary.bundled().opened()
    uri = RoconURI.from_fields(concert, platform, name, operating_system=system,
                               vocabulary=everything)
    for text in (str(uri), uri.short, uri.to_rfc3986()):
        assert parse(text, everything) == uri


@pytest.mark.parametrize('text, short', [
    ('rocon://pr2/*/*/*/*', 'rocon://pr2/*/*/*/*'),
    ('rocon://pr2/kobuki/*/*/*', 'rocon://pr2/kobuki'),
    ('rocon://north/*/*/*/*', 'rocon://north'),
    ('rocon://north/*/*/ros/*#a', 'rocon://north/*/*/ros#a'),
    ('rocon:/*/*/*/*#a', 'rocon:/#a'),
    ('rocon:/pr2/(a|b)/*/*', 'rocon:/pr2/(a|b)'),
])
def test_the_short_text_writes_what_reading_it_back_needs(text, short):
    assert parse(text).short == short
    assert parse(short) == parse(text)


def test_what_is_made_of_values_that_were_read_before_is_read_no_otherwise():
    known = Vocabulary.bundled()
    parse('rocon:/pr2/bob/noetic/focal', known)
    uri = parse('rocon:/pr2/alice/noetic/focal#teleop', known)
    assert str(uri) == 'rocon:/pr2/alice/noetic/focal#teleop'
    assert uri.read_with_one_slash is False
    for scheme in ('a', 'zocon:', 'rocon', ''):
        with pytest.raises(RoconURIValueError, match="does not start with 'rocon:'"):
            parse(scheme + '/pr2/alice/noetic/focal', known)


def test_the_constructor_reads_as_parse_does():
    assert RoconURI('rocon://turtlebot2').read_with_one_slash
    assert RoconURI('rocon://turtlebot2', strict=True).concert_name == 'turtlebot2'
    assert str(RoconURI()) == 'rocon:/*/*/*/*'


# Limits

LONGEST = 'v' * 255


@pytest.mark.parametrize('field, longest', [
    ('concert_name', LONGEST), ('name', LONGEST), ('name', 'n' * 254 + '*'),
    ('name', '(' + 'n' * 252 + ')*'), ('rocon_app', LONGEST), ('rocon_app', 'a/' + LONGEST),
    ('rocon_app', LONGEST + '/a'), ('hardware_platform', LONGEST),
    ('application_framework', LONGEST), ('operating_system', 'focal|' + LONGEST),
])
def test_a_name_has_at_most_255_characters(field, longest):
    everything = Vocabulary.bundled().opened()
    uri = RoconURI.from_fields(vocabulary=everything, **{field: longest})
    assert parse(str(uri), everything) == uri
    longer = longest.replace('nn', 'nnn', 1) if field == 'name' else longest.replace('v', 'vv', 1)
    if field == 'name' and 'n' not in longest:
        longer = longest + 'v'
    assert len(longer) == len(longest) + 1
    with pytest.raises(RoconURIValueError) as caught:
        RoconURI.from_fields(vocabulary=everything, **{field: longer})
    assert caught.value.field == field
    assert '255' in str(caught.value)


@pytest.mark.parametrize('field, value', [
    ('hardware_platform', 'pr2'), ('application_framework', 'ros'), ('operating_system', 'web')])
def test_a_field_has_at_most_256_alternatives(field, value):
    assert getattr(RoconURI.from_fields(**{field: [value] * 256}), field).list == [value]
    for text in ('|'.join([value] * 257), '|' * 256, '|' * 1000000):
        with pytest.raises(RoconURIValueError, match='256') as caught:
            RoconURI.from_fields(**{field: text})
        assert caught.value.field == field


def test_a_text_has_at_most_65536_characters():
    everything = Vocabulary.bundled().opened()
    values = ['v%03d' % number + 'v' * 251 for number in range(255)]
    text = 'rocon:/' + '|'.join(values) + '|' + 'v' * 249
    assert len(text) == 65536
    assert len(parse(text, everything).hardware_platform.list) == 256
    for longer in (text + '/', text[:-1] + '%76'):
        with pytest.raises(RoconURIValueError, match='65536') as caught:
            parse(longer, everything)
        assert caught.value.field == 'uri'


# Made of fields

def test_is_made_of_fields():
    uri = RoconURI.from_fields('north', ['pr2', 'kobuki'], 'bob*', ('noetic',),
                               iter(['focal', 'jammy']), 'rocon_apps/teleop')
    assert uri == parse('rocon://north/pr2|kobuki/bob*/noetic/focal|jammy#rocon_apps/teleop')
    assert RoconURI.from_fields() == parse('rocon:/')
    assert RoconURI.from_fields(hardware_platform=uri.hardware_platform, name=uri.name) == parse(
        'rocon:/pr2|kobuki/bob*')
    assert RoconURI.from_fields(hardware_platform=[], name='') == parse('rocon:/')
    assert not uri.read_with_one_slash
    assert RoconURI.from_fields(concert_name='pr2').concert_name == 'pr2'


@pytest.mark.parametrize('field, value', [
    ('concert_name', ['north', 'south']), ('concert_name', ['']), ('rocon_app', ['a', 'b']),
    ('concert_name', '3north'), ('concert_name', '*'), ('concert_name', 'north/pr2'),
    ('hardware_platform', 'bender'), ('hardware_platform', 'pr2|'), ('hardware_platform', ['']),
    ('hardware_platform', ['pr2', 'kobuki|robot']), ('hardware_platform', 'pr2/bob'),
    ('hardware_platform', ' pr2'), ('hardware_platform', '%70r2'), ('hardware_platform', '?'),
    ('name', 'bob/ros'), ('name', 'bob|alice'), ('name', 'b%6Fb'), ('name', 'bob '),
    ('name', 'bob#a'), ('name', '3bob'), ('name', ['bob', 'alice']),
    ('application_framework', 'focal'), ('operating_system', 'focal#a'),
    ('rocon_app', 'a/b/c'), ('rocon_app', '#a'), ('rocon_app', 'a%2Fb'), ('rocon_app', 'a '),
])
def test_a_field_that_is_not_legal_is_refused(field, value):
    for make in (RoconURI.from_fields, parse('rocon:/pr2/bob').replace):
        with pytest.raises(RoconURIValueError) as caught:
            make(**{field: value})
        assert caught.value.field == field
        assert '\n' not in str(caught.value)


def test_replace_changes_only_what_is_named():
    uri = parse('rocon://north/pr2/bob/ros/linux#a/b')
    assert uri.replace() == uri
    assert str(uri.replace(name='alice')) == 'rocon://north/pr2/alice/ros/linux#a/b'
    assert str(uri.replace(hardware_platform=['kobuki', 'pr2'], rocon_app='', concert_name='')) == (
        'rocon:/kobuki|pr2/bob/ros/linux')
    assert str(uri) == 'rocon://north/pr2/bob/ros/linux#a/b'
    with pytest.raises(TypeError):
        uri.replace(colour='red')
    with pytest.raises(TypeError):
        uri.replace(name=None)


def test_replace_keeps_the_vocabulary():
    ours = Vocabulary({'hardware_platform': ['bender', 'flexo']})
    uri = parse('rocon:/bender', ours).replace(hardware_platform='flexo')
    assert uri.hardware_platform.string == 'flexo'
    assert uri.vocabulary is ours
    with pytest.raises(RoconURIValueError):
        uri.replace(hardware_platform='pr2')


@pytest.mark.parametrize('text', [None, b'rocon:/pr2', 3, ['rocon:/pr2']])
def test_what_is_no_text_is_a_type_error(text):
    with pytest.raises(TypeError, match='a rocon URI is a str, not %s' % type(text).__name__):
        parse(text)


@pytest.mark.parametrize('field', FIELDS)
@pytest.mark.parametrize('value, kind', [
    (None, 'NoneType'), (3, 'int'), (['pr2', None], 'NoneType'), ([b''], 'bytes')])
def test_what_is_no_field_is_a_type_error_that_names_it(field, value, kind):
    for make in RoconURI.from_fields, parse('rocon:/').replace:
        with pytest.raises(TypeError, match='^%s is a str, .*, not %s$' % (field, kind)):
            make(**{field: value})


# Kept

def test_no_attribute_can_be_set():
    uri = parse('rocon://north/pr2|kobuki/bob*/ros/linux#a')
    fields = [getattr(uri, name) for name in FIELDS]
    for thing in [uri, *fields]:
        public = [name for name in dir(thing) if not name.startswith('_')]
        before = {name: getattr(thing, name) for name in public}
        for name in [*public, 'colour']:
            with pytest.raises(AttributeError):
                setattr(thing, name, 'x')
            with pytest.raises(AttributeError):
                delattr(thing, name)
        after = {name: getattr(thing, name) for name in public}
        assert [name for name in public if not callable(before[name])
                and after[name] != before[name]] == []


def test_a_list_of_alternatives_is_a_new_one_each_time():
    uri = parse('rocon:/pr2|kobuki')
    uri.hardware_platform.list.append('x')
    uri.hardware_platform.expand().append('x')
    assert uri.hardware_platform.list == uri.hardware_platform.expand() == ['pr2', 'kobuki']


@pytest.mark.parametrize('text', ['rocon:/', 'rocon://pr2/*/*/*/*', 'rocon:/pr2/bob_[0-9]+',
                                  'rocon://north/pr2|kobuki/b*/ros/linux#rocon_apps/teleop'])
def test_is_copied_and_pickled(text):
    uri = parse(text)
    assert copy.copy(uri) is copy.deepcopy(uri) is uri
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        pickled = pickle.dumps(uri, protocol)
        assert len(pickled) < len(text) + 200       # the text, not the vocabulary
        assert pickle.loads(pickled) == uri
    for name in FIELDS:
        field = getattr(uri, name)
        assert copy.copy(field) is copy.deepcopy(field) is field
        assert pickle.loads(pickle.dumps(field)) == field
        assert pickle.loads(pickle.dumps(field)).list == field.list


def test_is_read_again_where_it_is_unpickled():
    theirs = Vocabulary({'hardware_platform': ['bender']})
    pickled = pickle.dumps(parse('rocon:/bender', theirs))
    with pytest.raises(RoconURIValueError) as caught:
        pickle.loads(pickled)
    assert caught.value.value == 'bender'


def test_texts_are_remembered_with_the_vocabulary_that_read_them():
    assert parse('rocon:/pr2/bob') is parse('rocon:/pr2/bob')
    ours = Vocabulary({'hardware_platform': ['bender']})
    theirs = Vocabulary({'hardware_platform': {'robot': ['bender']}})
    text = 'rocon:/bender'
    assert parse(text, ours) is parse(text, ours)
    assert parse(text, ours).vocabulary is ours
    assert parse(text, theirs).vocabulary is theirs
    assert parse(parse(text, ours)).vocabulary is ours
    assert parse(parse(text, ours), theirs).vocabulary is theirs


def test_texts_up_to_1024_characters_are_remembered():
    everything = Vocabulary.bundled().opened()
    longest = 'rocon:/' + '|'.join(['abcdefg'] * 128)[:1017]
    texts = ['rocon:/pr2', 'rocon:/kobuki/' + 'b' * 200, longest]
    uris = [parse(text, everything) for text in texts]
    assert len(longest) == 1024
    assert all(parse(text, everything) is uri for text, uri in zip(texts, uris))
    assert parse(longest + 'g', everything) is not parse(longest + 'g', everything)
    assert len(everything.uris_read) == len(texts)
    for number in range(4096 - len(texts)):
        parse('rocon:/v%d' % number, everything)
    assert all(parse(text, everything) is uri for text, uri in zip(texts, uris))


def test_what_is_remembered_is_bounded():
    everything = Vocabulary.bundled().opened()
    for number in range(6000):
        parse('rocon:/v%d' % number, everything)
    parse('rocon:/' + '|'.join('long%d' % number for number in range(250)), everything)
    assert len(everything.uris_read) <= 4096
    assert all(len(text) <= 1024 for text in everything.uris_read)
    for remembered in everything.fields_read.values():
        assert len(remembered) <= 1024
        assert all(len(text) <= 256 for text in remembered)


def test_equality_is_of_what_is_written():
    assert parse('rocon:/pr2|kobuki') == parse('rocon:/kobuki|pr2|pr2')
    assert hash(parse('rocon:/pr2|kobuki')) == hash(parse('rocon:/kobuki|pr2'))
    assert parse('rocon:/phone|tablet') != parse('rocon:/mobile_device')
    assert parse('rocon:/pr2/.*') != parse('rocon:/pr2')
    assert parse('rocon:/pr2') != 'rocon:/pr2'
    texts = ['rocon:/', 'rocon:/pr2', 'rocon:/kobuki', 'rocon:/*/pr2', 'rocon:/*/*/ros',
             'rocon:/*/*/*/linux', 'rocon://north', 'rocon:/#north', 'rocon:/#a/north',
             'rocon:/*/bob', 'rocon:/*/bob*']
    assert len({parse(text) for text in texts}) == len(texts)
    for a, b in itertools.permutations(texts, 2):
        assert parse(a) != parse(b)


def test_equality_is_the_same_for_any_vocabulary():
    ours = Vocabulary({'hardware_platform': ['pr2']})
    assert parse('rocon:/pr2', ours) == parse('rocon:/pr2')
    assert hash(parse('rocon:/pr2', ours)) == hash(parse('rocon:/pr2'))


def test_its_representation_can_be_evaluated():
    uri = parse('rocon://north/pr2|kobuki/bob')
    assert eval(repr(uri)) == uri


# Fields

def test_a_field_contains_what_it_covers():
    uri = parse('rocon:/pr2|phone/bob*/*/ubuntu|arch')
    expected = [
        (uri.hardware_platform, ['pr2', 'phone', 'note3'], ['kobuki', 'mobile_device', 'tablet']),
        (uri.name, ['bob', 'bob7'], ['alice', '7', 'bob-7', '']),
        (uri.application_framework, ['ros', 'noetic', 'my_framework'], ['', '3', 'a|b', '*']),
        (uri.operating_system, ['ubuntu', 'focal', 'arch'], ['linux', 'debian', 'bookworm', '*']),
    ]
    for field, inside, outside in expected:
        assert [value for value in inside if value not in field] == []
        assert [value for value in [*outside, None, 3, ['focal']] if value in field] == []


def test_a_group_is_in_the_alternatives_that_make_it_up():
    assert 'mobile_device' in parse('rocon:/phone|tablet').hardware_platform
    assert 'mobile_device' not in parse('rocon:/phone').hardware_platform


def test_a_value_of_an_open_vocabulary_is_in_the_field_that_names_it():
    field = parse('rocon:/bender|pr2', Vocabulary.bundled().opened()).hardware_platform
    assert 'bender' in field
    assert 'flexo' not in field
    assert field.expand() == ['bender', 'pr2']


def test_a_field_is_expanded_to_the_values_it_stands_for():
    uri = parse('rocon:/tablet|xoom|pr2/bob*')
    assert uri.hardware_platform.list == list(uri.hardware_platform) == ['tablet', 'xoom', 'pr2']
    assert uri.hardware_platform.expand() == ['xoom', 'note10', 'tablet_other', 'pr2']
    assert uri.name.expand() == ['bob*']
    systems = current().field('operating_system')
    assert uri.operating_system.expand() == [
        value for value in systems if not systems.children(value)]
    assert {'focal', 'bookworm', 'edge', 'osx'} <= set(uri.operating_system.expand())


def test_a_field_is_any_if_its_text_is_a_star():
    uri = parse('rocon:/pr2|*//ros')
    assert [getattr(uri, name).is_any for name in FIELDS] == [True, True, False, True]
    assert not parse('rocon:/*/.*').name.is_any
    assert all(isinstance(getattr(uri, name), Field) for name in FIELDS)
    assert str(uri.application_framework) == 'ros'
    assert repr(uri.application_framework) == "<Field 'ros'>"


# The text for the web

@pytest.mark.parametrize('text, escaped', [
    ('rocon:/pr2|kobuki/bob', 'rocon:/pr2%7Ckobuki/bob/*/*'),
    ('rocon:/pr2/^b?[^a]{2}\\d$', 'rocon:/pr2/%5Eb%3F%5B%5Ea%5D%7B2%7D%5Cd$/*/*'),
    ('rocon://north/*/(?:b|o)+#a/b', 'rocon://north/*/(%3F:b%7Co)+/*/*#a/b'),
])
def test_what_rfc_3986_does_not_allow_is_escaped(text, escaped):
    assert parse(text).to_rfc3986() == escaped
    assert parse(escaped) == parse(text)


# What consumers of the old package do

def test_the_arguments_have_the_names_that_the_old_package_gave_them():
    bob = parse(rocon_uri_string='rocon:/pr2/bob')
    assert RoconURI(rocon_uri_string='rocon:/pr2/bob') == bob
    assert rocon_uri.is_compatible(rocon_uri_a='rocon:/pr2', rocon_uri_b=bob)


def test_a_uri_can_be_referred_to_weakly():
    uri = parse('rocon:/pr2/someone_else', Vocabulary({'hardware_platform': ['pr2']}))
    users = weakref.WeakKeyDictionary({uri: 'one'})
    assert users[uri] == 'one'
    reference = weakref.ref(uri)
    uri.vocabulary.uris_read.clear()
    del uri
    gc.collect()
    assert reference() is None and not users


@pytest.mark.parametrize('app', ['ours/3dview', 'apps/2dlaser', 'ours/3', 'teleop'])
def test_the_name_of_an_app_may_start_with_a_digit_after_a_slash(app):
    uri = parse('rocon:/turtlebot#' + app)
    assert uri.rocon_app == app
    assert parse(str(uri)) == uri
    assert parse('rocon://north/turtlebot#' + app).rocon_app == app


@pytest.mark.parametrize('app', ['3dview', '3d/view', 'ours/_view', 'ours/', '/view', 'ours/3d/v'])
def test_the_name_of_an_app_starts_with_a_letter_elsewhere(app):
    with pytest.raises(RoconURIValueError, match='package/name'):
        parse('rocon:/turtlebot#' + app)


def test_ros_one_is_a_release_of_ros():
    assert rocon_uri.relation('rocon:/*/*/one', 'rocon:/*/*/ros').value == 'subset'
