"""Processes are found by the mark in their environment, and ended with all that they forked."""
from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from textwrap import dedent

import pytest
from ros_master import ignores

from capabilities.launch import exit_code, exit_text
from capabilities.leftovers import Watcher, end_leftovers
from capabilities.processes import MARK, ServerRun, end_marked, find_marked, kill_marked

MASTER = 'http://localhost:1'
PATIENCE = 60       # seconds until a test that waits for something fails


@pytest.fixture
def run():
    """A run of a server that no other test knows; nothing of it outlives the test."""
    run = ServerRun.new('/server_%d' % os.getpid(), MASTER)
    yield run
    kill_marked(lambda process: process.server == run.server)


@pytest.fixture
def start(tmp_path):
    """Start Python code with a mark, in a session of its own; wait until it says that it runs."""
    started = []

    def start(code, mark):
        ready = tmp_path / ('ready%d' % len(started))
        process = subprocess.Popen(
            [sys.executable, '-c', PRELUDE + dedent(code), str(ready), str(tmp_path)],
            start_new_session=True, env=dict(os.environ, **{MARK: mark}))
        started.append(process)
        wait_until(ready.exists)
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()


PRELUDE = '''
import os, signal, subprocess, sys, time

def ready():
    open(sys.argv[1], 'w').close()

def note(text):
    with open(os.path.join(sys.argv[2], 'notes'), 'a') as stream:
        stream.write(text + '\\n')

'''
SLEEP = 'ready(); time.sleep(1000)'
STUBBORN = '''
signal.signal(signal.SIGINT, signal.SIG_IGN)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
ready()
time.sleep(1000)
'''
DEAF_CHILD = '''
if os.fork() == 0:
    os.setsid()
    for number in signal.SIGINT, signal.SIGTERM:
        signal.signal(number, lambda number, frame: (note('child %d' % number), os._exit(0)))
    ready()
    time.sleep(1000)
signal.signal(signal.SIGINT, lambda number, frame: (note('parent %d' % number)))
while True:
    time.sleep(1000)
'''
RUNAWAY = '''
signal.signal(signal.SIGINT, signal.SIG_IGN)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
ready()
while True:
    if os.fork():
        time.sleep(2)       # shorter lives than a look at /proc takes are not seen at all
        os._exit(0)
    time.sleep(0.02)
'''


def wait_until(condition):
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, 'it did not happen'
        time.sleep(0.01)


def of_run(run):
    return lambda process: (process.server, process.run) == run


def is_gone(pid):
    try:
        with open('/proc/%d/stat' % pid) as stream:
            return stream.read().rpartition(')')[2].split()[0] in 'ZX'
    except OSError:
        return True


def command_line(pid):
    with open('/proc/%d/cmdline' % pid) as stream:
        return stream.read()


@pytest.mark.parametrize('returncode, code, text', [
    (0, 0, 'exit 0'), (5, 5, 'exit 5'), (255, 255, 'exit 255'), (-9, 137, 'signal 9'),
    (-2, 130, 'signal 2')])
def test_the_end_of_a_process_in_numbers_and_words(returncode, code, text):
    assert (exit_code(returncode), exit_text(returncode)) == (code, text)


def test_a_process_is_found_by_its_mark_and_its_children_too(run, start):
    process = start('subprocess.Popen(["sleep", "1000"], start_new_session=True)\n' + SLEEP,
                    run.mark('a'))
    start(SLEEP, run._replace(run='another').mark('a'))
    start(SLEEP, 'no mark')
    found = find_marked(of_run(run))
    assert len(found) == 2
    assert {marked.launch for marked in found.values()} == {'a'}
    child, = found.keys() - {process.pid}
    assert found[child].parent == process.pid
    assert found[child].group == child
    assert found[child].command == 'sleep 1000'


def test_one_launch_is_told_from_another(run, start):
    process, other = start(SLEEP, run.mark('1')), start(SLEEP, run.mark('11'))
    assert kill_marked(lambda marked: of_run(run)(marked) and marked.launch == '1')
    assert process.wait() == -signal.SIGKILL
    assert find_marked(of_run(run)).keys() == {other.pid}


def test_this_process_is_never_found(run):
    code = ('import capabilities.processes as p; '
            'print(list(p.find_marked(lambda marked: marked.run == "itself")))')
    printed = subprocess.run(
        [sys.executable, '-c', code], stdout=subprocess.PIPE, check=True,
        env=dict(os.environ, **{MARK: run._replace(run='itself').mark('a')}))
    assert printed.stdout == b'[]\n'


def test_what_ends_on_sigint_gets_nothing_else(run, start):
    process = start(SLEEP, run.mark('a'))
    assert end_marked(of_run(run), interrupt=PATIENCE)
    assert process.wait() in (-signal.SIGINT, 1, 130)


def test_sigint_goes_to_the_parent_only_and_sigterm_to_all(run, start, tmp_path):
    process = start(DEAF_CHILD, run.mark('a'))
    assert end_marked(of_run(run), interrupt=0.5, terminate=PATIENCE)
    assert process.wait() == -signal.SIGTERM
    assert sorted((tmp_path / 'notes').read_text().split('\n')) == ['', 'child 15', 'parent 2']


def test_what_ignores_signals_is_killed(run, start):
    process = start(STUBBORN, run.mark('a'))
    assert end_marked(of_run(run), interrupt=0.2, terminate=0.2)
    assert process.wait() == -signal.SIGKILL


