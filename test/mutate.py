"""
Change one module here and there, and see which of the changes its tests do not notice.

Examples:
  /usr/bin/python3 test/mutate.py grammar
  /usr/bin/python3 test/mutate.py regular/language

What is changed is a copy of this tree, in build/mutation, by cosmic-ray, which is installed there
from PyPI and needs Python 3.9. It takes up to an hour for a module. The changes that no test
notices are shown, and at the end what share of all they are.
"""
from __future__ import annotations

import argparse
import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / 'build' / 'mutation'

#: Modules, of rocon_uri where nothing else is said, and the tests of each: those that notice most
#: first, since the first failure ends it.
TESTS = {
    'grammar': ['conformance', 'uri', 'errors', 'vocabulary', 'import_cost'],
    'uri': ['conformance', 'uri', 'compatibility', 'errors', 'import_cost', 'vocabulary',
            'exported_rules', 'threads'],
    'compatibility': ['conformance', 'compatibility', 'import_cost', 'exported_rules'],
    'name_pattern': ['name_pattern', 'conformance', 'compatibility', 'import_cost'],
    'name_index': ['resource_index'],
    'resource_index': ['resource_index'],
    'regular/budget': ['name_pattern', 'resource_index'],
    'regular/language': ['regular_sorted_walk', 'name_pattern', 'regular_language'],
    'regular/inclusion': ['name_pattern', 'compatibility', 'regular_language'],
    'regular/intersection': ['name_pattern', 'compatibility', 'regular_language'],
    'regular/product': ['name_pattern', 'compatibility', 'regular_language'],
    'regular/syntax': ['conformance', 'regular_language'],
    'regular/tree': ['name_pattern', 'compatibility', 'regular_language'],
    'regular/sorted_walk': ['regular_sorted_walk', 'resource_index'],
    'apps/runnable': ['app_files', 'reasons', 'rapps'],
    'lint/__init__': ['lint', 'cli_check', 'lint_interactions', 'hostile_input'],
    'lint/app_files': ['lint_apps', 'lint_findings'],
    'lint/checked_file': ['lint', 'lint_interactions', 'lint_findings', 'lint_apps',
                          'hostile_input'],
    'lint/explanations': ['lint_findings', 'cli_check'],
    'lint/finding': ['lint'],
    'lint/ignoring': ['lint_findings'],
    'lint/interaction_entries': ['lint_interactions', 'lint'],
    'lint/interactions_files': ['lint_interactions', 'lint'],
    'lint/junit': ['cli_check'],
    'lint/manifest': ['lint_exports', 'lint', 'lint_findings', 'hostile_input'],
    'lint/package_files': ['lint', 'lint_exports', 'packages'],
    'lint/rapp_files': ['lint', 'lint_findings'],
    'lint/sarif': ['cli_check'],
    'lint/source_lines': ['lint_findings', 'cli_check'],
    'lint/spec_files': ['lint', 'lint_findings'],
    'lint/targets': ['cli_check', 'cli_specs'],
    'lint/unexported': ['lint_exports'],
    'capabilities/discovery': ['discovery', 'packages'],
    'capabilities/graph': ['graph'],
    'capabilities/instances': ['instances', 'graph'],
    'capabilities/planning/faults': ['planning', 'providers', 'reasons'],
    'capabilities/planning/launching': ['planning', 'reasons'],
    'capabilities/planning/plan': ['planning', 'providers'],
    'capabilities/planning/planner': ['planning', 'providers'],
    'capabilities/planning/providers': ['planning', 'providers'],
    'capabilities/planning/start_order': ['planning', 'providers'],
    'capabilities/specs/semantic_interface': ['specs_semantic_interface', 'specs_common'],
}

CONFIG = '''\
[cosmic-ray]
module-path = "src/%s.py"
timeout = 300.0
excluded-modules = []
test-command = %s

[cosmic-ray.distributor]
name = "local"
'''


def main() -> int:
    """Do it, and return the exit status: 1 if the tests fail on the module as it is."""
    parser = argparse.ArgumentParser('test/mutate.py', description=(__doc__ or '').strip(),
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('module', choices=TESTS, help='what to change')
    module = parser.parse_args().module
    if sys.version_info < (3, 9):
        parser.error('cosmic-ray needs Python 3.9')

    programs, tree = installed(), copied(module)
    tests = ['test/test_%s.py' % name for name in TESTS[module]]
    test_command = ' '.join(map(shlex.quote, [
        'env', 'PYTHONPATH=src', 'PYTHONDONTWRITEBYTECODE=1', str(programs / 'python'), '-m',
        'pytest', '-qx', '-p', 'no:cacheprovider', '--hypothesis-profile', 'no_shrinking',
        '--timeout', '60', *tests]))
    path = module if module.startswith('capabilities/') else 'rocon_uri/' + module
    (tree / 'config.toml').write_text(CONFIG % (path, json.dumps(test_command)))
    for command in (['baseline', 'config.toml'], ['init', 'config.toml', 'session.sqlite'],
                    ['exec', 'config.toml', 'session.sqlite']):
        done = subprocess.run([str(programs / 'cosmic-ray'), *command], cwd=str(tree))
        if done.returncode != 0:
            return 1
    subprocess.run([str(programs / 'cr-report'), '--surviving-only', '--show-diff',
                    'session.sqlite'], cwd=str(tree))
    return 0


def installed() -> Path:
    """The programs of an environment with cosmic-ray, which sees what the system has too."""
    environment = WORK / 'environment'
    subprocess.run([sys.executable, '-m', 'venv', '--system-site-packages', str(environment)],
                   check=True)
    programs = environment / 'bin'
    subprocess.run([str(programs / 'pip'), 'install', '--quiet', 'cosmic-ray==8.7.0',
                    'pytest-timeout==2.4.0'], check=True)
    return programs


def copied(module: str) -> Path:
    """A tree that may be changed."""
    tree = WORK / module
    shutil.rmtree(str(tree), ignore_errors=True)
    shutil.copytree(str(ROOT), str(tree), ignore=shutil.ignore_patterns(
        'build', '.git', '__pycache__', '.*_cache', '.hypothesis'))
    return tree


if __name__ == '__main__':
    sys.exit(main())
