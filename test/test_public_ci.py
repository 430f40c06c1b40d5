"""What a public CI and a builder of documentation are told: commands and files that are there."""
from __future__ import annotations

import configparser
import re
from typing import Any

import pytest
from sources import ROOT

yaml = pytest.importorskip('yaml', reason='PyYAML is not installed')

WORKFLOW = ROOT / '.github' / 'workflows' / 'ci.yml'
READTHEDOCS = ROOT / '.readthedocs.yaml'
pytestmark = pytest.mark.skipif(not WORKFLOW.is_file(), reason='not in the source of rocon_uri')


def loaded(path: Any) -> Any:
    return yaml.safe_load(path.read_text(encoding='utf-8'))


def test_the_workflow_runs_the_two_commands_of_readme_on_its_two_systems() -> None:
    job = loaded(WORKFLOW)['jobs']['test']
    assert job['strategy']['matrix']['image'] == ['debian:12', 'ros:noetic-ros-core-focal']
    assert job['container'] == '${{ matrix.image }}'
    commands = [step['run'] for step in job['steps'] if 'run' in step]
    named = [command for command in commands if command.startswith('bash ')]
    assert named == ['bash examples/run', 'bash test/run']
    section = (ROOT / 'README.md').read_text(encoding='utf-8').split('## See it run')[1]
    assert re.findall(r'^    (bash \S+)$', section, re.MULTILINE)[:2] == named


def test_the_documentation_is_built_as_the_tests_build_it() -> None:
    settings = loaded(READTHEDOCS)
    assert settings['sphinx'] == {'configuration': 'doc/conf.py', 'fail_on_warning': True}
    assert (ROOT / settings['sphinx']['configuration']).is_file()
    setup = configparser.ConfigParser()
    setup.read(str(ROOT / 'setup.cfg'))
    [install] = settings['python']['install']
    assert set(install['extra_requirements']) <= set(setup['options.extras_require'])
