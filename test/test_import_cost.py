"""What is loaded, and when: importing is cheap, and ROS and YAML are not needed for it."""
from __future__ import annotations

import os
import subprocess
import sys

import pytest
from sources import SOURCE

ROS = {'rospy', 'roslib', 'rosgraph', 'rospkg', 'catkin_pkg', 'genpy', 'rosdep2', 'distro'}
SLOW = {'json', 'logging', 'difflib', 'typing', 'platform', 'subprocess', 'argparse', 'inspect',
        'dataclasses', 'urllib', 'xml', 'pathlib', 'tempfile'}
AUTOMATA = {'rocon_uri.regular.language', 'rocon_uri.regular.syntax', 'rocon_uri.regular.tree',
            'rocon_uri.regular.product', 'rocon_uri.regular.intersection'}


def loaded_by(code):
    """The modules that code loads, without those that an empty program has."""
    def modules(program):
        done = subprocess.run(
            [sys.executable, '-S', '-c', program + '\nimport sys; print(*sys.modules)'],
            stdout=subprocess.PIPE, universal_newlines=True, check=True,
            env={**os.environ, 'PYTHONPATH': str(SOURCE), 'ROCON_URI_RULES': ''})
        return set(done.stdout.split())
    return modules(code) - modules('')


def test_importing_loads_nothing_that_is_slow():
    loaded = loaded_by('from rocon_uri import *')
    assert 'rocon_uri.uri' in loaded
    assert not loaded & (ROS | SLOW | {'yaml'})
    assert not {name for name in loaded if name.partition('.')[0] in ROS | SLOW}


def test_importing_loads_only_what_parsing_and_comparing_stand_on():
    loaded = {name for name in loaded_by('from rocon_uri import *') if name.startswith('rocon_uri')}
    assert not loaded & (AUTOMATA | {
        'rocon_uri.exported_rules', 'rocon_uri.yaml_source', 'rocon_uri.messages',
        'rocon_uri.rapps', 'rocon_uri.lint', 'rocon_uri.cli'})


READING = '''
import rocon_uri
uri = rocon_uri.parse('rocon://turtlebot2|pr2/bob*/noetic/focal#rocon_apps/teleop')
assert rocon_uri.is_compatible(uri, 'rocon:/robot/bob7')
'''


def test_parsing_and_comparing_load_neither_ros_nor_yaml():
    loaded = loaded_by(READING + '''
assert uri.short and uri.to_rfc3986() and uri == rocon_uri.parse(str(uri))
assert rocon_uri.explain(uri, 'rocon:/robot/b*')
for text in ('rocon:/pr2/3bob', 'rocon:/pr2|', 'rocon:/pr2 '):
    try:
        rocon_uri.parse(text)
    except rocon_uri.RoconURIValueError:
        pass
''')
    assert not {name for name in loaded if name.partition('.')[0] in ROS | {'yaml', 'logging'}}


def test_a_verb_that_reads_no_file_loads_nothing_for_it():
    loaded = loaded_by("from rocon_uri.cli import main\nmain(['parse', 'rocon:/pr2/bob'])")
    assert 'rocon_uri.cli.given' in loaded
    assert not loaded & {'rocon_uri.cli.lines', 'encodings.ascii'}


def test_only_a_matrix_loads_what_the_size_of_a_terminal_takes():
    loaded = loaded_by('from rocon_uri.cli import main\n'
                       "main(['match', 'rocon:/', '--in', '/dev/null'])")
    assert 'rocon_uri.cli.matrix' in loaded
    assert 'shutil' not in loaded - loaded_by('import argparse')    # which loads it on Python 3.8


def test_only_expressions_load_automata():
    assert not loaded_by(READING) & AUTOMATA
    assert AUTOMATA & loaded_by("import rocon_uri\nrocon_uri.parse('rocon:/*/bob[0-9]')")


@pytest.mark.parametrize('shown', ['str(error)', 'error.suggestions', 'error.pretty()'])
def test_near_misses_are_looked_for_when_an_error_is_looked_at(shown):
    code = '''
import rocon_uri
try:
    rocon_uri.parse('rocon:/turtelbot2', rocon_uri.Vocabulary.bundled())
except rocon_uri.RoconURIValueError as error:
    %s
'''
    assert 'difflib' not in loaded_by(code % 'error.value')
    assert 'difflib' in loaded_by(code % shown)


def test_a_file_of_rules_loads_yaml(tmp_path):
    path = tmp_path / 'rules.yaml'
    path.write_text('hardware_platform: [bender]\n')
    code = '''
import os, sys
sys.path += %r
os.environ['ROCON_URI_RULES'] = %r
import rocon_uri
assert rocon_uri.parse('rocon:/bender')
''' % (sys.path, str(path))
    assert 'yaml' in loaded_by(code)
