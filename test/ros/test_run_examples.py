"""What the examples show once they have built the package."""
from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest
from built import unless_built

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / 'examples'


def finds_both_packages() -> bool:
    return shutil.which('rosrun') is not None and all(
        subprocess.run(['rospack', 'find', name], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL).returncode == 0
        for name in ('rocon_uri', 'capabilities'))


pytestmark = [
    unless_built(finds_both_packages(), 'no ROS environment with both packages in it'),
    pytest.mark.skipif(not (EXAMPLES / 'run').is_file(), reason='examples/run is not here')]


def test_the_demo_counts_the_uses_of_a_camera_until_nobody_needs_it() -> None:
    done = subprocess.run(['/usr/bin/python3', '-B', str(EXAMPLES / 'demo.py')],
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True)
    assert done.returncode == 0, done.stderr
    steps = [text.split('\n', 1) for text in re.split(r'\n# ', done.stdout)[1:]]
    shown = [' '.join(text.split()) for _, text in steps]
    assert 'demo_robot/Base * demo_robot/base demo_robot/Camera * demo_robot/camera' in shown[0]
    assert 'starts demo_robot/Base by demo_robot/base starts demo_robot/Camera' in shown[1]
    for text, uses in zip(shown[2:4], ('2 uses', '1 use')):
        assert 'demo_robot/base; wanted by demo_robot/Camera' in text
        assert text.endswith('demo_robot/camera; wanted by ' + uses)
    assert len(shown) == 5 and shown[4].endswith('nothing runs')


def test_the_example_shows_the_fleet_by_apps_and_the_apps_of_one_robot() -> None:
    text = (EXAMPLES / 'run').read_text(encoding='utf-8').replace('\\\n', '')
    commands = [shlex.split(line) for line in re.findall(r'(rosrun .*?)(?: \|\| exit)?\n', text)]
    outputs = [subprocess.run(command, cwd=str(ROOT), stdout=subprocess.PIPE,
                              env=dict(os.environ, ROCON_URI_RULES=''), check=True,
                              universal_newlines=True).stdout for command in commands]
    assert len(outputs) == 2
    assert '\nx x x x . . x x . . . . . . . .  rocon:/turtlebot2/cybernetic_pirate/' in outputs[0]
    assert outputs[1].startswith(
        'rocon:/turtlebot2/cybernetic_pirate/noetic/focal can run 2 of 7 apps:\n')
