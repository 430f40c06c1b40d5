"""What each verb answers, for people and as JSON."""
from __future__ import annotations

import contextlib
import io
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sources import ROOT

import rocon_uri
from rocon_uri.cli import main
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.grammar import TEXT_LIMIT, VOCABULARY_FIELDS, ebnf
from rocon_uri.vocabulary import complete

EXAMPLES = ROOT / 'examples'
COMPLEX = 'rocon:/*/(a|b)*a(a|b){200}', 'rocon:/*/(a|b)*b(a|b){200}'
URI_KEYS = ['text', 'file', 'line', 'uri', 'short', 'fields', 'read_with_one_slash']
ERROR_KEYS = ['message', 'uri', 'field', 'value', 'span', 'suggestions', 'file', 'line']


@pytest.fixture
def ask(capsys):
    """Run a verb; what it prints."""
    def run(*arguments):
        main(list(map(str, arguments)))
        return capsys.readouterr().out
    return run


@pytest.fixture
def ask_json(ask):
    def run(*arguments):
        return json.loads(ask(*arguments, '--json'))
    return run


@pytest.fixture
def complaint(capsys):
    """Run a verb; what it says on stderr."""
    def run(*arguments):
        main(list(map(str, arguments)))
        return capsys.readouterr().err
    return run


@pytest.fixture
def file_of(tmp_path):
    def write(*lines, name='robots.txt'):
        path = tmp_path / name
        path.write_bytes('\n'.join(lines).encode('utf-8', 'surrogateescape'))
        return path
    return write


# -- parse -----------------------------------------------------------------------------------------

def test_parse_shows_the_fields_aligned(ask):
    assert ask('parse', 'rocon://north/turtlebot2|pr2/bob*#rocon_apps/teleop', 'rocon:/pr2') == '''\
rocon://north/turtlebot2|pr2/bob*#rocon_apps/teleop
  canonical              rocon://north/turtlebot2|pr2/bob*/*/*#rocon_apps/teleop
  short                  rocon://north/turtlebot2|pr2/bob*#rocon_apps/teleop
  concert_name           north
  hardware_platform      turtlebot2|pr2
  name                   bob*
  application_framework  *
  operating_system       *
  rocon_app              rocon_apps/teleop

rocon:/pr2
  canonical              rocon:/pr2/*/*/*
  short                  rocon:/pr2
  hardware_platform      pr2
  name                   *
  application_framework  *
  operating_system       *
'''


def test_parse_shows_the_good_ones_beside_the_bad_ones(ask):
    shown = ask('parse', 'rocon:/zork', 'rocon:/pr2', 'zork')
    assert shown == ask('parse', 'rocon:/pr2')


def test_parse_as_json(ask_json):
    assert ask_json('parse', 'rocon://north/turtlebot2|pr2/bob#teleop') == {
        'uris': [{
            'text': 'rocon://north/turtlebot2|pr2/bob#teleop', 'file': None, 'line': None,
            'uri': 'rocon://north/turtlebot2|pr2/bob/*/*#teleop',
            'short': 'rocon://north/turtlebot2|pr2/bob#teleop',
            'fields': {'concert_name': 'north', 'hardware_platform': ['turtlebot2', 'pr2'],
                       'name': 'bob', 'application_framework': ['*'], 'operating_system': ['*'],
                       'rocon_app': 'teleop'},
            'read_with_one_slash': False}],
        'errors': []}


def test_an_error_as_json(ask_json):
    error, = ask_json('parse', 'rocon:/turtelbot2/bob')['errors']
    assert list(error) == ERROR_KEYS
    assert error.pop('suggestions')[0] == 'turtlebot2'
    assert error.pop('message').startswith("hardware_platform 'turtelbot2' is not registered")
    assert error == {'uri': 'rocon:/turtelbot2/bob', 'field': 'hardware_platform',
                     'value': 'turtelbot2', 'span': [7, 17], 'file': None, 'line': None}


@pytest.mark.parametrize('verb', [['parse'], ['check', 'rocon:/robot']])
def test_a_slash_read_for_two_is_mentioned(verb, complaint, ask_json):
    text = 'rocon://turtlebot2/bob'
    assert complaint(*verb, text) == (
        "rocon_uri: note: 'rocon://turtlebot2/bob' is read as 'rocon:/turtlebot2/bob', since "
        'turtlebot2 is a hardware_platform, not a concert\n')
    assert ask_json(*verb, text)['uris'][-1]['read_with_one_slash'] is True
    assert complaint(*verb, 'rocon:/turtlebot2/bob') == ''


@given(st.lists(st.text(max_size=20).map('rocon:/pr2/'.__add__)
                | st.text().filter(lambda text: text != '--' and ':=' not in text), min_size=1))
