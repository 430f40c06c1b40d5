"""match with more lines than are read at once."""
import os
import random
import subprocess
import sys

import pytest
from sources import ROOT, SOURCE
from terminal import open_terminal

from rocon_uri import RoconURIValueError, is_compatible
from rocon_uri.cli import main

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
    assert [error.split(':')[1] for error in printed.err.splitlines()] == list(map(str, bad))


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
    assert len(errors) == 12 and all(error.startswith(file) for error in errors)
    assert seen.rpartition('\r')[0].rpartition('\r')[2].isspace()      # nothing remains of the bar


def test_without_tqdm_there_are_only_the_errors(file):
    seen = stderr_on_a_terminal('import sys; sys.modules["tqdm"] = None', file)
    assert seen.count('\r\n') == seen.count(file) == 12 and '%' not in seen


def test_a_small_file_needs_no_bar(tmp_path):
    path = tmp_path / 'fleet.txt'
    path.write_text('rocon:/pr2\n' * 3, encoding='ascii')
    assert stderr_on_a_terminal('pass', str(path)) == ''
