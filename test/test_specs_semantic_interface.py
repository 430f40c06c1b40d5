"""Semantic capability interfaces, and what a client of them sees."""
from __future__ import annotations

from pathlib import Path

import pytest
from capabilities.specs.interface import (
    capability_interface_from_file_path, capability_interface_from_string)
from capabilities.specs.semantic_interface import (
    InvalidSemanticInterface, SemanticCapabilityInterface,
    semantic_capability_interface_from_file_path, semantic_capability_interface_from_string)

TEST = Path(__file__).parent
FRONT_CAMERA = str(TEST / 'specs/semantic_interfaces/FrontRGBCamera.yaml')
HEAD = 'name: Left\nspec_version: 1\nspec_type: semantic_interface\nredefines: a_package/A\n'
INTERFACE = '''
name: A
spec_version: 1
spec_type: interface
interface:
  topics:
    provides:
      camera/image: {type: sensor_msgs/Image, description: raw}
      /joint_states: {type: sensor_msgs/JointState}
      ~private: {type: std_msgs/Empty}
    requires:
      /cmd_vel: {type: geometry_msgs/Twist}
  services:
    camera/image: {type: std_srvs/Empty}
  actions:
    provides: {turn: {type: a/Turn}}
  parameters:
    rate: {type: double}
  dynamic_parameters: [gain]
'''


def resolved(body: str):
    return semantic_capability_interface_from_string(HEAD + body, 'left.yaml').resolve(
        capability_interface_from_string(INTERFACE))


def test_the_example_of_the_reference():
    front_camera = semantic_capability_interface_from_file_path(FRONT_CAMERA)
    assert front_camera.name == 'FrontRGBCamera'
    assert (front_camera.spec_type, front_camera.spec_version) == ('semantic_interface', 1)
    assert front_camera.description == 'This is semantically the Front RGB camera.'
    assert front_camera.redefines == 'a_package/RGBCamera'
    assert front_camera.redefines.package == 'a_package'
    assert front_camera.global_namespace == 'front_camera'
    assert front_camera.default_provider == 'unknown'
    assert front_camera.remappings == {
        'camera/image_raw': 'front_camera/image_raw',
        'camera/camera_info': 'front_camera/camera_info',
        'camera/set_info': 'front_camera/set_info'}
    camera = capability_interface_from_file_path(
        str(TEST / 'unit/specs/interfaces/RGBCamera.yaml'))
    seen = front_camera.resolve(camera)
    assert list(seen.topics) == ['front_camera/image_raw', 'front_camera/camera_info']
    assert list(seen.services) == ['front_camera/set_info']


def test_defaults_of_the_constructor():
    semantic = SemanticCapabilityInterface('Left', 'a_package/A', 1)
    assert (semantic.description, semantic.global_namespace) == ('No description given.', None)
    assert semantic.remappings == {}
    assert list(semantic.remappings_by_type) == ['topics', 'services', 'actions', 'parameters']
    semantic = SemanticCapabilityInterface(
        'Left', 'a_package/A', 1, 'text', 'left', {'topics': {'a': 'b'}})
    assert (semantic.description, semantic.global_namespace, semantic.remappings) == (
        'text', 'left', {'a': 'b'})


def test_what_is_returned_is_a_copy():
    semantic = semantic_capability_interface_from_file_path(FRONT_CAMERA)
    semantic.remappings.clear()
    semantic.remappings_by_type['topics'].clear()
    assert semantic == semantic_capability_interface_from_file_path(FRONT_CAMERA)


@pytest.mark.parametrize('body, topics', [
    ('', ['camera/image', '/joint_states', '~private', '/cmd_vel']),
    ('global_namespace: left',
     ['left/camera/image', '/left/joint_states', '~private', '/left/cmd_vel']),
    ('global_namespace: /left',
     ['/left/camera/image', '/left/joint_states', '~private', '/left/cmd_vel']),
    ('global_namespace: left/',
     ['left/camera/image', '/left/joint_states', '~private', '/left/cmd_vel']),
    ('global_namespace: /', ['/camera/image', '/joint_states', '~private', '/cmd_vel']),
    ('global_namespace: robot/left', ['robot/left/camera/image', '/robot/left/joint_states',
                                      '~private', '/robot/left/cmd_vel']),
    ('global_namespace: left\nremappings: {topics: {/cmd_vel: /drive, ~private: public}}',
     ['left/camera/image', '/left/joint_states', 'public', '/drive']),
    ('remappings: {topics: {camera/image: left}}',
     ['left', '/joint_states', '~private', '/cmd_vel']),
])
def test_the_namespace_comes_first_and_remappings_win(body, topics):
    assert list(resolved(body).topics) == topics


def test_everything_else_is_kept():
    before = capability_interface_from_string(INTERFACE)
    after = resolved('global_namespace: left\ndescription: the left one')
    assert (after.name, after.description, after.spec_type) == (
        'Left', 'the left one', 'interface')
    assert list(after.provided_topics) == ['left/camera/image', '/left/joint_states', '~private']
    assert list(after.required_topics) == ['/left/cmd_vel']
    assert list(after.services) == ['left/camera/image'] and after.provided_services == {}
    assert list(after.provided_actions) == ['left/turn']
    assert list(after.parameters) == ['left/rate']
    assert after.dynamic_parameters == ['gain']
    image = after.topics['left/camera/image']
    assert (image.name, image.kind, image.type, image.description) == (
        'left/camera/image', 'topic', 'sensor_msgs/Image', 'raw')
    assert before == capability_interface_from_string(INTERFACE)    # untouched
    assert capability_interface_from_string(after.to_yaml()) == after


