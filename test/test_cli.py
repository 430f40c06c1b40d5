"""The command as users start it: statuses, streams, terminals, what it loads."""
from __future__ import annotations

import contextlib
import io
import json
import os
import re
import signal
import subprocess
import sys

import pytest
from sources import ROOT, SOURCE
from terminal import open_terminal

from rocon_uri.cli import VERBS, main

COMMAND = [sys.executable, str(ROOT / 'scripts' / 'rocon_uri')]
FLEET = str(ROOT / 'examples' / 'fleet.txt')
APPS = str(ROOT / 'examples' / 'apps.txt')
TOO_COMPLEX = 'rocon:/*/(a|b)*a(a|b){200}', 'rocon:/*/(a|b)*b(a|b){200}'


def environment(**changes):
    """That of the tests, without what a person may have set for the command."""
    left_out = {'NO_COLOR', 'TERM', 'PYTHONUNBUFFERED', 'ROCON_URI_RULES', 'COLUMNS'}
    kept = {name: value for name, value in os.environ.items() if name not in left_out}
    return {**kept, 'PYTHONPATH': str(SOURCE), **changes}


def run(*arguments, stdin='', **changes):
    return subprocess.run([*COMMAND, *arguments], input=stdin, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True,
                          env=environment(**changes))


def run_in_shell(line, **changes):
    """A line of bash in which $ROCON_URI is the command and $STATUS what it ended with."""
    command = ' '.join("'%s'" % word for word in COMMAND)
    script = line.replace('$ROCON_URI', command).replace('$STATUS', '${PIPESTATUS[0]}')
    return subprocess.run(['bash', '-c', script], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True,
                          env=environment(**changes))


@pytest.fixture
def bad_file(tmp_path):
    path = tmp_path / 'robots.txt'
    path.write_bytes(b'# the first is good\nrocon:/pr2/bob\nrocon:/zork\n\xff\xfe\n')
    return str(path)


# -- exit status -----------------------------------------------------------------------------------

@pytest.mark.parametrize('status, arguments', [
    (0, ['parse', 'rocon:/pr2/bob']),
    (2, ['parse', 'rocon:/zork']),
    (2, ['parse', 'rocon:/zork', 'rocon:/pr2']),
    (0, ['parse', 'rocon://turtlebot2/bob']),
    (0, ['check', 'rocon:/robot', 'rocon:/pr2/bob']),
    (1, ['check', 'rocon:/pr2', 'rocon:/kobuki']),
    (1, ['check', 'rocon:/pr2/bob*', 'rocon:/pr2/alice']),
    (0, ['check', 'rocon:/', 'rocon:/nobody_registered_it/bob']),
    (2, ['check', 'rocon:/pr2', 'rocon:/nobody_registered_it/bob']),
    (2, ['check', 'rocon:/pr2', 'zork']),
    (2, ['check', *TOO_COMPLEX]),
    (0, ['match', 'rocon:/kobuki', '--in', FLEET]),
    (1, ['match', 'rocon:/kobuki/nobody', '--in', FLEET]),
    (2, ['match', 'rocon:/kobuki', 'zork', '--in', FLEET]),
    (2, ['match', 'rocon:/kobuki', '--in', '/no/such/file']),
    (2, ['match', 'rocon:/kobuki', '--in', '/']),
    (2, ['match', 'rocon:/kobuki', '--requests-in', '/no/such/file', '--in', FLEET]),
    (2, ['match', 'rocon:/kobuki']),
    (2, ['match', '--in', FLEET]),
    (2, ['match', '--requests-in', '-', '--in', '-']),
    (0, ['match', '--matrix', 'rocon:/kobuki', '--in', FLEET]),
    (1, ['match', '--matrix', 'rocon:/kobuki/nobody', '--in', FLEET]),
    (0, ['match', '--requests-in', APPS, '--in', FLEET]),
    (0, ['fields']),
    (0, ['fields', 'operating_system']),
    (2, ['fields', 'name']),
    (0, ['rules']),
    (0, ['platform']),
    (0, ['platform', '--robot-type', 'turtlebot2', '--robot-name', 'bob']),
    (2, ['platform', '--robot-type', 'nobody_registered_it']),
    (2, ['platform', '--robot-name', '']),
    (2, []),
    (2, ['zork']),
    (2, ['--zork']),
    (2, ['parse']),
    (2, ['parse', '--zork', 'rocon:/pr2']),
    (2, ['check', 'rocon:/pr2']),
    (0, ['--help']),
    *((0, [verb, '--help']) for verb in VERBS),
])
def test_exit_status(status, arguments, capsys):
    assert main(arguments) == status
    printed = capsys.readouterr()
    assert (printed.err != '') == (status == 2) or 'note: ' in printed.err
    if 'match' in arguments or 'check' in arguments or 'parse' in arguments:
        json_too = main([*arguments, '--json']) if '--help' not in arguments else 0
        assert json_too == status


