"""What an error says: where the fault is, what was probably meant, on one line."""
from __future__ import annotations

import pickle

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocon_uri import PatternTooComplex, RoconURI, RoconURIValueError, Vocabulary, parse
from rocon_uri.sources.wording import near_misses, quoted
from rocon_uri.exceptions import UnregisteredValue

FIELDS = {'uri', 'concert_name', 'hardware_platform', 'name', 'application_framework',
          'operating_system', 'rocon_app'}


def error_of(text, **options):
    with pytest.raises(RoconURIValueError) as caught:
        parse(text, **options)
    return caught.value


#   text, field, value, the marked text, what the text of the error says
FAULTS = [
    ('http:/pr2', 'uri', 'http:/pr2', 'http:/', "does not start with 'rocon:'"),
    ('roco', 'uri', 'roco', 'roco', "does not start with 'rocon:'"),
    ('rocon:/pr2 /bob', 'uri', ' ', ' ', 'white space (U+0020)'),
    ('rocon:/pr2/b\u2003b', 'uri', '\u2003', '\u2003', 'white space (U+2003)'),
    ('rocon:/pr2/b\x07b', 'uri', '\x07', '\x07', 'a rocon URI has no control characters (U+0007)'),
    ('rocon:/pr2\n', 'uri', '\n', '\n', 'white space (U+000A)'),
    ('rocon:/pr2/bob/ros/linux/x', 'uri', '/x', '/x', 'at most four fields'),
    ('rocon:/pr2/bob/ros/linux//', 'uri', '//', '//', 'at most four fields'),
    ('rocon:/pr2/bob?/r?s', 'uri', '?', '?', "only the name can have a '?'"),
    ('rocon://3n/pr2', 'concert_name', '3n', '3n', "concert_name '3n' is not a ROS base name"),
    ('rocon:/turtelbot2', 'hardware_platform', 'turtelbot2', 'turtelbot2',
     "hardware_platform 'turtelbot2' is not registered (did you mean 'turtlebot2'"),
    ('rocon:/pr2|kobuky|x', 'hardware_platform', 'kobuky', 'kobuky', "did you mean 'kobuki'"),
    ('rocon:/pr2|', 'hardware_platform', '', '|', "'pr2|' has an empty alternative"),
    ('rocon:/|pr2', 'hardware_platform', '', '|', "'|pr2' has an empty alternative"),
    ('rocon:/pr2||kobuki', 'hardware_platform', '', '|', 'has an empty alternative'),
    ('rocon:/pr2%7Ckobuky%7Cx', 'hardware_platform', 'kobuky', 'kobuky', "'kobuky' is not"),
    ('rocon:/pr2%7C', 'hardware_platform', '', '%7C', 'has an empty alternative'),
    ('rocon:/%66oo%7Cpr2', 'hardware_platform', 'foo', '%66oo', "'foo' is not registered"),
    ('rocon:/pr2%7C%C3%B6%C3%A4', 'hardware_platform', '\xf6\xe4', '%C3%B6%C3%A4', 'registered'),
    ('rocon:/%E2%82%AC%7Cpr2', 'hardware_platform', '\u20ac', '%E2%82%AC', "'\u20ac' is not"),
    ('rocon:/pr2/%F0%9F%A4%96', 'name', '\U0001f916', '%F0%9F%A4%96', '\U0001f916'),
    ('rocon:/pr%2', 'hardware_platform', 'pr%2', 'pr%2', 'two hexadecimal digits'),
    ('rocon:/pr2/b%FFb', 'name', 'b%FFb', 'b%FFb', 'not UTF-8'),
    ('rocon:/pr2/b%41\ud800', 'name', 'b%41\ud800', 'b%41\ud800', 'not UTF-8'),
    ('rocon:/pr2/b%2Fb', 'name', 'b%2Fb', 'b%2Fb', 'escaped slash'),
    ('rocon:/pr2/3bob', 'name', '3bob', '3', 'starts with a letter'),
    ('rocon:/pr2/bob%7Calice', 'name', 'bob|alice', '%7C', "'|'"),
    ('rocon:/*/*/Hydro', 'application_framework', 'Hydro', 'Hydro', "did you mean 'hydro'"),
    ('rocon:/*/*/*/foccal', 'operating_system', 'foccal', 'foccal', "did you mean 'focal'"),
    ('rocon:/pr2#a/b/c', 'rocon_app', 'a/b/c', 'a/b/c', 'package/name'),
    ('rocon:/pr2#a%2Fb', 'rocon_app', 'a%2Fb', 'a%2Fb', 'escaped slash'),
    ('rocon://pr2/3bob', 'name', '3bob', '3', 'starts with a letter'),
]


