"""What the shell completes, in an interactive bash or zsh as people use it."""
from __future__ import annotations

import os
import re
import select
import shutil
import subprocess
import sys
import time

import pytest
from built import ROSBASH
from sources import ROOT, SOURCE
from terminal import open_terminal

from rocon_uri.cli.completion import uris

SCRIPT = str(ROOT / 'scripts' / 'rocon_uri')
COMPLETION = ROOT / 'completion' / 'rocon_uri'
WORKSPACE = str(ROOT / 'examples' / 'workspace')
PATIENCE = 60       # seconds after which a shell that says nothing is given up

needs_bash = pytest.mark.skipif(
    not (COMPLETION.is_file() and (ROOT / 'src').is_dir()) or shutil.which('bash') is None,
    reason='no bash, or not in the source of rocon_uri')


@pytest.mark.parametrize('prefix, some, others', [
    ('', ['rocon:/'], []),
    ('rocon:', ['rocon:/'], []),
    ('http', [], ['rocon:/']),
    ('rocon:/turt', ['rocon:/turtlebot2', 'rocon:/turtlebot4'], ['rocon:/pr2']),
    ('rocon:/pr2|turt', ['rocon:/pr2|turtlebot2'], ['rocon:/turtlebot2']),
    ('rocon:/pr2/', [], ['rocon:/pr2/noetic']),
    ('rocon:/pr2/bob/noe', ['rocon:/pr2/bob/noetic'], []),
    ('rocon:/pr2/bob/noetic/fo', ['rocon:/pr2/bob/noetic/focal'], []),
    ('rocon:/pr2/bob/noetic/focal/', [], []),
    ('rocon://north/turt', ['rocon://north/turtlebot2'], []),
    ('rocon://nor', [], []),
])
def test_the_next_value_of_a_uri_is_offered(prefix, some, others):
    offered = uris(prefix)
    assert set(some) <= set(offered) and not set(others) & set(offered)
    assert some or not offered


def offered_for(line, **changes):
    """What the command offers, asked as argcomplete's function for bash asks it."""
    environment = {'COMP_LINE': line, 'COMP_POINT': str(len(line)), '_ARGCOMPLETE': '1',
                   '_ARGCOMPLETE_IFS': ' ', 'PYTHONPATH': str(SOURCE), **changes}
    return subprocess.run(
        ['bash', '-c', '"%s" "%s" 8>&1 9>/dev/null' % (sys.executable, SCRIPT)],
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        env={**os.environ, **environment}, universal_newlines=True).stdout.split()


@needs_bash
def test_apps_and_specs_on_the_package_path_are_offered():
    pytest.importorskip('argcomplete')
    path = {'ROS_PACKAGE_PATH': WORKSPACE}
    assert offered_for('rocon_uri apps cafe_rapps/pa', **path) == ['cafe_rapps/patrol']
    assert offered_for('rocon_uri specs show cafe_capabilities/esp', **path) == [
        'cafe_capabilities/espeak']
    assert offered_for('rocon_uri specs graph --app cafe_cart/ri', **path) == ['cafe_cart/ring']


@needs_bash
def test_where_argcomplete_is_missing_nothing_is_done(tmp_path):
    (tmp_path / 'argcomplete.py').write_text('raise ImportError\n')
    assert offered_for('rocon_uri fields ', PYTHONPATH='%s:%s' % (tmp_path, SOURCE)) == []


class Shell:
    """An interactive shell that has read our completion."""

    def __init__(self, folder, command, **changes):
        (folder / 'bin').mkdir()
        (folder / 'bin' / 'rocon_uri').symlink_to(SCRIPT)
        self._ours, theirs = open_terminal()
        self._process = subprocess.Popen(
            command, stdin=theirs, stdout=theirs, stderr=theirs, start_new_session=True,
            cwd=str(folder), env=dict(os.environ, TERM='dumb', ROS_PACKAGE_PATH=WORKSPACE,
                                      PATH='%s:%s' % (folder / 'bin', os.environ['PATH']),
                                      HISTFILE='', **changes))
        os.close(theirs)
        self.read_until('READY$ ')

    def read_until(self, text):
        """What is printed up to a text."""
        seen, end = '', time.monotonic() + PATIENCE
        while text not in seen:
            ready, _, _ = select.select([self._ours], [], [], max(0, end - time.monotonic()))
            assert ready, 'no %r in %r' % (text, seen)
            seen += os.read(self._ours, 65536).decode()
        return seen

    def type(self, keys, until):
        """What is printed after some keys up to a text; the line is dropped then."""
        os.write(self._ours, keys.encode())
        seen = self.read_until(until)
        os.write(self._ours, b'\x15\n')        # Ctrl-U
        self.read_until('READY$ ')
        return seen

    def close(self):
        self._process.kill()
        self._process.wait()
        os.close(self._ours)