def test_a_bad_line_makes_it_2_whatever_was_found(bad_file, capsys):
    assert main(['match', 'rocon:/pr2', '--in', bad_file]) == 2
    assert capsys.readouterr().out == 'rocon:/pr2/bob\n'


def test_the_process_ends_with_the_status():
    for status, arguments in ((0, ['rocon:/pr2', 'rocon:/robot']), (1, ['rocon:/pr2', 'rocon:/pc']),
                              (2, ['rocon:/pr2', 'zork']), (2, [])):
        assert run('check', *arguments).returncode == status


# -- errors ----------------------------------------------------------------------------------------

def test_an_error_shows_where_and_what_was_meant():
    done = run('parse', 'rocon:/turtelbot2/bob')
    assert done.stdout == ''
    first, uri, carets = done.stderr.splitlines()[:3]
    assert first.startswith("rocon_uri: hardware_platform 'turtelbot2' is not registered "
                            "(did you mean 'turtlebot2'")
    assert carets.index('^') == uri.index('turtelbot2') and carets.count('^') == len('turtelbot2')


def test_bad_lines_are_reported_with_their_number_one_line_each(bad_file):
    done = run('match', 'rocon:/', '--in', bad_file)
    assert done.stdout == 'rocon:/pr2/bob\n'
    lines = done.stderr.splitlines()
    assert [line.rpartition(bad_file)[2].split(' ', 1)[0] for line in lines] == [':3:', ':4:']
    assert 'zork' in lines[0]


def test_bytes_that_are_no_text_are_an_error_like_any_other():
    done = subprocess.run([*COMMAND, 'parse', b'rocon:/pr2/\xff', b'\xc3\x28', 'rocon:/pr2'],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment())
    assert done.returncode == 2
    assert b'Traceback' not in done.stderr and done.stderr.count(b'rocon_uri: ') == 2
    assert done.stdout.startswith(b'rocon:/pr2\n')


@pytest.mark.parametrize('encoding', ['ascii', 'utf-8'])
def test_bytes_that_are_no_text_in_a_file_or_its_name(encoding, tmp_path):
    path = os.fsencode(tmp_path) + b'/\xff\n'
    with open(path, 'wb') as file:
        file.write('rocon:/pr2\n\xe4\u2028\nrocon:/pc'.encode('utf-8'))
    for verb in (['--in', path], ['--in', path, '--json'], ['--requests-in', path, '--in', path]):
        done = subprocess.run([*COMMAND, 'match', 'rocon:/', *verb], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env=environment(PYTHONIOENCODING=encoding))
        assert done.returncode == 2 and b'Traceback' not in done.stderr
        assert b':2: ' in done.stderr and b'rocon:/pc' in done.stdout


@pytest.mark.parametrize('path', ['/', '/no/such/file', __file__ + '/below'])
def test_a_file_that_cannot_be_read_is_named(path):
    for place in (['--in', path], ['--requests-in', path, '--in', FLEET]):
        done = run('match', 'rocon:/kobuki', *place)
        assert done.returncode == 2 and done.stderr.count('\n') == 1
        assert done.stderr.startswith("rocon_uri: cannot read '%s': " % path)


# -- streams ---------------------------------------------------------------------------------------

