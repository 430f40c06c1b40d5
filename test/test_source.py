"""What the source promises: Python 3.8, types that fit, and nothing that a linter minds."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from sources import ROOT

SOURCES = ['src', 'scripts', 'test', 'benchmark', 'setup.py']

pytestmark = pytest.mark.skipif(not (ROOT / 'src').is_dir(), reason='there is no source here')

TYPES = [
    ('concert_name', 'str'), ('hardware_platform', 'ValuesField'), ('name', 'NameField'),
    ('application_framework', 'ValuesField'), ('operating_system', 'ValuesField'),
    ('rocon_app', 'str'), ('rapp', 'str'), ('vocabulary', 'Vocabulary'),
    ('read_with_one_slash', 'bool'), ('short', 'str'), ('name.is_any', 'bool')]


def found(program: str) -> str:
    where = [str(ROOT / 'build/lint/bin'), os.environ.get('PATH', '')]      # of that version first
    path = shutil.which(program, path=os.pathsep.join(where))
    if path is None:
        pytest.skip('%s is not installed' % program)
    return path


def check(program: str, *arguments: str) -> None:
    done = subprocess.run([found(program), *arguments], cwd=str(ROOT), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True)
    assert done.returncode == 0, done.stdout


def test_runs_on_python_3_8():
    check('vermin', '--target=3.8-', '--no-tips', '--violations', *SOURCES)


def test_is_clean():
    check('ruff', 'check', '--no-cache', *SOURCES)


def test_types_fit_together():
    check('mypy', '--no-incremental')


@pytest.mark.parametrize('name', ['rocon_uri', 'rocon_uri/capabilities'])
def test_is_a_catkin_package_as_it_should_be(
        name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('ROS_PACKAGE_PATH', raising=False)    # or it is found there, too
    # by a path whose end is its name, as in a workspace
    (tmp_path / 'rocon_uri').symlink_to(ROOT)
    check('catkin_lint', '-W2', '--strict', '--offline', str(tmp_path / name))


def test_those_who_use_it_get_its_types(tmp_path: Path) -> None:
    program = tmp_path / 'program.py'
    program.write_text('\n'.join(
        ['import rocon_uri', "uri = rocon_uri.parse('rocon:/pr2')"]
        + ['reveal_type(uri.%s)  # %s' % (attribute, type_name) for attribute, type_name in TYPES]))
    done = subprocess.run(
        [found('mypy'), '--strict', '--no-incremental', '--follow-imports=silent', str(program)],
        env=dict(os.environ, MYPYPATH=str(ROOT / 'src')), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, universal_newlines=True)
    revealed = re.findall('Revealed type is "(?:[a-z_]+[.])*([A-Za-z]+)"', done.stdout)
    assert revealed == [type_name for _, type_name in TYPES], done.stdout


def test_who_misspells_a_name_is_told_by_mypy(tmp_path: Path) -> None:
    program = tmp_path / 'program.py'
    program.write_text('\n'.join([
        'import rocon_uri', "rocon_uri.prase('rocon:/pr2')", 'rocon_uri.mesages.to_msg',
        'rocon_uri.sources.locatde', 'rocon_uri.messages, rocon_uri.rapps, rocon_uri.__version__',
        'rocon_uri.sources.located, rocon_uri.apps.runnable, rocon_uri.resource_index']))
    done = subprocess.run(
        [found('mypy'), '--strict', '--no-incremental', '--follow-imports=silent', str(program)],
        env=dict(os.environ, MYPYPATH=str(ROOT / 'src')), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, universal_newlines=True)
    assert re.findall(r'program.py:(\d+): error: Module has no attribute "(\w+)"', done.stdout) == [
        ('2', 'prase'), ('3', 'mesages'), ('4', 'locatde')], done.stdout
