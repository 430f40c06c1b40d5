"""The script as users start it: rosrun, in the ROS environment that these tests run in."""
from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from built import ROSBASH, unless_built

EXAMPLES = Path(__file__).resolve().parents[2] / 'examples'


def is_in_ros_package_path() -> bool:
    find = ['rospack', 'find', 'rocon_uri']
    return (shutil.which('rosrun') is not None
            and subprocess.run(find, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL).returncode == 0)


pytestmark = unless_built(is_in_ros_package_path(), 'no ROS environment with rocon_uri in it')


def rosrun(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(['rosrun', 'rocon_uri', 'rocon_uri', *arguments],
                          env=dict(os.environ, **environment), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)


def test_parse_shows_the_fields():
    done = rosrun('parse', 'rocon:/turtlebot2/bob/noetic/focal')
    assert (done.returncode, done.stderr) == (0, '')
    for value in 'turtlebot2', 'bob', 'noetic', 'focal':
        assert value in done.stdout


@pytest.mark.skipif(ROSBASH is None, reason='rosbash is not installed')
def test_tab_offers_the_command_and_the_nodes():
    done = subprocess.run(
        ['bash', '-c', '. "$0"; COMP_WORDS=(rosrun rocon_uri ""); COMP_CWORD=2; COMP_LINE='
         '"rosrun rocon_uri "; "$(complete -p rosrun | sed "s/.*-F \\([^ ]*\\).*/\\1/")"; '
         'printf "%s\n" "${COMPREPLY[@]}"', ROSBASH],
        stdout=subprocess.PIPE, universal_newlines=True, check=True)
    assert sorted(set(done.stdout.split())) == ['announce', 'resource_directory', 'rocon_uri']


@pytest.mark.parametrize('name', ['rocon_uri', 'announce', 'resource_directory'])
def test_the_python_is_the_one_that_sees_ros(name):
    found = subprocess.run(['catkin_find', '--first-only', '--libexec', 'rocon_uri', name],
                           stdout=subprocess.PIPE, universal_newlines=True, check=True)
    with open(found.stdout.strip()) as script:
        assert script.readline() == '#!/usr/bin/python3\n'


def test_parse_of_a_bad_uri_exits_2():
    done = rosrun('parse', 'rocon:/turtelbot2')
    assert (done.returncode, done.stdout) == (2, '')
    assert "did you mean 'turtlebot2'" in done.stderr


@pytest.mark.parametrize('robot, status', [('rocon:/pr2/bob/noetic/focal', 0),
                                           ('rocon:/pr2/bob/noetic/bookworm', 1)])
def test_check_exits_with_the_answer(robot, status):
    done = rosrun('check', 'rocon:/*/*/ros/ubuntu', robot)
    assert (done.returncode, done.stderr) == (status, '')
    assert done.stdout


def test_match_finds_the_robots_of_the_example_fleet():
    done = rosrun('match', 'rocon:/turtlebot2', '--in', str(EXAMPLES / 'fleet.txt'))
    assert (done.returncode, done.stderr) == (0, '')
    assert 'rocon:/turtlebot2/' in done.stdout


def test_another_python_first_on_the_path_changes_nothing(tmp_path):
    for name in 'python', 'python3':
        (tmp_path / name).write_text('#!/bin/sh\necho wrong Python >&2\nexit 99\n')
        (tmp_path / name).chmod(0o755)
    path = '%s:%s' % (tmp_path, os.environ['PATH'])
    done = rosrun('parse', 'rocon:/pr2', PATH=path)
    assert (done.returncode, done.stderr) == (0, '')


def test_import_needs_no_ros_until_messages_do():
    program = ('import sys, rocon_uri\n'
               'ros = {"genpy", "rosgraph", "roslib", "rospkg", "rospy", "yaml"}\n'
               'assert not ros & set(sys.modules), ros & set(sys.modules)\n'
               'from rocon_uri.msg import RoconURI\n')
    subprocess.run([sys.executable, '-c', program], check=True)
