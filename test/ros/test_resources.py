"""Rocon URIs survive the wire: two nodes on a master of their own, started by rostest."""
from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from built import built

NODES = Path(__file__).resolve().parent / 'resources'


def test_every_field_of_every_resource_arrives(tmp_path):
    built('rocon_uri.msg')
    if shutil.which('rostest') is None:
        pytest.skip('rostest is not installed')
    package = tmp_path / 'resources'
    shutil.copytree(str(NODES), str(package))
    for node in 'resource_talker', 'resource_listener':
        (package / node).chmod(0o755)
    paths = '%s:%s' % (package, os.environ.get('ROS_PACKAGE_PATH', ''))
    done = subprocess.run(
        ['rostest', '--text', str(package / 'resources.test')], stdin=subprocess.DEVNULL,
        env=dict(os.environ, ROS_PACKAGE_PATH=paths, ROS_HOME=str(tmp_path / 'ros_home'),
                 ROS_IP='127.0.0.1'),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    assert done.returncode == 0, done.stdout
    assert ' * RESULT: SUCCESS' in done.stdout and ' * TESTS: 1' in done.stdout