@pytest.mark.parametrize('line, status, err', [
    ('$ROCON_URI fields | head -1; exit $STATUS', 0, ''),
    ('$ROCON_URI rules | true; exit $STATUS', 0, ''),
    ('$ROCON_URI --help | true; exit $STATUS', 0, ''),
    ('yes rocon:/pr2 | $ROCON_URI match rocon:/ --in - | head -1; exit ${PIPESTATUS[1]}', 0, ''),
    ('yes rocon:/pr2 | $ROCON_URI match --json rocon:/ --in - | head -1; exit ${PIPESTATUS[1]}',
     0, ''),
    ('$ROCON_URI fields >&-', 0, ''),
    ('$ROCON_URI check rocon:/pr2 rocon:/pc >&-', 1, ''),
    ('$ROCON_URI parse rocon:/pr2 zork 2>&- >&-', 2, ''),
    ('$ROCON_URI parse zork 2>&-', 2, ''),
    ('$ROCON_URI match rocon:/ --in - <&-', 2,
     "rocon_uri: cannot read '<stdin>': Bad file descriptor\n"),
    ('$ROCON_URI fields > /dev/full', 2, 'rocon_uri: cannot write: No space left on device\n'),
    ('$ROCON_URI parse zork >& /dev/full', 2, ''),
])
@pytest.mark.parametrize('unbuffered', ['', '1'])
def test_a_closed_stream_or_a_full_disk_is_no_traceback(line, status, err, unbuffered):
    done = run_in_shell(line, PYTHONUNBUFFERED=unbuffered)
    assert (done.returncode, done.stderr) == (status, err)
    assert len(done.stdout.splitlines()) <= 1


@pytest.mark.parametrize('verb', ['specs check .', 'specs check %s' % ROOT])
def test_a_working_directory_that_was_deleted_is_no_fault_of_writing(verb, tmp_path):
    # without COV_CORE_SOURCE, or pytest-cov says that it does not find its place either
    done = run_in_shell(
        'unset COV_CORE_SOURCE; mkdir %s && cd "$_" && rmdir "$PWD" && $ROCON_URI %s' % (
            tmp_path / 'gone', verb))
    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr == 'rocon_uri: the working directory does not exist\n'


def test_a_file_that_cannot_be_read_is_no_fault_of_writing(monkeypatch, capsys):
    def parse_main(args):       # nothing is known to do so
        raise PermissionError(13, 'Permission denied', '/no/such/file')

    monkeypatch.setattr('rocon_uri.cli.parse.main', parse_main)
    assert main(['parse', 'rocon:/']) == 2
    assert capsys.readouterr().err == "rocon_uri: cannot read '/no/such/file': Permission denied\n"


def test_a_closed_stderr_is_not_replaced_by_stdout():
    assert run_in_shell('$ROCON_URI parse zork 2>&-').stdout == ''


def test_an_answer_comes_before_the_end_of_the_input():
    with subprocess.Popen([*COMMAND, 'match', 'rocon:/pr2', '--in', '-'], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, env=environment(PYTHONUNBUFFERED='1')) as process:
        for number in range(3):
            process.stdin.write(b'rocon:/kobuki\nrocon:/pr2/bob_%d\n' % number)
            process.stdin.flush()
            assert process.stdout.readline() == b'rocon:/pr2/bob_%d\n' % number
        process.stdin.close()
        assert process.wait() == 0


def test_errors_come_where_they_were_met():
    done = run_in_shell('$ROCON_URI parse rocon:/pr2 zork rocon:/pc 2>&1')
    assert done.stdout.index('\nrocon_uri: ') < done.stdout.index('\nrocon:/pc\n')


def test_a_line_without_end_takes_no_memory():
    done = run_in_shell('ulimit -v 150000; head -c 200000000 /dev/zero | tr "\\0" a'
                        ' | $ROCON_URI match rocon:/ --in -')
    assert done.returncode == 2 and done.stderr.startswith('<stdin>:1: a rocon URI has at most ')