def test_what_forks_without_end_is_killed(run, start):
    start(RUNAWAY, run.mark('a'))
    assert end_marked(of_run(run), interrupt=0.2, terminate=0.2)
    assert not find_marked(of_run(run))


def test_a_server_is_alive_as_long_as_its_process_is(run):
    assert run.is_alive()
    pid, started, rest = run.run.split('-')
    assert not run._replace(run='-'.join((pid, started + '1', rest))).is_alive()     # a reused id
    assert not run._replace(run='no id').is_alive()
    assert not run._replace(run='%d-1-x' % (1 << 30)).is_alive()


def test_leftovers_of_earlier_runs_are_ended_with_a_line_each(run, start):
    earlier = run._replace(run='999999999-1-earlier')
    elsewhere = ServerRun('/%s_too@%s' % (run.server[1:].partition('@')[0], MASTER), earlier.run)
    leftover, stubborn = start(SLEEP, earlier.mark('1')), start(STUBBORN, earlier.mark('2'))
    mine, of_another = start(SLEEP, run.mark('1')), start(SLEEP, elsewhere.mark('1'))
    lines = []
    assert end_leftovers(run, lines.append) == 2
    assert is_gone(leftover.pid) and is_gone(stubborn.pid)
    assert not is_gone(mine.pid) and not is_gone(of_another.pid)
    assert sorted(line.partition(':')[0] for line in lines) == sorted(
        'ending process %d, left by an earlier run of %s' % (process.pid, run.server.split('@')[0])
        for process in (leftover, stubborn))
    kill_marked(of_run(elsewhere))


def test_a_server_that_still_lives_ends_its_own(run, start, monkeypatch):
    server = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(1000)'])
    with open('/proc/%d/stat' % server.pid) as stream:
        started = stream.read().rpartition(')')[2].split()[19]
    child = start(SLEEP, run._replace(run='%d-%s-earlier' % (server.pid, started)).mark('1'))
    looked = []

    def end_it():       # as the earlier server does it, while the new one looks
        if not looked:
            looked.append(True)
            child.terminate()
            child.wait()

    monkeypatch.setattr('capabilities.leftovers.time.sleep', lambda seconds: end_it())
    try:
        assert end_leftovers(run, pytest.fail, wait=PATIENCE) == 0
    finally:
        server.kill()
        server.wait()
    assert looked


SERVER = '''
import os, subprocess, sys, time
from capabilities.leftovers import Watcher
from capabilities.processes import MARK, ServerRun
run = ServerRun(*sys.argv[1:3])
watcher = Watcher(run)
for launch in '1', '2':
    subprocess.Popen(['sleep', '1000'], start_new_session=True,
                     env=dict(os.environ, **{MARK: run.mark(launch)}))
print(watcher.pid, flush=True)
time.sleep(1000)
'''


@pytest.fixture
def server(run):
    """A process that starts others and has a watcher, and the watcher's id."""
    process = subprocess.Popen([sys.executable, '-c', SERVER, *run], stdout=subprocess.PIPE,
                               env=dict(os.environ, **{MARK: 'of a server around this one'}))
    watcher = int(process.stdout.readline())
    yield process, watcher
    process.kill()
    process.wait()
    process.stdout.close()


def test_nothing_outlives_a_killed_server(run, server, start):
    process, watcher = server
    next_run = start(SLEEP, run._replace(run='the next').mark('1'))
    wait_until(lambda: len(find_marked(of_run(run))) == 2)
    process.kill()
    wait_until(lambda: not find_marked(of_run(run)))
    wait_until(lambda: is_gone(watcher))
    assert not is_gone(next_run.pid)


def test_the_watcher_ignores_the_signals_that_end_the_server(run, server):
    process, watcher = server
    wait_until(lambda: ignores(watcher, signal.SIGINT, signal.SIGTERM))
    os.kill(watcher, signal.SIGINT)
    os.kill(watcher, signal.SIGTERM)
    process.kill()
    wait_until(lambda: not find_marked(of_run(run)) and is_gone(watcher))


def test_the_watcher_stands_apart(run, server):
    _, watcher = server
    assert os.getsid(watcher) == watcher
    assert 'capability_server' not in command_line(watcher)
    assert run.server.split('@')[0] not in command_line(watcher)
    with open('/proc/%d/environ' % watcher) as stream:
        assert MARK + '=' not in stream.read()


def test_where_the_watcher_was_killed_too_the_next_run_ends_what_is_left(run, server):
    process, watcher = server
    wait_until(lambda: len(find_marked(of_run(run))) == 2)
    os.kill(watcher, signal.SIGKILL)
    process.kill()
    process.wait()
    lines = []
    assert end_leftovers(run._replace(run='the next'), lines.append, wait=0) == len(lines) == 2
    assert not find_marked(of_run(run))


def test_a_watcher_that_has_nothing_to_do_goes_at_once(run):
    watcher = Watcher(run)
    watcher.close()
    assert is_gone(watcher.pid)
    watcher.close()


def test_a_watcher_that_was_killed_disturbs_nobody(run):
    watcher = Watcher(run)
    os.kill(watcher.pid, signal.SIGKILL)
    wait_until(lambda: is_gone(watcher.pid))
    watcher.close()
