"""A workspace of any size: each of its packages exports three specs, one that needs the next's."""
import os

__all__ = ['SPECS', 'make_packages']

MANIFEST = '''<?xml version="1.0"?>
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
SPECS = {
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
  '%(needs)s':
    provider: 'package_%(next)d/camera'
'''}


def make_packages(folder, count, needs='package_%(next)d/Camera'):
    """
    Write them.

    :param str folder: where to
    :param int count: how many packages
    :param str needs: the capability that the provider of each depends on
    """
    for number in range(count):
        names = {'number': number, 'next': (number + 1) % count}
        names['needs'] = needs % names
        for file_name, text in [('package.xml', MANIFEST), *SPECS.items()]:
            path = os.path.join(folder, 'package_%d' % number, file_name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, 'w', encoding='ascii') as file:
                file.write(text % names)
