"""The hook that https://pre-commit.com installs from this repository."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys

import pytest
from sources import ROOT

from rocon_uri.sources.yaml_source import load_file

PRE_COMMIT = ROOT / 'build' / 'lint' / 'bin' / 'pre-commit'


def test_the_hook_is_given_the_files_that_the_linter_knows():
    (hook,) = load_file(ROOT / '.pre-commit-hooks.yaml')
    assert hook['language'] == 'python' and hook['require_serial'] is True
    for name in ('package.xml', 'ours/package.xml', 'a/b.rapp', 'a.app', 'a.installed',
                 'a.interactions', 'a.launch', 'a.yaml'):
        assert re.search(hook['files'], name)
    for name in 'a.xml', 'mypackage.xml', 'a.rapp.orig', 'a.py', 'app':
        assert not re.search(hook['files'], name)


def git(folder, *arguments):
    subprocess.run(['git', *arguments], cwd=str(folder), check=True, stdout=subprocess.DEVNULL)


def test_pre_commit_runs_it(tmp_path):
    if shutil.which('git') is None:
        pytest.skip('git is not installed')
    if not PRE_COMMIT.exists() or not (ROOT / '.git').exists():
        if os.environ.get('CI') and sys.version_info >= (3, 10):    # which it needs
            pytest.fail('pre-commit is not installed, or this is no clone')
        pytest.skip('pre-commit is not installed, or this is no clone')
    repository = tmp_path / 'ours'
    shutil.copytree(str(ROOT / 'examples' / 'workspace'), str(repository))
    (repository / 'settings.yaml').write_text('[')      # none of ours
    git(repository, 'init', '--quiet')
    git(repository, 'add', '.')

    around = {key: value for key, value in os.environ.items() if not key.startswith('PYTHON')}

    def try_hook():
        run = subprocess.run(
            [str(PRE_COMMIT), 'try-repo', str(ROOT), 'rocon-uri-check', '--all-files'],
            cwd=str(repository), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            env={**around, 'PRE_COMMIT_HOME': str(tmp_path / 'home'), 'ROS_PACKAGE_PATH': '',
                 'GIT_CONFIG_COUNT': '1', 'GIT_CONFIG_KEY_0': 'safe.directory',
                 'GIT_CONFIG_VALUE_0': '*'},
            universal_newlines=True)
        return run.returncode, run.stdout

    status, output = try_hook()
    if 'rocon_uri specs check' not in output and not os.environ.get('CI'):
        pytest.skip('the hook cannot be installed: ' + output[-200:])
    assert status == 0, output
    provider = repository / 'cafe_capabilities' / 'providers' / 'espeak.yaml'
    provider.write_text(provider.read_text().replace('espeak.launch', 'gone.launch'))
    git(repository, 'add', '.')
    status, output = try_hook()
    assert status == 1
    assert 'cafe_capabilities/providers/espeak.yaml:8:14: error: launch file' in output