def test_whatever_is_given_is_answered(texts):
    """Each text is a URI or an error, in the order given."""
    read, refused = [], []
    for text in texts:
        try:
            read.append(str(rocon_uri.parse(text)))
        except RoconURIValueError as error:
            refused.append(str(error))
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
        status = main(['parse', '--json', '--', *texts])
    answer = json.loads(out.getvalue())
    assert [uri['uri'] for uri in answer['uris']] == read
    assert [error['message'] for error in answer['errors']] == refused
    assert status == (2 if refused else 0)


# -- check -----------------------------------------------------------------------------------------

def test_check_says_why(ask):
    assert ask('check', 'rocon:/kobuki/arm_*', 'rocon:/pr2/*_left/noetic') == '''\
not compatible
relation: disjoint (they have no resource in common)
   field                  first   second  in common
.  hardware_platform      kobuki  pr2     nothing
x  name                   arm_*   *_left  e.g. arm_left
x  application_framework  *       noetic  noetic
x  operating_system       *       *       *
x fits, . does not
'''


@pytest.mark.parametrize('a, b, compatible, relation, example', [
    ('rocon:/pr2/bob', 'rocon:/pr2/bob/*', True, 'equal', 'bob'),
    ('rocon:/pr2/bob', 'rocon:/robot/b*', True, 'subset', 'bob'),
    ('rocon:/robot', 'rocon:/pr2/dud[a-e]+', True, 'superset', 'duda'),
    ('rocon:/robot/arm_*', 'rocon:/*/*_left/noetic', True, 'overlap', 'arm_left'),
    ('rocon:/pr2', 'rocon:/kobuki/bob', False, 'disjoint', 'bob'),
    ('rocon:/pr2/bob_*', 'rocon:/pr2/alice_*', False, 'disjoint', None),
    ('rocon:/', 'rocon:/nobody_registered_it/bob', True, None, 'bob'),
    ('rocon:/nobody_registered_it/bob', 'rocon:/', True, None, 'bob'),
    ('rocon://north/', 'rocon://south/nobody_registered_it', False, None, 'a'),
])
def test_check_says_how_they_lie_to_each_other(a, b, compatible, relation, example, ask, ask_json):
    answer = ask_json('check', a, b)
    assert list(answer) == ['uris', 'compatible', 'relation', 'example', 'fields', 'errors']
    assert [list(uri) for uri in answer['uris']] == [URI_KEYS, URI_KEYS]
    assert [uri['text'] for uri in answer['uris']] == [a, b]
    assert (answer['compatible'], answer['relation'], answer['example']) == (
        compatible, relation, example)
    assert all(field['compatible'] for field in answer['fields']) == compatible
    assert answer['errors'] == []
    verdict, rest = ask('check', a, b).split('\n', 1)
    assert verdict == ('compatible' if compatible else 'not compatible')
    assert rest.startswith('relation: %s (' % relation) or relation is None
    assert 'relation' not in rest or relation is not None


def test_check_mentions_a_value_that_nobody_registered(complaint):
    note = complaint('check', 'rocon:/', 'rocon:/turtelbot2')
    assert note.startswith("rocon_uri: note: hardware_platform 'turtelbot2' is not registered")


def test_check_reports_both_if_both_are_bad(ask_json):
    answer = ask_json('check', 'rocon:/zork', 'rocon:/pr2/1')
    assert [error['value'] for error in answer['errors']] == ['zork', '1']
    assert answer['compatible'] is answer['relation'] is answer['example'] is None
    assert answer['uris'] == answer['fields'] == []


def test_check_of_patterns_that_are_too_complex(ask, ask_json, complaint):
    assert 'too complex' in complaint('check', *COMPLEX) and ask('check', *COMPLEX) == ''
    answer = ask_json('check', *COMPLEX)
    assert [uri['text'] for uri in answer['uris']] == list(COMPLEX)
    assert answer['compatible'] is None and len(answer['errors']) == 1
    assert list(answer['errors'][0]) == ERROR_KEYS


# -- match -----------------------------------------------------------------------------------------

def test_match_prints_the_lines_that_fit_as_they_are(ask, file_of):
    robots = file_of('# robots', '', '  ', 'rocon:/pr2/bob', 'rocon:/kobuki/carl',
                     'rocon:pr2/eve#a/b', '\trocon:/pr2/ivan \r', 'rocon:/pr2')
    assert ask('match', 'rocon:/pr2', '--in', robots).splitlines() == [
        'rocon:/pr2/bob', 'rocon:pr2/eve#a/b', 'rocon:/pr2/ivan', 'rocon:/pr2']


