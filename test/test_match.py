"""match with more lines than are read at once."""
import json
import os
import random
import subprocess
import sys
from itertools import zip_longest

import pytest
from sources import ROOT, SOURCE
from terminal import open_terminal

from rocon_uri import RoconURIValueError, is_compatible
from rocon_uri.cli import main
from rocon_uri.uri import parse_once as real_parse_once

REQUESTS = ['rocon:/pr2', 'rocon:/*/bob_1*/noetic', 'rocon:/robot/[a-z]+_[0-9]*7']


@pytest.fixture(scope='module')
def lines():
    """A megabyte and a half: robots, some of them twice, comments and what is no URI at all."""
    chosen = random.Random(1)
    found = []
    for number in range(60000):
        platform = chosen.choice(['pr2', 'kobuki', 'pr2|pc', 'tablet', 'mobile_device'])
        name = chosen.choice(['bob_%d' % number, 'al_%d' % number, 'bob', 'bob_[0-9]+', '*'])
        found.append('rocon:/%s/%s/%s' % (platform, name, chosen.choice(['noetic', 'ros', '*'])))
        if number % 5000 == 1:
            found += ['rocon:/zork', '', '# rocon:/pr2']
    return found


@pytest.fixture(scope='module')
def file(lines, tmp_path_factory):
    path = tmp_path_factory.mktemp('match') / 'fleet.txt'
    path.write_text('\n'.join(lines), encoding='ascii')
    return str(path)


def test_the_answers_are_those_of_a_loop_in_the_order_of_the_file(lines, file, capsys):
    expected = []
    for line in lines:
        if line and line[0] != '#':
            try:
                verdicts = [is_compatible(request, line) for request in REQUESTS]
            except RoconURIValueError:
                continue
            expected.append('%s  %s' % (' '.join('.x'[verdict] for verdict in verdicts), line))
    assert main(['match', '--matrix', *REQUESTS, '--in', file]) == 2
    printed = capsys.readouterr()
    assert printed.out.splitlines()[1 + len(REQUESTS):] == expected
    bad = [number for number, line in enumerate(lines, 1) if line == 'rocon:/zork']
    first, others = printed.err.splitlines()
    assert first.startswith("%s:%d: hardware_platform 'zork' is not registered" % (file, bad[0]))
    assert others.startswith(file + ": hardware_platform 'zork' is not registered, also on lines ")
    assert others.endswith(' %s and 6 more' % ', '.join(map(str, bad[1:6])))


