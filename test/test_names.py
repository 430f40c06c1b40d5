"""The names of the package, for programs, interactive shells, editors and type checkers."""
from __future__ import annotations

import ast
import importlib
import os
import re
import subprocess
import sys

import pytest
from sources import ROOT, SOURCE

import rocon_uri
from rocon_uri import workspace

PAGES = [ROOT / 'README.md', *sorted((ROOT / 'doc').glob('*.rst'))]
MISSPELLED = [('rocon_uri', 'prase', 'parse'), ('rocon_uri', 'is_compatibel', 'is_compatible')]


def stub_names(package):
    """The names that a stub exports, with where it takes each from."""
    path = SOURCE.joinpath(*package.split('.')) / '__init__.pyi'
    found = {}
    for node in ast.parse(path.read_text(encoding='utf-8')).body:
        if isinstance(node, ast.ImportFrom):
            assert node.level == 1 and all(alias.name == alias.asname for alias in node.names)
            found.update({alias.name: node.module for alias in node.names})
    return found


def test_the_stub_has_the_names_that_are_imported_when_they_are_used():
    names = {name: module for module, names in rocon_uri._NAMES.items() for name in names}
    stub = stub_names('rocon_uri')
    assert {name: module for name, module in stub.items() if module} == names
    assert set(rocon_uri.__all__) == set(names) - {'__version__'}


@pytest.mark.parametrize('package', ['rocon_uri', 'rocon_uri.sources', 'rocon_uri.apps'])
def test_the_modules_in_a_stub_are_there(package):
    for name, module in stub_names(package).items():
        # which need SQLAlchemy and ROS
        if module is None and name not in ('resource_database', 'announcer'):
            assert getattr(importlib.import_module(package), name).__name__ == (
                '%s.%s' % (package, name))


@pytest.mark.parametrize('package', ['rocon_uri.sources', 'rocon_uri.apps'])
def test_a_stub_has_all_modules_of_the_package(package):
    folder = SOURCE.joinpath(*package.split('.'))
    assert set(stub_names(package)) == {
        path.stem for path in folder.glob('*.py') if path.stem != '__init__'}


def named_modules():
    """The modules of rocon_uri that a page names."""
    for page in PAGES:
        if page.is_file():
            # a class or constant with its module in front is there for what links to it
            text = re.sub(r'(?m)^\.\. (autoclass|data)::.*', '', page.read_text(encoding='utf-8'))
            for name in re.findall(r'\brocon_uri((?:\.[a-z_]+)+)', text):
                path = SOURCE.joinpath('rocon_uri', *name[1:].split('.'))
                if 'resource_database.' in name:    # of functions that are called as modules
                    continue
                if path.with_suffix('.py').is_file() or (path / '__init__.py').is_file():
                    yield 'rocon_uri' + name


@pytest.mark.skipif(not (ROOT / 'doc').is_dir(), reason='the pages are not here')
def test_a_module_that_a_page_names_is_reachable_after_the_import_of_the_package():
    modules = sorted(set(named_modules()))
    assert 'rocon_uri.messages' in modules and 'rocon_uri.sources.ros_names' in modules
    for module in modules:
        above, _, name = module.rpartition('.')
        assert name in stub_names(above), '%s is not in the stub of %s' % (module, above)
    program = 'import rocon_uri\n' + '\n'.join(
        module for module in modules
        if 'resource_database' not in module and module != 'rocon_uri.announcer')     # needs ROS
    subprocess.run([sys.executable, '-c', program], check=True,
                   env=dict(os.environ, PYTHONPATH=str(SOURCE)))


@pytest.mark.parametrize('module, name, meant', MISSPELLED)
def test_a_misspelled_name_has_a_near_miss(module, name, meant):
    done = subprocess.run(
        [sys.executable, '-c', 'import %s; %s.%s' % (module, module, name)], stderr=subprocess.PIPE,
        env=dict(os.environ, PYTHONPATH=str(SOURCE)), universal_newlines=True)
    last = done.stderr.splitlines()[-1]
    assert last.startswith("AttributeError: module '%s' has no attribute '%s'" % (module, name))
    assert last.lower().count('did you mean') == 1 and "'%s'" % meant in last


def test_what_is_not_there_is_an_attribute_error():
    for package in rocon_uri, rocon_uri.sources, rocon_uri.apps:
        for name in 'zork', '__zork__', '_zork':
            assert not hasattr(package, name)


def test_the_version_is_that_of_both_packages():
    from xml.etree import ElementTree
    if not (ROOT / 'package.xml').is_file():
        pytest.skip('not in the source of rocon_uri')
    versions = [ElementTree.parse(str(ROOT / folder / 'package.xml')).findtext('version')
                for folder in ('.', 'capabilities')]
    assert versions[0] == versions[1]
    assert rocon_uri.__version__ == versions[0]
    for changelog in ROOT / 'CHANGELOG.rst', ROOT / 'capabilities' / 'CHANGELOG.rst':
        section = r'^%s \(\d{4}-\d\d-\d\d\)$' % re.escape(versions[0])
        assert re.search(section, changelog.read_text(encoding='utf-8'), re.MULTILINE)


@pytest.mark.parametrize('value, shown', [
    (lambda: rocon_uri.parse('rocon:/pr2/bob*').name, "<Field 'bob*'>"),
    (lambda: rocon_uri.explain('rocon:/pr2', 'rocon:/pc'),
     "<Explanation: 'rocon:/pr2' and 'rocon:/pc' are not compatible>"),
    (lambda: rocon_uri.Vocabulary({'operating_system': [{'linux': ['ours']}]}),
     '<Vocabulary: 0 hardware_platform, 0 application_framework, 2 operating_system>'),
    (lambda: workspace.read_workspace([]),
     '<Workspace: 0 packages, 0 apps, <SpecIndex: 0 interfaces, 0 semantic interfaces, '
     '0 providers>, 0 faults>'),
])
def test_a_repr_says_something(value, shown):
    assert repr(value()) == shown