def test_match_of_several_requests_says_which(ask, file_of):
    robots = file_of('rocon:/pr2/bob', 'rocon:/pc/screen', 'rocon:/kobuki/carl')
    requests = 'rocon:/robot#rocon_apps/chirp', 'rocon:/pr2'
    expected = '''\
rocon_apps/chirp  rocon:/pr2/bob
rocon:/pr2        rocon:/pr2/bob
rocon_apps/chirp  rocon:/kobuki/carl
'''
    assert ask('match', *requests, '--in', robots) == expected
    requests_file = file_of(*requests, name='apps.txt')
    assert ask('match', '--requests-in', requests_file, '--in', robots) == expected
    assert ask('match', requests[0], '--requests-in', file_of(requests[1], name='apps.txt'),
               '--in', robots) == expected


def test_match_of_a_file_of_one_request_says_which_too(ask, file_of):
    assert ask('match', '--requests-in', file_of('rocon:/pc#a', name='apps.txt'),
               '--in', file_of('rocon:/pc')) == 'a  rocon:/pc\n'


def test_matrix(ask, file_of):
    apps = file_of('# apps', 'rocon:/robot#rocon_apps/chirp', 'rocon:/pr2', 'rocon:/*/*/*/web#map',
                   name='apps.txt')
    robots = file_of('rocon:/pr2/bob', 'rocon:/kobuki/carl/*/focal', 'rocon:/pc/screen/*/windows')
    assert ask('match', '--matrix', '--requests-in', apps, '--in', robots) == '''\
x fits, . does not, ? is too complex to say
rocon_apps/chirp
| rocon:/pr2
| | map
x x x  rocon:/pr2/bob
x . .  rocon:/kobuki/carl/*/focal
. . .  rocon:/pc/screen/*/windows
'''


def test_the_matrix_of_the_examples_says_what_is_compatible_says(ask):
    def uris(name):
        lines = (EXAMPLES / name).read_text().splitlines()
        return [line for line in lines if line.startswith('rocon:')]
    apps, robots = uris('apps.txt'), uris('fleet.txt')
    lines = ask('match', '--matrix', '--requests-in', EXAMPLES / 'apps.txt',
                '--in', EXAMPLES / 'fleet.txt').splitlines()[1:]
    assert [line.split()[-1] for line in lines[:len(apps)]] == [
        rocon_uri.parse(app).rocon_app for app in apps]
    for line, robot in zip(lines[len(apps):], robots):
        marks = ['x' if rocon_uri.is_compatible(app, robot) else '.' for app in apps]
        assert line == ' '.join(marks) + '  ' + robot
    assert len(lines) == len(apps) + len(robots)


def test_match_as_json(ask_json, file_of):
    robots = file_of('rocon:/pr2/bob', 'rocon:/zork', 'rocon:/pc/screen')
    apps = file_of('#', 'rocon:/pr2#a/b', name='apps.txt')
    arguments = 'match', 'rocon:/robot', '--requests-in', apps, '--in', robots
    answer = ask_json(*arguments)
    assert list(answer) == ['requests', 'resources', 'errors']
    assert [(uri['text'], uri['file'], uri['line']) for uri in answer['requests']] == [
        ('rocon:/robot', None, None), ('rocon:/pr2#a/b', str(apps), 2)]
    bob, = answer['resources']
    assert list(bob) == [*URI_KEYS, 'requests']
    assert (bob['text'], bob['file'], bob['line']) == ('rocon:/pr2/bob', str(robots), 1)
    assert bob['requests'] == ['rocon:/robot', 'rocon:/pr2#a/b']
    error, = answer['errors']
    assert list(error) == ERROR_KEYS
    assert (error['uri'], error['file'], error['line']) == ('rocon:/zork', str(robots), 2)
    every = ask_json(*arguments, '--matrix')
    assert [uri['requests'] for uri in every['resources']] == [bob['requests'], []]


def test_match_as_json_with_nothing_to_say(ask_json, file_of):
    answer = ask_json('match', 'rocon:/pr2', '--in', file_of('# none'))
    assert answer['resources'] == [] and answer['errors'] == []


def test_a_file_that_cannot_be_read_as_json(ask_json):
    error, = ask_json('match', 'rocon:/pr2', '--in', '/no/such/file')['errors']
    assert list(error) == ERROR_KEYS and error['suggestions'] == []
    assert error['message'] == "cannot read '/no/such/file': No such file or directory"
    assert error['file'] == '/no/such/file' and error['line'] is None and error['uri'] is None