@pytest.mark.parametrize('text, field, value, marked, says', FAULTS, ids=[f[0] for f in FAULTS])
def test_an_error_says_what_is_wrong_and_where(text, field, value, marked, says):
    error = error_of(text)
    assert (error.uri, error.field, error.value) == (text, field, value)
    start, end = error.span
    assert text[start:end] == marked
    assert says in str(error)
    assert quoted(text) in str(error)
    assert 'at character %d of' % (start + 1) in str(error)


@pytest.mark.parametrize('text, field, value, marked, says', FAULTS, ids=[f[0] for f in FAULTS])
def test_carets_stand_under_the_fault(text, field, value, marked, says):
    error = error_of(text)
    headline, uri, carets, *advice = error.pretty().split('\n')
    assert str(error).startswith(headline)
    assert says in headline
    assert [line for line in advice if line not in str(error)] == []
    columns = slice(carets.index('^'), carets.rindex('^') + 1)
    assert carets.strip() == '^' * len(carets[columns])
    assert uri[columns] == ''.join(c if c.isprintable() else '?' for c in marked)


def test_carets_stand_under_characters_that_are_two_columns_wide():
    _, uri, carets, _ = error_of('rocon:/\u8e0a|pr2').pretty().split('\n')
    assert carets == ' ' * uri.index('\u8e0a') + '^^'


@pytest.mark.parametrize('before', [0, 200])
@pytest.mark.parametrize('length', [1, 3, 1000])
@pytest.mark.parametrize('after', [0, 50])
def test_of_a_long_uri_the_part_around_the_fault_is_shown(before, length, after):
    text = 'rocon:/' + 'pr2|' * before + 'f' * length + '|kobuki' * after
    _, uri, carets, _ = error_of(text).pretty().split('\n')
    assert len(uri) < 160
    columns = slice(carets.index('^'), carets.rindex('^') + 1)
    assert set(uri[columns]) == {'f'}
    assert uri.startswith('    ...') == (before > 0)
    assert uri.endswith('...') == (after > 0 or length > 80)


def test_an_empty_text_has_nothing_to_point_at():
    error = error_of('')
    assert error.pretty() == str(error) == "'' does not start with 'rocon:'"
    assert error.span == (0, 0)


def test_advice_says_how_to_register_a_value():
    error = error_of('rocon:/turtelbot2')
    assert 'ROCON_URI_RULES' in error.advice
    assert str(error).endswith('; ' + error.advice)
    assert error.pretty().endswith('\n' + error.advice)


def test_a_fault_in_a_field_of_its_own_is_placed_there():
    with pytest.raises(RoconURIValueError) as caught:
        RoconURI.from_fields(operating_system='focal|jamy')
    error = caught.value
    assert (error.uri, error.field, error.value) == ('focal|jamy', 'operating_system', 'jamy')
    assert error.span == (6, 10)


# Suggestions

@pytest.mark.parametrize('text, first', [
    ('rocon:/turtelbot2', 'turtlebot2'), ('rocon:/PR2', 'pr2'), ('rocon:/Robot', 'robot'),
    ('rocon:/turtlebot22', 'turtlebot2'), ('rocon:/*/*/noetc', 'noetic'),
    ('rocon:/*/*/*/windows_7', 'windows7'), ('rocon:/*/*/*/Ubuntu', 'ubuntu')])
def test_the_likeliest_value_is_suggested_first(text, first):
    suggestions = error_of(text).suggestions
    assert suggestions[0] == first
    assert len(suggestions) <= 3


