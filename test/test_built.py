"""What catkin makes is imported in every order, and no test of it is skipped where it was built."""
from __future__ import annotations

import os
import subprocess
import sys

import built as asked_for
import pytest
from built import built, unless_built
from sources import ROOT, SOURCE

ORDERS = [
    'capabilities.discovery, rocon_uri.msg',
    'rocon_uri.msg, capabilities.discovery, capabilities.msg',
    'capabilities.msg, capabilities.client, rocon_uri.uri, rocon_uri.msg',
    'rocon_uri.uri, rocon_uri.cli, capabilities.srv, rocon_uri.msg, capabilities.specs.provider',
]


@pytest.mark.parametrize('folder', [ROOT, ROOT / 'test', SOURCE], ids=['root', 'test', 'src'])
@pytest.mark.parametrize('modules', ORDERS)
def test_messages_and_sources_are_found_in_every_order_and_folder(modules, folder):
    built('rocon_uri.msg')
    built('capabilities.msg')
    # as python3 -m pytest there, which puts the folder in front of the path
    done = subprocess.run([sys.executable, '-c', 'import ' + modules], cwd=str(folder),
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert (done.returncode, done.stdout) == (0, b'')


@pytest.mark.parametrize('names, status', [('', 5), ('rocon_uri,capabilities', 2)])
def test_what_was_built_is_not_skipped(names, status, tmp_path):
    environment = dict(os.environ, ROCON_URI_BUILT=names, PYTHONPATH=str(SOURCE), PYTEST_ADDOPTS='')
    modules = [str(ROOT / 'test' / name)
               for name in ('test_messages.py', 'test_capability_messages.py')]
    done = subprocess.run(
        [sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', *modules],
        cwd=str(tmp_path), env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == status, done.stdout


@pytest.mark.parametrize('packages, is_there, is_skipped', [
    ([''], False, True), ([''], True, False), (['rocon_uri'], False, False)])
def test_where_it_was_built_no_test_is_skipped_for_a_tool_that_is_missing(
        packages, is_there, is_skipped, monkeypatch):
    monkeypatch.setattr(asked_for, 'PACKAGES', packages)
    assert unless_built(is_there, 'no catkin').args == (is_skipped,)