def test_pairs_that_are_too_complex_come_after_all_else(ask, ask_json, complaint, file_of):
    robots = file_of('rocon:/pr2/bob', COMPLEX[1], 'rocon:/pr2/aaa', 'rocon:/zork')
    arguments = 'match', '--matrix', COMPLEX[0] + '#a/b', 'rocon:/', '--in', robots
    assert ask(*arguments).splitlines()[3:] == [
        '. x  rocon:/pr2/bob', '? x  ' + COMPLEX[1], '. x  rocon:/pr2/aaa']
    bad_line, undecided = complaint(*arguments).splitlines()
    assert bad_line.startswith('%s:4: ' % robots)
    assert undecided.startswith("%s:2: undecided for request '%s#a/b': " % (robots, COMPLEX[0]))
    assert main(['match', COMPLEX[0], '--in', str(robots)]) == 2
    error = ask_json(*arguments)['errors'][1]
    assert list(error) == ERROR_KEYS
    assert error['uri'] == COMPLEX[1] and error['line'] == 2 and error['field'] == 'name'


@pytest.mark.parametrize('line', ['rocon:/pr2/' + 'a' * 10 * TEXT_LIMIT, '#' * 10 * TEXT_LIMIT])
def test_a_line_longer_than_any_uri_is_one_line(line, complaint, ask, file_of):
    robots = file_of('rocon:/pr2/bob', line, 'rocon:/pr2/carl', 'rocon:/zork')
    assert ask('match', 'rocon:/pr2', '--in', robots).splitlines() == [
        'rocon:/pr2/bob', 'rocon:/pr2/carl']
    numbers = [text.split(':')[1] for text in
               complaint('match', 'rocon:/pr2', '--in', robots).splitlines()]
    assert numbers == (['4'] if line[0] == '#' else ['2', '4'])


def test_a_comment_starts_with_a_hash_and_may_be_indented(complaint, file_of):
    robots = file_of('\ufeff# saved by an editor that marks its files', ' # a comment',
                     'rocon:/zork')
    assert complaint('match', 'rocon:/', '--in', robots).startswith('%s:3: ' % robots)


# -- fields, rules ---------------------------------------------------------------------------------

def test_fields_is_a_tree_with_the_name_of_the_field_on_the_first_line(ask):
    lines = ask('fields', 'operating_system').splitlines()
    assert lines[0] == 'operating_system'
    depth = {line.strip(): (len(line) - len(line.lstrip())) // 2 for line in lines}
    assert (depth['linux'], depth['ubuntu'], depth['focal']) == (1, 2, 3)
    assert lines.index('    ubuntu') > lines.index('  linux') < lines.index('      focal')
    assert list(depth)[1:] == list(complete().field('operating_system'))


def test_fields_shows_all_of_them_if_none_is_named(ask):
    assert ask('fields') == '\n'.join(ask('fields', field) for field in VOCABULARY_FIELDS)


def test_fields_as_json(ask_json):
    answer = ask_json('fields')
    assert list(answer) == ['fields', 'errors'] and list(answer['fields']) == [*VOCABULARY_FIELDS]
    assert answer['fields']['operating_system']['linux']['ubuntu']['focal'] == {}
    assert ask_json('fields', 'operating_system')['fields'] == {
        'operating_system': answer['fields']['operating_system']}
    assert list(answer['fields']['operating_system']['linux']) == (
        complete().field('operating_system').children('linux'))
    assert list(answer['fields']['operating_system']) == (
        complete().field('operating_system').children())


def test_rules_is_the_grammar_with_the_vocabulary_in_it(ask, ask_json):
    text = ebnf({field: complete().field(field) for field in VOCABULARY_FIELDS})
    assert ask('rules') == text and '"turtlebot2"' in text
    assert ask_json('rules') == {'ebnf': text, 'errors': []}


# -- platform --------------------------------------------------------------------------------------

def test_platform(ask, monkeypatch):
    monkeypatch.setenv('ROS_DISTRO', 'noetic')
    shown = ask('platform', '--robot-type', 'turtlebot2', '--robot-name', 'Cybernetic Pirate')
    assert shown.startswith('rocon:/turtlebot2/cybernetic_pirate/noetic/')
    default = rocon_uri.parse(ask('platform').strip())
    assert default.hardware_platform.string == 'pc' and not default.name.is_any


def test_platform_of_a_type_that_nobody_registered(ask, ask_json, complaint):
    arguments = 'platform', '--robot-type', 'turtelbot2', '--robot-name', 'bob'
    assert ask(*arguments).startswith('rocon:/turtelbot2/bob/')
    assert "hardware_platform 'turtelbot2' is not registered" in complaint(*arguments)
    answer = ask_json(*arguments)
    assert answer['uris'][0]['fields']['hardware_platform'] == ['turtelbot2']
    assert [error['value'] for error in answer['errors']] == ['turtelbot2']


def test_platform_as_json(ask, ask_json):
    answer = ask_json('platform', '--robot-name', 'bob')
    assert list(answer) == ['uris', 'errors'] and answer['errors'] == []
    assert [list(uri) for uri in answer['uris']] == [URI_KEYS]
    assert answer['uris'][0]['text'] == ask('platform', '--robot-name', 'bob').strip()
    assert ask_json('platform', '--robot-name', '')['uris'] == []
