"""The modules import each other one way only, and say ``Any`` where data is unread only."""
from __future__ import annotations

import ast
import re
import shutil
import subprocess
from pathlib import Path
from typing import Dict, Iterator, List, Set

import pytest
from sources import ROOT

pytestmark = pytest.mark.skipif(not (ROOT / 'src').is_dir(), reason='there is no source here')

MODULES: Dict[str, Path] = {}
for _path in sorted((ROOT / 'src').rglob('*.py')):
    _name = '.'.join(_path.relative_to(ROOT / 'src').with_suffix('').parts)
    MODULES[_name[:-len('.__init__')] if _name.endswith('.__init__') else _name] = _path

#: Levels of rocon_uri: a module imports from its own level and those above it in this list.
LEVELS = (
    ('sources',),
    ('exceptions', 'grammar', 'regular', 'exported_rules', 'version'),
    ('field_vocabulary', 'vocabulary', 'name_pattern'),
    ('alternatives', 'parts', 'field'),
    ('reading', 'uri'),
    ('compatibility', 'misplaced_name', 'name_index', 'messages', 'platform'),
    ('resource_index',),
    ('resource_database',),
    ('announcement', 'resource_directory'),
    ('shared_directory',),
    ('apps',),
    ('workspace', 'spec_graph', 'spec_picture'),
    ('lint',),
    ('cli', 'announcer', 'directory_node'),
    ('__main__',),
)
LEVEL_OF = {name: level for level, names in enumerate(LEVELS) for name in names}
#: one line each that keeps an earlier path importable
EARLIER_PATHS = {'rocon_uri.rapps', 'rocon_uri.ros_names', 'rocon_uri.yaml_source',
                 'capabilities.faults', 'capabilities.providers'}
RUNTIME = {'server', 'client', 'service_discovery', 'launch_manager'}

ANY_AT_MOST = 49


def imported(module: str) -> Iterator[str]:
    """The modules of ours that one imports, anywhere in it."""
    package = module if MODULES[module].name == '__init__.py' else module.rpartition('.')[0]
    for node in ast.walk(ast.parse(MODULES[module].read_text(encoding='utf-8'))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = package.split('.')[:len(package.split('.')) - node.level + 1]
            base = '.'.join((above if node.level else []) + ([node.module] if node.module else []))
            names = ['%s.%s' % (base, alias.name) for alias in node.names] + [base]
        else:
            continue
        for index, name in enumerate(names):
            # the package of what is imported counts only where a name of its own is meant
            if name in MODULES and not (isinstance(node, ast.ImportFrom) and index == len(names) - 1
                                        and all(other in MODULES for other in names[:-1])):
                yield name


GRAPH: Dict[str, List[str]] = {module: sorted(set(imported(module)) - {module})
                               for module in MODULES}


def test_there_is_no_circle() -> None:
    reached: Dict[str, Set[str]] = {}
    for module in GRAPH:
        found: Set[str] = set()
        waiting = [module]
        while waiting:
            for below in GRAPH[waiting.pop()]:
                if below not in found:
                    found.add(below)
                    waiting.append(below)
        reached[module] = found
    circles = {tuple(sorted(other for other in reached[module] if module in reached[other]))
               for module in reached if module in reached[module]}
    assert circles == set()


def is_forbidden(module: str, below: str) -> bool:
    package, _, rest = module.partition('.')
    other, _, below_rest = below.partition('.')
    if other == 'capabilities' and below_rest in RUNTIME and package != 'capabilities':
        return not rest.startswith(('cli', 'directory_node'))
    if package == 'capabilities':
        return other != 'capabilities' and not below_rest.startswith('sources.')
    if module in EARLIER_PATHS or not rest:
        return False
    level = LEVEL_OF[rest.partition('.')[0]]
    if other == 'capabilities':     # the pure part, on which apps stands
        return level < LEVEL_OF['apps']
    return not below_rest or LEVEL_OF[below_rest.partition('.')[0]] > level


def test_arrows_run_one_way() -> None:
    forbidden = {(module, below) for module in GRAPH for below in GRAPH[module]
                 if is_forbidden(module, below)}
    assert forbidden == set()


def test_no_file_is_executable_that_rosrun_would_find() -> None:
    """``rosrun rocon_uri <TAB>`` offers every executable file below the folder of the package."""
    for folder in 'benchmark', 'capabilities', 'doc', 'examples', 'test':
        executable = [str(path) for path in (ROOT / folder).rglob('*')
                      if path.is_file() and path.stat().st_mode & 0o111]
        assert executable == []


@pytest.mark.skipif(shutil.which('git') is None, reason='git is not installed')
def test_an_sdist_has_every_folder() -> None:
    grafted = set(re.findall(r'^graft (\S+)$', (ROOT / 'MANIFEST.in').read_text(), re.MULTILINE))
    tracked = subprocess.run(['git', 'ls-tree', '-d', '--name-only', 'HEAD'], cwd=str(ROOT),
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                             universal_newlines=True).stdout.split()
    if 'src' not in tracked:
        pytest.skip('this is not a clone')
    assert set(tracked) - {'src'} == grafted


def test_every_module_has_a_level() -> None:
    names = {module.split('.')[1] for module in MODULES
             if module.startswith('rocon_uri.') and module not in EARLIER_PATHS}
    assert names <= set(LEVEL_OF)


def test_any_is_for_what_is_unread() -> None:
    found = sum(len(re.findall(r'\bAny\b', line)) for path in MODULES.values()
                for line in path.read_text(encoding='utf-8').splitlines()
                if not re.match(r'\s*(from \S+ )?import ', line))
    assert found <= ANY_AT_MOST


def test_records_are_built_by_keyword() -> None:
    trees = {module: ast.parse(path.read_text(encoding='utf-8'))
             for module, path in MODULES.items()}
    records: Dict[str, Set[str]] = {}       # what is a class elsewhere is left out below
    others: Set[str] = set()
    for module, tree in trees.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.ClassDef):
                heads = [ast.dump(head) for head in node.bases + node.decorator_list]
                members = [item for item in node.body if isinstance(item, ast.AnnAssign)]
                if len(members) >= 3 and any(
                        "'NamedTuple'" in head or "'dataclass'" in head for head in heads):
                    records.setdefault(node.name, set()).add(module)
                else:
                    others.add(node.name)
    assert {'Finding', 'Package', 'Verdict'} <= set(records)
    by_position = [
        '%s:%d: %s' % (module, node.lineno, node.func.id)
        for module, tree in trees.items() for node in ast.walk(tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        and node.func.id in records and (node.func.id not in others
                                         or module in records[node.func.id])
        and node.args and not isinstance(node.args[-1], ast.Starred)]
    assert by_position == []


def test_the_names_of_tests_fit_into_an_environment(request):
    assert max(len(item.nodeid) for item in request.session.items) < 1000
