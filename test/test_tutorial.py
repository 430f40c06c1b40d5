"""Who does what the tutorial says, step by step, gets what it shows."""
from __future__ import annotations

import os
import re
import subprocess
import textwrap

import pytest
from sources import ROOT

PAGE = ROOT / 'doc' / 'tutorial.rst'
BLOCK = re.compile(r'(?:^``([^`]+)``(?:, before ``([^`]+)``)?:\n\n)?'
                   r'^\.\. code-block:: (\w+)\n\n((?:   .*\n|\n)+)', re.MULTILINE)
COMMAND = re.compile(r'^\$ (.*)\n((?:(?!\$ ).*\n)*)', re.MULTILINE)

pytestmark = pytest.mark.skipif(     # or else the script does not find the package
    not (PAGE.is_file() and (ROOT / 'src').is_dir()), reason='not in the source of rocon_uri')


def write(folder, name, before, text):
    """A file that the page shows; or lines of it that belong before one that is there."""
    path = folder / name
    if before:
        whole = path.read_text()
        assert whole.count('  %s\n' % before) == 1
        text = whole.replace('  %s\n' % before,
                             '%s  %s\n' % (textwrap.indent(text, '    '), before))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def test_each_step_does_what_the_page_shows(tmp_path):
    (tmp_path / 'bin').mkdir()
    (tmp_path / 'bin' / 'rocon_uri').symlink_to(ROOT / 'scripts' / 'rocon_uri')
    environment = dict(os.environ, ROS_PACKAGE_PATH=str(tmp_path / 'src'), ROCON_URI_RULES='',
                       PATH='%s:%s' % (tmp_path / 'bin', os.environ['PATH']))
    commands = 0
    for name, before, language, body in BLOCK.findall(PAGE.read_text(encoding='utf-8')):
        text = textwrap.dedent(body).strip('\n') + '\n'
        if name:
            write(tmp_path, name, before, text)
            continue
        assert language == 'console'
        for command, output in COMMAND.findall(text):
            done = subprocess.run(
                ['bash', '-c', command], cwd=str(tmp_path), env=environment,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
            assert done.stdout == output, command
            commands += 1
    assert commands == 8


def test_the_packages_that_were_on_the_path_stay_there(tmp_path):
    """Those of ROS, which the last step needs."""
    [command] = re.findall(r'^   \$ (export ROS_PACKAGE_PATH=.*)$',
                           PAGE.read_text(encoding='utf-8'), re.MULTILINE)
    done = subprocess.run(
        ['bash', '-c', command + '; echo $ROS_PACKAGE_PATH'], cwd=str(tmp_path),
        env=dict(os.environ, ROS_PACKAGE_PATH='/opt/ros/noetic/share'),
        stdout=subprocess.PIPE, universal_newlines=True)
    assert done.stdout == '%s/src:/opt/ros/noetic/share\n' % tmp_path