def test_remappings_go_by_kind():
    after = resolved('remappings: {services: {camera/image: snapshot}}')
    assert list(after.services) == ['snapshot']
    assert 'camera/image' in after.topics


def test_the_default_provider_goes_with_it():
    semantic = semantic_capability_interface_from_string(HEAD)
    semantic.default_provider = 'a_package/left_camera'
    seen = semantic.resolve(capability_interface_from_string(INTERFACE))
    assert seen.default_provider == 'a_package/left_camera'


@pytest.mark.parametrize('body, error', [
    ('remappings: {topics: {camera/imag: a}}',
     "left.yaml:5:23: 'A' has no 'camera/imag' in topics to remap (did you mean "
     "'camera/image'?)"),
    ('remappings: {topics: {xyz: a}}', "left.yaml:5:23: 'A' has no 'xyz' in topics to remap"),
    ('remappings: {parameters: {camera/image: a}}',
     "left.yaml:5:27: 'A' has no 'camera/image' in parameters to remap"),
    ('remappings: {topics: {camera/image: /cmd_vel}}',
     "left.yaml:5:23: 'camera/image' and '/cmd_vel' of topics both come out as '/cmd_vel'"),
    ('remappings: {topics: {/cmd_vel: camera/image}}',
     "left.yaml:5:23: 'camera/image' and '/cmd_vel' of topics both come out as 'camera/image'"),
    ('remappings: {topics: {~private: /joint_states}}',
     "left.yaml:5:23: '/joint_states' and '~private' of topics both come out as '/joint_states'"),
    ('global_namespace: left\nremappings: {topics: {/cmd_vel: left/camera/image}}',
     "left.yaml:6:23: 'camera/image' and '/cmd_vel' of topics both come out as "
     "'left/camera/image'"),
    ('remappings: {services: {camera/image: provides}}',
     "left.yaml:5:25: a name cannot be 'provides' outside of a grouping"),
])
def test_what_does_not_fit(body, error):
    with pytest.raises(InvalidSemanticInterface) as raised:
        resolved(body)
    assert str(raised.value) == error


def test_a_topic_and_a_service_may_come_out_alike():
    seen = resolved('remappings: {topics: {/cmd_vel: x}, services: {camera/image: x}}')
    assert 'x' in seen.topics and list(seen.services) == ['x']


def test_two_names_can_come_out_the_same_by_the_namespace_alone():
    interface = capability_interface_from_string(
        'name: A\nspec_version: 1\nspec_type: interface\n'
        'interface: {topics: {a: {type: b/C}, /a: {type: b/C}}}')
    semantic = semantic_capability_interface_from_string(
        HEAD + 'global_namespace: /left', 'left.yaml')
    with pytest.raises(InvalidSemanticInterface) as raised:
        semantic.resolve(interface)
    assert str(raised.value) == (
        "left.yaml:5:19: 'a' and '/a' of topics both come out as '/left/a'")


def test_an_empty_namespace_is_none():
    interface = capability_interface_from_string(INTERFACE)
    semantic = SemanticCapabilityInterface('Left', 'a_package/A', 1, global_namespace='')
    assert list(semantic.resolve(interface).topics) == list(interface.topics)


def test_the_first_name_that_the_interface_does_not_have_is_reported():
    names = ['name_%d' % i for i in range(20)]
    semantic = SemanticCapabilityInterface(
        'Left', 'a_package/A', 1, remappings={'topics': {name: 'a' for name in names}})
    with pytest.raises(InvalidSemanticInterface, match="has no 'name_0' in topics"):
        semantic.resolve(capability_interface_from_string(INTERFACE))


def test_what_was_made_by_hand_has_no_place():
    semantic = SemanticCapabilityInterface(
        'Left', 'a_package/A', 1, remappings={'topics': {'cmd_vel': 'a'}})
    with pytest.raises(InvalidSemanticInterface) as raised:
        semantic.resolve(capability_interface_from_string(INTERFACE))
    assert str(raised.value) == (
        "<Left>: 'A' has no 'cmd_vel' in topics to remap (did you mean '/cmd_vel'?)")


@pytest.mark.parametrize('line', [
    'global_namespace: a', 'remappings: {topics: {a: b}}', 'description: a'])
def test_equality_looks_at_everything(line):
    one, other = (semantic_capability_interface_from_string(HEAD + more) for more in ('', line))
    assert one != other


def test_to_yaml_writes_what_people_write():
    assert semantic_capability_interface_from_file_path(FRONT_CAMERA).to_yaml() == '''\
name: FrontRGBCamera
spec_version: 1
spec_type: semantic_interface
description: This is semantically the Front RGB camera.
redefines: a_package/RGBCamera
global_namespace: front_camera
remappings:
  topics:
    camera/image_raw: front_camera/image_raw
    camera/camera_info: front_camera/camera_info
  services:
    camera/set_info: front_camera/set_info
'''