def test_a_pipe_gives_the_same_as_a_file(file):
    command = [sys.executable, str(ROOT / 'scripts' / 'rocon_uri'), 'match', REQUESTS[0]]
    from_file = subprocess.run([*command, '--in', file], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    with subprocess.Popen(['cat', file], stdout=subprocess.PIPE) as cat:
        from_pipe = subprocess.run([*command, '--in', '-'], stdin=cat.stdout,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert from_pipe.stdout == from_file.stdout and from_file.stdout.count(b'\n') > 10000
    assert from_pipe.stderr == from_file.stderr.replace(file.encode(), b'<stdin>')


def stderr_on_a_terminal(before, file):
    """What match writes to stderr, which is a terminal; ``before`` is run in the process first."""
    program = '%s; from rocon_uri.cli import main; main(["match", "rocon:/pr2", "--in", %r])' % (
        before, file)
    ours, theirs = open_terminal()
    with subprocess.Popen([sys.executable, '-c', program], stdout=subprocess.DEVNULL,
                          stderr=theirs, env=dict(os.environ, PYTHONPATH=str(SOURCE))):
        os.close(theirs)
        seen = b''
        while True:
            try:
                seen += os.read(ours, 65536)
            except OSError:     # which is how a terminal ends
                break
    os.close(ours)
    return seen.decode()


def test_a_terminal_shows_how_far_it_is(file):
    pytest.importorskip('tqdm')
    seen = stderr_on_a_terminal('pass', file)
    assert '100%' in seen
    errors = [line for line in seen.split('\r') if 'zork' in line]
    assert len(errors) == 2 and all(error.startswith(file) for error in errors)
    before, last, after = seen.rpartition(file)     # nothing remains of the bar
    assert before.split('\r')[-2].isspace() and before[-1] == '\r' and after.count('\n') == 1


def test_the_tqdm_of_ubuntu_which_knows_no_nrows_will_do(file):
    pytest.importorskip('tqdm', minversion='4.46')      # else it is that one
    older = '''
import tqdm
def older(init=tqdm.tqdm.__init__):
    def __init__(self, **options):
        if 'nrows' in options:
            raise KeyError('nrows')
        init(self, **options, nrows=20)
    return __init__
tqdm.tqdm.__init__, tqdm.tqdm.__del__ = older(), lambda self: None
'''
    seen = stderr_on_a_terminal('exec(%r)' % older, file)
    assert '100%' in seen and 'Traceback' not in seen


def test_without_tqdm_there_are_only_the_errors(file):
    seen = stderr_on_a_terminal('import sys; sys.modules["tqdm"] = None', file)
    assert seen.count('\r\n') == seen.count(file) == 2 and '%' not in seen


def test_a_small_file_needs_no_bar(tmp_path):
    path = tmp_path / 'fleet.txt'
    path.write_text('rocon:/pr2\n' * 3, encoding='ascii')
    assert stderr_on_a_terminal('pass', str(path)) == ''


# Faults that many lines have

def errors_of(content, tmp_path, capsys, *arguments):
    path = tmp_path / 'fleet.txt'
    path.write_bytes(content)
    assert main(['match', 'rocon:/pr2', '--in', str(path), *arguments]) == 2
    printed = capsys.readouterr()
    return printed.out, printed.err.replace(str(path), 'fleet.txt').splitlines()


def test_a_fault_of_many_lines_is_said_once_and_counted(tmp_path, capsys):
    lines = ['rocon:/our_robot/bob_%d' % number for number in range(1000)]
    lines[10:10] = ['rocon:/pr2/our_robot', 'rocon:/our_robot|pr2/3bob', 'rocon:/pr2|our_robot/al',
                    'rocon:/pr2/*/our_robot', '# rocon:/our_robot', 'rocon:/our_robot/3bob']
    lines += ['rocon:/pr2/b b', 'rocon:/pr2/c c', 'zork']
    printed, errors = errors_of('\n'.join(lines).encode(), tmp_path, capsys)
    assert printed == 'rocon:/pr2/our_robot\n'
    for error, start in zip_longest(errors, [
            "fleet.txt:1: hardware_platform 'our_robot' is not registered (did you mean 'robot'?)",
            "fleet.txt:14: application_framework 'our_robot' is not registered",
            'fleet.txt:1007: a rocon URI has no white space (U+0020)',
            "fleet.txt:1009: 'zork' does not start with 'rocon:'",
            "fleet.txt: hardware_platform 'our_robot' is not registered, also",
            'fleet.txt: a rocon URI has no white space (U+0020), also']):
        assert error.startswith(start)
    assert errors[-2].endswith('also on lines 2, 3, 4, 5, 6 and 997 more')
    assert errors[-1].endswith('also on line 1008')


def test_a_value_that_many_lines_have_raises_one_error(tmp_path, capsys, monkeypatch):
    # to raise an error for each line takes ten times as long as to read one without a fault
    refused = []

    def parse_once(text, vocabulary):
        try:
            return real_parse_once(text, vocabulary)
        except RoconURIValueError:
            refused.append(text)
            raise

    monkeypatch.setattr('rocon_uri.cli.given.parse_once', parse_once)
    content = b'rocon:/our_robot/bob\n' * 100 + b'rocon:/our_robot\n' * 100
    errors_of(content, tmp_path, capsys)
    assert set(refused) == {'rocon:/our_robot/bob'} and len(refused) == 2     # and without spaces


@pytest.mark.parametrize('line, kind', [
    ('zork %d', 'a rocon URI has no white space (U+0020)'),
    ('zork_%d', "does not start with 'rocon:'"),
    ('rocon:/pr2/bob-%d', "'-' cannot stand in a ROS name, which has only letters, digits and '_'"),
    ('rocon:/pr2/%dbob', 'a ROS name starts with a letter'),
    ('rocon:/pr2/b%%FF%d', 'name: its percent-escapes are not UTF-8'),
    ('rocon://b-%d/pr2', 'concert_name is not a ROS base name'),
    ('rocon:/pr2#a/b/c%d', 'rocon_app is not of the form package/name or name'),
])
def test_a_kind_of_fault_is_the_same_with_every_name(line, kind, tmp_path, capsys):
    content = ''.join(line % number + '\n' for number in range(100)).encode()
    _, (first, others) = errors_of(content, tmp_path, capsys)
    assert first.startswith('fleet.txt:1: ')
    assert others.startswith('fleet.txt: ') and kind in others
    assert others.endswith(', also on lines 2, 3, 4, 5, 6 and 94 more')


def test_as_json_they_are_an_error_too(tmp_path, capsys):
    printed, _ = errors_of(b'rocon:/our_robot\n' * 20, tmp_path, capsys, '--json')
    errors = json.loads(printed)['errors']
    assert [error['line'] for error in errors] == [1, None]
    assert errors[1]['message'].endswith('also on lines 2, 3, 4, 5, 6 and 14 more')


# Text that is not UTF-8

@pytest.mark.parametrize('encoding, octet, offset', [
    ('utf-16', 0xff, 0), ('utf-16-le', 0, 1), ('utf-16-be', 0, 0)])
def test_utf_16_is_said_to_be_that(encoding, octet, offset, tmp_path, capsys):
    _, errors = errors_of('rocon:/pr2\nrocon:/pr2/bob\n'.encode(encoding), tmp_path, capsys)
    assert errors == ["rocon_uri: cannot read 'fleet.txt': it is UTF-16, not UTF-8: "
                      'byte 0x%02x at offset %d' % (octet, offset)]


def test_other_bytes_are_said_to_be_not_utf_8(tmp_path, capsys):
    content = 'rocon:/pr2/b\xf6b\n# \xf6\nrocon:/pr2\nrocon:/pr2/\xe4\n'.encode('latin-1')
    printed, errors = errors_of(content, tmp_path, capsys)
    assert printed == 'rocon:/pr2\n'
    assert errors == [
        "fleet.txt:1: 'rocon:/pr2/b\\udcf6b' is not UTF-8 (Latin-1?): byte 0xf6 at offset 12",
        'fleet.txt: not UTF-8 (Latin-1?), also on line 4']
    assert main(['parse', 'rocon:/pr2/\udcff']) == 2
    assert 'not UTF-8 (Latin-1?): byte 0xff at offset 11' in capsys.readouterr().err


# Where nothing is found

FLEET = '''rocon:/pr2/alice/noetic/focal
rocon:/pr2/bob_7/hydro/precise
rocon:/kobuki/bob/hydro/precise
rocon://north/pr2/alice/groovy
'''


@pytest.mark.parametrize('requests, says', [
    (['rocon:/pr2/bob/noetic'], "1: 'rocon:/pr2/alice/noetic/focal', excluded by name "
     "('alice', requested 'bob')"),
    (['rocon:/pr2/bob_8/hydro'], "2: 'rocon:/pr2/bob_7/hydro/precise', excluded by name "
     "('bob_7', requested 'bob_8')"),
    (['rocon:/kobuki/*/noetic'], "3: 'rocon:/kobuki/bob/hydro/precise', excluded by "
     "application_framework ('hydro', requested 'noetic')"),
    (['rocon:/husky/*/noetic/jammy'], "1: 'rocon:/pr2/alice/noetic/focal', excluded by "
     "hardware_platform ('pr2', requested 'husky') and operating_system "
     "('focal', requested 'jammy')"),
])
def test_the_nearest_resource_is_named_with_what_excludes_it(requests, says, tmp_path, capsys):
    path = tmp_path / 'fleet.txt'
    path.write_text(FLEET)
    for more in [], ['--json'], ['--matrix']:
        assert main(['match', *requests, '--in', str(path), *more]) == 1
        assert capsys.readouterr().err == (
            'rocon_uri: note: nothing found; the nearest is %s:%s\n' % (path, says))


def test_of_several_requests_the_one_that_came_nearest_is_named(tmp_path, capsys):
    path = tmp_path / 'fleet.txt'
    path.write_text(FLEET)
    assert main(['match', 'rocon:/pc/x', 'rocon:/pr2/bob_8', '--in', str(path)]) == 1
    assert "nothing found for 'rocon:/pr2/bob_8'; the nearest is" in capsys.readouterr().err


def test_an_empty_fleet_is_said_to_be_one(tmp_path, capsys):
    path = tmp_path / 'fleet.txt'
    path.write_text('# nobody\n')
    assert main(['match', 'rocon:/', '--in', str(path)]) == 1
    assert 'nothing found: there are no resources' in capsys.readouterr().err


@pytest.mark.parametrize('more', [[], ['--json']])
def test_why_is_check(more, capsys):
    pair = ['rocon:/robot/b*/ros', 'rocon:/pr2/alice']
    assert main(['check', *pair, *more]) == 1
    expected = capsys.readouterr()
    assert main(['match', '--why', *pair, *more]) == 1
    assert capsys.readouterr() == expected


@pytest.mark.parametrize('arguments', [
    ['--why', 'rocon:/pr2'], ['--why', 'rocon:/pr2', 'rocon:/pr2', 'rocon:/pr2'],
    ['--why', 'rocon:/pr2', 'rocon:/pr2', '--matrix'],
    ['--why', 'rocon:/pr2', 'rocon:/pr2', '--html', 'x.html'],
    ['--why', 'rocon:/pr2', 'rocon:/pr2', '--format', 'csv'],
    ['--why', 'rocon:/pr2', 'rocon:/pr2', '--in', '-'], ['rocon:/pr2', 'rocon:/pr2']])
def test_why_takes_two_uris_and_match_a_file(arguments, capsys):
    assert main(['match', *arguments]) == 2
    assert capsys.readouterr().err.startswith('rocon_uri match: error: ')


def test_resources_of_more_kinds_than_are_kept_are_found_all_the_same(
        tmp_path, monkeypatch, capsys):
    monkeypatch.setattr('rocon_uri.cli.matches._KINDS_KEPT', 3)
    lines = ['rocon:/%s/bob_%d' % (platform, number) for number in range(20)
             for platform in ('pr2', 'kobuki', 'pr2|kobuki', 'robot', 'pc', 'tablet|pr2')]
    path = tmp_path / 'fleet.txt'
    path.write_text('\n'.join(lines))
    for request in 'rocon:/pr2', 'rocon:/pr2/bob_1', 'rocon:/pr2/bob_1*':
        main(['match', request, '--in', str(path)])
        assert capsys.readouterr().out.splitlines() == [
            line for line in lines if is_compatible(request, line)]