def test_what_is_near_nothing_gets_no_suggestion():
    for text in ('rocon:/xyzzy', 'rocon:/' + 'turtlebot2' * 10, 'rocon:/pr2|', 'rocon:/pr2/3bob'):
        error = error_of(text)
        assert error.suggestions == []
        assert 'did you mean' not in str(error)


def test_suggestions_come_from_the_vocabulary_that_was_asked():
    ours = Vocabulary({'hardware_platform': ['bender', 'flexo']})
    assert error_of('rocon:/blender', vocabulary=ours).suggestions == ['bender']


def test_suggestions_are_looked_for_when_they_are_asked_for():
    asked = []

    def candidates():
        asked.append(True)
        return ['turtlebot2']
    error = RoconURIValueError('no', 'rocon:/turtelbot2', 'hardware_platform', 'turtelbot2',
                               (7, 17), candidates)
    error = error.within('rocon://north/turtelbot2', (14, 24))
    assert asked == []
    assert error.suggestions == ['turtlebot2']
    assert asked == [True]


@pytest.mark.parametrize('text, candidates, expected', [
    ('turtelbot2', ['kobuki', 'turtlebot', 'turtlebot2'], ['turtlebot2', 'turtlebot']),
    ('KOBUKI', ['kobuki'], ['kobuki']),
    ('kobuki', ['Kobuki'], ['Kobuki']),
    ('', ['kobuki'], []),
    ('kobuki', [], []),
    ('k' * 65, ['k' * 65], []),
    ('k' * 64, ['k' * 64], ['k' * 64]),
    ('Bell', ['bellboy/Base', 'bellboy/Bell', 'bellboy/DoorBell'], ['bellboy/Bell']),
])
def test_near_misses(text, candidates, expected):
    assert near_misses(text, iter(candidates)) == expected


# One line, whatever the input

@pytest.mark.parametrize('text, shown', [
    ('bob', "'bob'"), ('', "''"), ("b'b", "'b'b'"), ('b\nb', "'b\\nb'"),
    ('\x1b[31m', "'\\x1b[31m'"),
    ('\ud800', "'\\ud800'"), ('\u202e', "'\\u202e'"), ('b\xf6b', "'b\xf6b'"),
    ('b' * 80, "'" + 'b' * 80 + "'"), ('b' * 81, "'" + 'b' * 77 + "...'"),
])
def test_a_text_is_quoted_on_one_line(text, shown):
    assert quoted(text) == shown


anything = st.text(st.characters(blacklist_categories=()), max_size=50)
nearly_uris = st.lists(st.one_of(anything, st.sampled_from([
    'rocon:', 'rocon:/', 'rocon://', '/', '//', '#', '|', '*', '%', '%7C', '%C3%B6', '%00', 'pr2',
    'turtelbot2', 'bob', 'ros', 'focal', '[', '(', ')', '+', '{', '?', '\n', '\x1b', 'x' * 300])),
    max_size=12).map(''.join)


@settings(deadline=None)
@given(st.one_of(anything, nearly_uris, nearly_uris.map('rocon:/{}'.format)))
def test_every_error_is_one_printable_line_with_a_place(text):
    try:
        parse(text)
    except RoconURIValueError as error:
        assert str(error).isprintable()
        assert len(str(error)) < 1200
        assert error.uri == text
        assert error.field in FIELDS
        start, end = error.span
        assert 0 <= start <= end <= len(text)
        assert isinstance(error.value, str)
        assert isinstance(error.suggestions, list)
        for line in error.pretty().split('\n'):
            assert line.isprintable()
            assert len(line) < 1200


# The class

def test_an_error_is_pickled_with_all_that_it_says():
    for error in (error_of('rocon:/turtelbot2'), error_of('rocon:/pr2 '),
                  PatternTooComplex('too complex', 'rocon:/*/a*', 'name', 'a*', (9, 11))):
        got = pickle.loads(pickle.dumps(error))
        assert type(got) is type(error)
        assert str(got) == str(error)
        assert got.pretty() == error.pretty()
        assert (got.uri, got.field, got.value, got.span, got.suggestions) == (
            error.uri, error.field, error.value, error.span, error.suggestions)