def heed_interrupts():
    """What a shell starts in the background ignores them, and so does all that this starts."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def test_interrupted():
    with subprocess.Popen([*COMMAND, 'match', 'rocon:/', '--in', '-'], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          env=environment(PYTHONUNBUFFERED='1'),
                          preexec_fn=heed_interrupts) as process:
        process.stdin.write(b'rocon:/pr2\n')
        process.stdin.flush()
        assert process.stdout.readline() == b'rocon:/pr2\n'     # so it is waiting for more
        process.send_signal(signal.SIGINT)
        assert process.wait() == 130
        assert process.stderr.read() == b''


@pytest.mark.parametrize('script', ['scripts/rocon_uri', 'capabilities/scripts/capabilities'])
def test_interrupted_before_it_has_begun(script):
    interrupting = '''
import runpy, sys
class Interrupts:
    def find_spec(self, name, path, target=None):
        if name == 'rocon_uri.cli':
            raise KeyboardInterrupt
sys.meta_path.insert(0, Interrupts())
runpy.run_path(sys.argv[1], run_name='__main__')
'''
    done = subprocess.run([sys.executable, '-c', interrupting, str(ROOT / script)],
                          stderr=subprocess.PIPE)
    assert done.returncode == 130 and done.stderr == b''


def test_the_script_collects_garbage_but_not_in_what_it_imported():
    asking = '''
import gc, runpy, sys
import rocon_uri.cli
rocon_uri.cli.main = lambda: print(gc.isenabled(), gc.get_freeze_count() > 1000)
runpy.run_path(sys.argv[1], run_name='__main__')
'''
    done = subprocess.run([sys.executable, '-c', asking, str(ROOT / 'scripts/rocon_uri')],
                          stdout=subprocess.PIPE, env=environment())
    assert done.returncode == 0 and done.stdout == b'True True\n'


# -- terminals -------------------------------------------------------------------------------------

def run_on_terminal(*arguments, **changes):
    """What a terminal gets to see."""
    ours, theirs = open_terminal()
    with subprocess.Popen([*COMMAND, *arguments], stdin=theirs, stdout=theirs, stderr=theirs,
                          env=environment(**changes)):
        os.close(theirs)
        seen = b''
        while True:
            try:
                more = os.read(ours, 65536)
            except OSError:     # how Linux says that it was closed at the other end
                more = b''
            if not more:
                break
            seen += more
    os.close(ours)
    return seen.decode().replace('\r\n', '\n')


COLOURED = [
    ['parse', 'rocon:/pr2/bob'],
    ['check', 'rocon:/pr2', 'rocon:/kobuki'],
    ['match', 'rocon:/pr2', 'rocon:/kobuki', '--in', FLEET],
    ['match', '--matrix', 'rocon:/pr2', '--in', FLEET],
    ['fields', 'operating_system'],
]


@pytest.mark.parametrize('arguments', COLOURED)
def test_colour_on_a_terminal_and_nowhere_else(arguments):
    plain = run(*arguments, TERM='xterm').stdout
    assert '\x1b' not in plain
    coloured = run_on_terminal(*arguments, TERM='xterm')
    assert '\x1b[' in coloured
    for code in '0', '1', '2', '31', '32', '36':
        coloured = coloured.replace('\x1b[%sm' % code, '')
    assert coloured == plain
    assert run_on_terminal(*arguments, TERM='xterm', NO_COLOR='1') == plain
    assert run_on_terminal(*arguments, TERM='dumb') == plain
    assert '\x1b' in run_on_terminal(*arguments, TERM='xterm', NO_COLOR='')
    assert '\x1b' not in run_on_terminal(*arguments, '--json', TERM='xterm')


# -- start-up --------------------------------------------------------------------------------------

HEAVY = {'argcomplete', 'contextlib', 'difflib', 'logging', 'platform', 'rospkg', 'shutil',
         'typing', 'yaml'}


def loaded_by(program):
    program += '\nimport sys; print(*sys.modules, file=sys.stderr)'
    done = subprocess.run(
        [sys.executable, '-S', '-c', program],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, env=environment())
    return set(done.stderr.split())


def test_a_verb_loads_nothing_that_it_does_not_need():
    loaded = loaded_by("from rocon_uri.cli import main; main(['parse', 'rocon:/pr2/bob'])")
    assert 'rocon_uri.cli.parse' in loaded
    assert not {'rocon_uri.cli.' + verb for verb in VERBS if verb != 'parse'} & loaded
    # that of Python 3.8 loads shutil itself
    assert not HEAVY & (loaded - loaded_by('import argparse'))


# -- around it -------------------------------------------------------------------------------------

def test_help_has_a_line_and_an_example_for_each_verb(capsys):
    main(['--help'])
    overview = capsys.readouterr().out
    for verb in VERBS:
        assert re.search(r'\n    %s\s' % verb, overview)
        main([verb, '--help'])
        described = capsys.readouterr().out
        assert '\n  rocon_uri %s' % verb in described
        assert 'Exit status: ' in described and '--json' in described
        assert 'JSON: ' not in described        # that is for `help json`
        assert max(map(len, described.splitlines())) <= 84
    assert 'Exit status' in overview and max(map(len, overview.splitlines())) <= 80


@pytest.mark.parametrize('argument', [
    '__name:=robots', '__log:=/tmp/x', '_rate:=5', '/chatter:=/other', 'chatter:=other', '~a:=b',
    'a/b:=', 'x:=a=b c'])
def test_remapping_arguments_are_ignored(argument, capsys):
    for arguments in ([argument, 'parse', 'rocon:/pr2'], ['parse', argument, 'rocon:/pr2'],
                      ['parse', 'rocon:/pr2', argument]):
        assert main(arguments) == 0
        assert capsys.readouterr().out.startswith('rocon:/pr2\n')


def test_remapping_arguments_are_those_of_rospy():
    names = pytest.importorskip('rosgraph.names')
    if not hasattr(names, 'is_legal_remap'):
        pytest.skip('an older rosgraph')
    from rocon_uri.cli import _without_remappings
    words = ['___a:=b', '_:=', ':=b', '1a:=b', 'a b:=c', 'a:=b\nc', 'a:b', '\xe4:=b', 'a\xe4:=b',
             'rocon:/pr2/bob', '--in:=x', '-a:=b', '~:=~', '/:=/', 'a:=b:=c']
    assert _without_remappings(words) == [
        word for word in words if not names.is_legal_remap(word)]


def completions(line):
    arguments = {'COMP_LINE': line, 'COMP_POINT': str(len(line)), '_ARGCOMPLETE': '1',
                 '_ARGCOMPLETE_IFS': ' '}
    return run_in_shell('$ROCON_URI 8>&1', **arguments).stdout.split()


def test_shell_completion():
    pytest.importorskip('argcomplete')
    assert set(VERBS) <= set(completions('rocon_uri '))
    assert completions('rocon_uri ch') == ['check']
    assert completions('rocon_uri match --req') == ['--requests-in']
    assert set(completions('rocon_uri fields app')) == {'application_framework'}
    for option in '--ignore', '--explain':
        assert completions('rocon_uri specs check %s launch-m' % option) == ['launch-missing']


def test_shell_completion_finds_the_mark():
    """Argcomplete looks at the first 1024 bytes, of a module too where pip made the script."""
    assert b'PYTHON_ARGCOMPLETE_OK' in (SOURCE / 'rocon_uri/cli/__init__.py').read_bytes()[:1024]


def test_without_argcomplete_a_shell_that_asks_gets_no_traceback(tmp_path):
    (tmp_path / 'argcomplete.py').write_text('raise ImportError\n')
    done = run('parse', 'rocon:/pr2', _ARGCOMPLETE='1',
               PYTHONPATH='%s:%s' % (tmp_path, SOURCE))
    assert done.returncode == 0 and done.stdout.startswith('rocon:/pr2\n')


def test_json_is_one_ascii_document_on_any_terminal():
    done = run('parse', '--json', 'rocon:/\u00e4\udcff', 'rocon:/pr2', PYTHONIOENCODING='ascii')
    assert json.loads(done.stdout)['errors'][0]['value'] == '\u00e4\udcff'


@pytest.mark.parametrize('arguments', [
    ['parse', 'rocon:/pr2'], ['check', 'rocon:/pr2', 'rocon:/robot'],
    ['match', 'rocon:/kobuki', '--in', FLEET], ['fields'], ['rules'], ['platform'],
    ['apps', '--package-path', str(ROOT / 'examples'), '--robot', 'rocon:/cafe_cart'],
    ['specs', 'list', '--package-path', str(ROOT / 'examples')],
    ['specs', 'check', str(ROOT / 'examples')],
    ['specs', 'graph', '--package-path', str(ROOT / 'examples')],
])
def test_the_streams_may_be_those_of_a_program_that_calls_it(arguments):
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        assert main(arguments) in (0, 1)
    assert out.getvalue() or 'no errors' in err.getvalue()


class Broken(io.StringIO):
    def write(self, text):
        raise BrokenPipeError


def test_a_stream_of_a_program_that_calls_it_may_be_closed_at_the_other_end():
    with contextlib.redirect_stdout(Broken()):
        assert main(['fields']) == 0


def test_the_output_of_that_program_is_left_open():
    done = run_in_shell("%s -c '%s'" % (sys.executable, '''
import contextlib, io
from rocon_uri.cli import main
class Broken(io.StringIO):
    def write(self, text):
        raise BrokenPipeError
with contextlib.redirect_stdout(Broken()):
    main(["fields"])
print("still here")'''), PYTHONPATH=str(SOURCE))
    assert (done.stdout, done.stderr) == ('still here\n', '')