@pytest.fixture
def shell(tmp_path):
    pytest.importorskip('argcomplete')
    (tmp_path / 'rc').write_text(
        "PS1='READY$ '\nbind 'set show-all-if-ambiguous on'\nbind 'set page-completions off'\n"
        "bind 'set enable-bracketed-paste off'\nbind 'set completion-query-items 0'\n"
        '[ ! -r /usr/share/bash-completion/bash_completion ] '
        '|| . /usr/share/bash-completion/bash_completion\n. %s\n' % COMPLETION)
    shell = Shell(tmp_path, ['bash', '--noprofile', '--rcfile', str(tmp_path / 'rc'), '-i'],
                  INPUTRC='/dev/null')
    yield shell
    shell.close()


@pytest.fixture
def zsh(tmp_path):
    """An interactive zsh that has read the line of the documentation, and nothing of the system."""
    pytest.importorskip('argcomplete')
    if shutil.which('zsh') is None:
        pytest.skip('zsh is not installed')
    page = (ROOT / 'doc' / 'command_line.rst').read_text(encoding='utf-8')
    line = re.search('^   (autoload .*bashcompinit.*)$', page, re.MULTILINE).group(1)
    if shutil.which('register-python-argcomplete') is None:
        line = line.replace('register-python-argcomplete', 'register-python-argcomplete3')
    (tmp_path / '.zshrc').write_text("PS1='READY$ '\n%s\n" % line)
    shell = Shell(tmp_path, ['zsh', '-o', 'NO_GLOBAL_RCS', '-i'], ZDOTDIR=str(tmp_path))
    yield shell
    shell.close()


@needs_bash
def test_tab_completes_verbs_options_and_values(shell):
    shell.type('rocon_uri pla\t', 'rocon_uri platform ')
    shell.type('rocon_uri match --req\t', '--requests-in ')
    shell.type('rocon_uri fields oper\t', 'operating_system ')
    shell.type('rocon_uri apps --robot rocon:/waiter\t', 'rocon:/waiterbot')
    assert 'turtlebot4' in shell.type('rocon_uri apps --robot rocon:/turt\t', 'turtlebot4')
    shell.type('rocon_uri apps cafe_rapps/pa\t', 'cafe_rapps/patrol ')


@needs_bash
def test_tab_completes_in_zsh_after_the_documented_line(zsh):
    zsh.type('rocon_uri pla\t', 'rocon_uri platform ')
    zsh.type('rocon_uri match --req\t', '--requests-in ')
    zsh.type('rocon_uri apps --robot rocon:/waiter\t', 'rocon:/waiterbot')
    zsh.type('rocon_uri apps cafe_rapps/pa\t', 'cafe_rapps/patrol ')


@needs_bash
@pytest.mark.skipif(ROSBASH is None, reason='rosbash is not installed')
def test_tab_completes_behind_rosrun_and_leaves_all_else_to_rosbash(shell):
    shell.type('roscd cafe_car\t', 'cafe_cart/')
    shell.type('rosrun rocon_uri rocon_uri pla\t', 'rocon_uri platform ')
    shell.type('rosrun rocon_uri rocon_uri apps cafe_rapps/pa\t', 'cafe_rapps/patrol ')
    shell.type('rosrun --prefix time rocon_uri rocon_uri fields oper\t', 'operating_system ')
    shell.type('rosrun cafe_car\t', 'cafe_cart ')


@needs_bash
@pytest.mark.skipif(ROSBASH is None, reason='rosbash is not installed')
def test_tab_completes_the_command_of_the_nested_package_behind_rosrun(shell):
    shell.type('roscd cafe_car\t', 'cafe_cart/')
    shell.type('rosrun capabilities capabilities statu\t', 'capabilities status ')
    shell.type('rosrun capabilities capabilities status --js\t', '--json ')
    shell.type('rosrun --prefix time capabilities capabilities wat\t', 'capabilities watch ')


@needs_bash
@pytest.mark.skipif(shutil.which('man') is None, reason='man is not installed')
def test_the_manual_page_is_made_from_the_help(tmp_path):
    page = tmp_path / 'rocon_uri.1'
    subprocess.run([sys.executable, '-B', str(ROOT / 'doc' / 'make_man.py'), str(page)], check=True)
    done = subprocess.run(['man', '--warnings', '-l', str(page)], stdin=subprocess.DEVNULL,
                          env=dict(os.environ, MANWIDTH='100', LC_ALL='C.UTF-8', PAGER='cat'),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
    assert (done.returncode, done.stderr) == (0, '')
    shown = re.sub('.\b', '', done.stdout)
    for line in '   rocon_uri specs check', '       --package-path PATH', '         2  something':
        assert line in shown
