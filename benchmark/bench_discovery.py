"""
How long it takes from a package path to an index of all the specs on it, against a fixed limit.

What is indexed are the folder that ROCON_URI_CORPUS names, else the tests' own workspace, and a
large workspace that is generated; how long it takes to read all that this exports is compared with
discovery. Told beside is how long it took the first time, when PyYAML may have had to be loaded,
too, and what catkin_pkg takes to find and parse the same packages.
"""
import logging
import os
import sys
import tempfile
import time

from catkin_pkg.packages import find_packages_allowing_duplicates
from packages_with_specs import SPECS, make_packages

_ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(_ROOT, 'src'))

from capabilities.discovery import (    # noqa: E402
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from rocon_uri.workspace import read_workspace      # noqa: E402

_FOLDER_LIMIT = 0.06        # seconds
_LARGE_LIMIT = 3.0
_WORKSPACE_LIMIT = 0.6      # of what discovery takes
_LARGE = 1000               # packages, with three specs each
# What takes longer than the shortest of these rounds, something else has caused.
_ROUNDS = {_FOLDER_LIMIT: 10, _LARGE_LIMIT: 2}
_WORKSPACE_ROUNDS = 5


def figures():
    """
    Measure both.

    :returns: iterator of dicts, as ``benchmark/__main__.py`` says; the reference is the limit
    """
    logging.getLogger('capabilities').addHandler(logging.NullHandler())
    folder = os.environ.get('ROCON_URI_CORPUS') or os.path.join(_ROOT, 'test', 'workspace')
    yield _figure('the packages in ' + os.path.basename(folder), folder, _FOLDER_LIMIT)
    with tempfile.TemporaryDirectory() as folder:
        make_packages(folder, _LARGE)
        name = '%d packages with %d specs' % (_LARGE, _LARGE * len(SPECS))
        yield _figure(name, folder, _LARGE_LIMIT)
        yield _workspace_figure(name, folder)


def _discovery_seconds(folder):
    """How long it takes once; an AssertionError if there is no index without errors."""
    start = time.perf_counter()
    package_errors = []
    packages = package_index_from_package_path([folder], package_errors)
    index, errors = spec_index_from_spec_file_index(spec_file_index_from_package_index(packages))
    seconds = time.perf_counter() - start
    assert index.names and not package_errors and not errors
    return seconds


def _figure(name, folder, limit):
    times = [_discovery_seconds(folder) for _ in range(_ROUNDS[limit])]
    start = time.perf_counter()
    packages = find_packages_allowing_duplicates(folder, warnings=[])
    catkin_seconds = time.perf_counter() - start
    return {'name': 'index the specs of ' + name, 'ratio': min(times) / limit, 'target': 1,
            'reference': 'the limit', 'seconds': min(times), 'reference_seconds': limit,
            'details': '%.0f ms the first time; catkin_pkg takes %.0f ms for the %d packages'
                       % (times[0] * 1000, catkin_seconds * 1000, len(packages))}


def _workspace_figure(name, folder):
    """What the verbs read, with rapps and rules, and without the Package objects of catkin_pkg."""
    times = []
    for _ in range(_WORKSPACE_ROUNDS):      # by turns, so that a busy machine slows both
        start = time.perf_counter()
        workspace = read_workspace([folder])
        seconds = time.perf_counter() - start
        assert len(workspace.packages) == _LARGE and not workspace.faults
        times.append((seconds, _discovery_seconds(folder)))
    fastest, discovery = map(min, zip(*times))
    return {'name': 'read the workspace of ' + name, 'ratio': fastest / discovery,
            'target': _WORKSPACE_LIMIT, 'reference': 'its discovery, which asks catkin_pkg',
            'seconds': fastest, 'reference_seconds': discovery, 'details': ''}
