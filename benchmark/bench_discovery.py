"""
How long it takes from a package path to an index of all the specs on it, against a fixed limit.

The folder that ROCON_URI_CORPUS names, else the tests' own workspace, is read in processes of its
own, where nothing has been read before. A large workspace is generated. What catkin_pkg takes to
find and parse the same packages is told beside, since that is in it.
"""
import os
import subprocess
import sys
import tempfile
import time

from catkin_pkg.packages import find_packages_allowing_duplicates

_ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(_ROOT, 'src'))

from capabilities.discovery import (    # noqa: E402
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)

_FOLDER_LIMIT = 0.06        # seconds
_LARGE_LIMIT = 3.0
_LARGE = 1000               # packages, with three specs each
_FRESH_PROCESSES = 5        # the shortest time counts: what is longer, something else has caused

_MANIFEST = '''<?xml version="1.0"?>
<package format="2">
  <name>package_%(number)d</name>
  <version>1.0.0</version>
  <description>A generated package</description>
  <maintainer email="nobody@example.org">Nobody</maintainer>
  <license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend>sensor_msgs</exec_depend>
  <exec_depend>std_msgs</exec_depend>
  <export>
    <capability_interface>interfaces/Camera.yaml</capability_interface>
    <semantic_capability_interface>interfaces/FrontCamera.yaml</semantic_capability_interface>
    <capability_provider>providers/camera.yaml</capability_provider>
  </export>
</package>
'''
_SPECS = {
    'interfaces/Camera.yaml': '''%%YAML 1.1
---
name: Camera
spec_version: 1
spec_type: interface
description: 'A camera.'
interface:
  topics:
    provides:
      'camera/image_raw':
        type: 'sensor_msgs/Image'
        description: 'what it sees'
      'camera/camera_info':
        type: 'sensor_msgs/CameraInfo'
  services:
    'camera/set_camera_info':
      type: 'sensor_msgs/SetCameraInfo'
''',
    'interfaces/FrontCamera.yaml': '''%%YAML 1.1
---
name: FrontCamera
spec_version: 1
spec_type: semantic_interface
redefines: 'package_%(number)d/Camera'
global_namespace: 'front'
remappings:
  topics:
    'camera/image_raw': 'front/image'
''',
    'providers/camera.yaml': '''%%YAML 1.1
---
name: camera
spec_version: 1
spec_type: provider
implements: 'package_%(number)d/FrontCamera'
launch_file: 'launch/camera.launch'
depends_on:
  'package_%(next)d/Camera':
    provider: 'package_%(next)d/camera'
'''}


def figures():
    """
    Measure both.

    :returns: iterator of dicts, as ``benchmark/__main__.py`` says; the reference is the limit
    """
    folder = os.environ.get('ROCON_URI_CORPUS') or os.path.join(_ROOT, 'test', 'workspace')
    seconds = min(_in_a_fresh_process(folder) for _ in range(_FRESH_PROCESSES))
    yield _figure('the packages in ' + os.path.basename(folder), seconds, _FOLDER_LIMIT, folder)
    with tempfile.TemporaryDirectory() as folder:
        _generate(folder)
        seconds = discovery_seconds(folder)
        yield _figure('%d packages with %d specs' % (_LARGE, _LARGE * len(_SPECS)), seconds,
                      _LARGE_LIMIT, folder)


def discovery_seconds(folder):
    """How long it takes once; an AssertionError if there is no index without errors."""
    start = time.perf_counter()
    package_errors = []
    packages = package_index_from_package_path([folder], package_errors)
    index, errors = spec_index_from_spec_file_index(spec_file_index_from_package_index(packages))
    seconds = time.perf_counter() - start
    assert index.names and not package_errors and not errors
    return seconds


def _in_a_fresh_process(folder):
    code = 'import sys; sys.path.insert(0, sys.argv[1]); import bench_discovery as bench; ' \
           'print(bench.discovery_seconds(sys.argv[2]))'
    command = [sys.executable, '-c', code, os.path.dirname(os.path.abspath(__file__)), folder]
    return float(subprocess.run(command, check=True, stdout=subprocess.PIPE,
                                stderr=subprocess.DEVNULL, universal_newlines=True).stdout)


def _figure(name, seconds, limit, folder):
    start = time.perf_counter()
    packages = find_packages_allowing_duplicates(folder, warnings=[])
    catkin_seconds = time.perf_counter() - start
    return {'name': 'index the specs of ' + name, 'ratio': seconds / limit, 'target': 1,
            'reference': 'the limit', 'seconds': seconds, 'reference_seconds': limit,
            'details': 'catkin_pkg takes %.0f ms to find and parse the %d packages'
                       % (catkin_seconds * 1000, len(packages))}


def _generate(folder):
    for number in range(_LARGE):
        names = {'number': number, 'next': (number + 1) % _LARGE}
        for file_name, text in [('package.xml', _MANIFEST), *_SPECS.items()]:
            path = os.path.join(folder, 'package_%d' % number, file_name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, 'w', encoding='ascii') as file:
                file.write(text % names)
