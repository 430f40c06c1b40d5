"""What the source promises: Python 3.8, types that fit, and nothing that a linter minds."""
from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ['src', 'scripts', 'test', 'benchmark', 'setup.py']


def check(program: str, *arguments: str) -> None:
    if shutil.which(program) is None:
        pytest.skip('%s is not installed' % program)
    done = subprocess.run([program, *arguments], cwd=str(ROOT), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True)
    assert done.returncode == 0, done.stdout


def test_runs_on_python_3_8():
    check('vermin', '--target=3.8-', '--no-tips', '--violations', *SOURCES)


def test_is_clean():
    check('ruff', 'check', '--no-cache', *SOURCES)


def test_types_fit_together():
    check('mypy', '--no-incremental')


def test_is_a_catkin_package_as_it_should_be(tmp_path: Path) -> None:
    # by a path whose end is its name, as in a workspace
    (tmp_path / 'rocon_uri').symlink_to(ROOT)
    check('catkin_lint', '-W2', '--strict', '--offline', str(tmp_path / 'rocon_uri'))