def test_the_classes_of_errors():
    assert issubclass(RoconURIValueError, ValueError)
    assert issubclass(PatternTooComplex, RoconURIValueError)
    assert issubclass(UnregisteredValue, RoconURIValueError)
    assert PatternTooComplex('too complex').undecided == []
    assert RoconURIValueError('no', 'rocon:/').span == (0, 7)


def test_an_error_has_no_other_behind_it():
    assert error_of('rocon:/pr2/b%2Fb').__suppress_context__
    assert error_of('rocon:/turtelbot2').__suppress_context__


# Advice

@pytest.mark.parametrize('text, value, says', [
    ('rocon:/*/*/*/ubuntu*', 'ubuntu*', "only the name can be a pattern, but the group 'ubuntu' "
     'covers its members'),
    ('rocon:/turtle.*', 'turtle.*', 'only the name can be a pattern'),
    ('rocon:/(pr2|fetch)', '(pr2', "alternatives need no parentheses: 'pr2|fetch'"),
    ('rocon:/pr2,kobuki', 'pr2,kobuki', "alternatives have a | between them: 'pr2|kobuki'"),
    ('rocon:/pr2;kobuki', 'pr2;kobuki', "alternatives have a | between them: 'pr2|kobuki'"),
    ('rocon:/pr2,(kobuki|fetch)', 'pr2,(kobuki', 'alternatives have a | between them'),
    ('rocon:/*/*/*/20.04', '20.04', 'a release has the name that is registered for it'),
    ('rocon:/*/*/*/ubuntu20.04', 'ubuntu20.04', 'a release has the name that is registered'),
    ('rocon:/*/*/*/focal+', 'focal+', 'only the name can be a pattern'),
    ('rocon:/pr2,', 'pr2,', 'a value is a letter, then letters, digits and _'),
    ('rocon:/turtlebot-2', 'turtlebot-2', 'a value is a letter, then letters, digits and _'),
    ('rocon:/' + 'b' * 256, 'b' * 256, 'at most 255 characters'),
])
def test_what_could_never_be_registered_is_not_told_to_be(text, value, says):
    error = error_of(text)
    assert error.value == value
    assert 'is not registered, and cannot be' in str(error) and says in error.advice
    assert 'rules file' not in str(error)
    assert 'a value is a letter' in error.advice
    assert not isinstance(error, UnregisteredValue)
    assert says in error_of(text, vocabulary=Vocabulary.bundled().opened()).advice


@pytest.mark.parametrize('text, says', [
    ('rocon:/kitkat', "'kitkat' is an operating_system"),
    ('rocon:/*/*/*/noetic', "'noetic' is an application_framework"),
    ('rocon:/jade', "'jade' is an application_framework"),
    ('rocon:/lunar', "'lunar' is an application_framework and an operating_system"),
    ('rocon:/*/*/pr2', "'pr2' is a hardware_platform"),
])
def test_a_value_of_another_field_is_said_to_be_one(text, says):
    error = error_of(text)
    assert error.advice == says
    assert isinstance(error, UnregisteredValue)


def test_a_value_is_also_looked_for_by_its_parts():
    assert error_of('rocon:/nao').suggestions == ['aldebaran_nao']
    assert error_of('rocon:/my_pr2').suggestions == ['pr2']
    assert error_of('rocon:/my_own').suggestions == []
    assert error_of('rocon:/my-nao').suggestions == []
    assert error_of('rocon:/*/*/*/ubuntu-focal').suggestions == ['focal', 'ubuntu']
    assert error_of('rocon:/*/*/ros.noetic').suggestions == ['noetic', 'ros']
    assert error_of('rocon:/pr2&kobuki').suggestions == ['kobuki', 'pr2']
    assert error_of('rocon:/+').suggestions == []
    again = pickle.loads(pickle.dumps(error_of('rocon:/nao')))
    assert again.suggestions == ['aldebaran_nao']
