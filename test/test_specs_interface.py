"""Capability interfaces, as the reference describes them."""
from __future__ import annotations

from pathlib import Path

import pytest
from capabilities.specs.interface import (
    CapabilityInterface, Interface, InterfaceElement, capability_interface_from_file_path,
    capability_interface_from_string)

CAMERA = str(Path(__file__).parent / 'unit/specs/interfaces/RGBCamera.yaml')
HEAD = 'name: A\nspec_version: 1\nspec_type: interface\n'
KINDS = ['topic', 'service', 'action', 'parameter']


@pytest.fixture
def camera() -> CapabilityInterface:
    return capability_interface_from_file_path(CAMERA)


def test_the_example_of_the_reference(camera):
    assert camera.name == 'RGBCamera'
    assert (camera.spec_type, camera.spec_version) == ('interface', 1)
    assert camera.description.startswith('This Capability describes the interface exposed')
    assert camera.default_provider == 'unknown'
    assert list(camera.topics) == ['camera/image_raw', 'camera/camera_info']
    first = list(camera.topics.values())[0]
    assert (first.name, first.kind, first.type, first.element_type, first.description) == (
        'camera/image_raw', 'topic', 'sensor_msgs/Image', 'sensor_msgs/Image',
        'raw image from the camera')
    assert camera.topics['camera/camera_info'].description == 'No description given.'
    assert list(camera.provided_topics) == list(camera.topics)
    assert camera.required_topics == camera.required_services == camera.actions == {}
    assert list(camera.services) == ['camera/set_info']
    assert camera.provided_services == {}       # in neither grouping
    assert camera.interface is camera and isinstance(camera, Interface)
    # As the reference prints it:
    assert repr(first).startswith('<capabilities.specs.interface.InterfaceElement object at 0x')


def test_elements_are_in_the_order_of_the_file():
    interface = capability_interface_from_string(HEAD + '''
interface:
  topics:
    z: {type: a/B}
    provides: {y: {type: a/B}, m: {type: a/B}}
    requires: {x: {type: a/B}, a: {type: a/B}}
    b: {type: a/B}
  dynamic_parameters: [z, a, m]
''')
    assert list(interface.topics) == ['z', 'y', 'm', 'x', 'a', 'b']
    assert list(interface.provided_topics) == ['y', 'm']
    assert list(interface.required_topics) == ['x', 'a']
    assert interface.dynamic_parameters == ['z', 'a', 'm']
    assert [(section, name, grouping) for section, name, _, grouping in interface.elements()] == [
        ('topics', 'z', None), ('topics', 'y', 'provides'), ('topics', 'm', 'provides'),
        ('topics', 'x', 'requires'), ('topics', 'a', 'requires'), ('topics', 'b', None)]


@pytest.mark.parametrize('kind', KINDS)
def test_adding_elements(kind):
    interface = Interface()
    add = getattr(interface, 'add_' + kind)
    for name, grouping in (('c', 'provides'), ('b', 'requires'), ('a', None)):
        add(name, InterfaceElement(name, kind, 'a/B'), grouping)
    section = kind + 's'
    assert list(getattr(interface, section)) == ['c', 'b', 'a']
    assert list(getattr(interface, 'provided_' + section)) == ['c']
    assert list(getattr(interface, 'required_' + section)) == ['b']
    for other in set(KINDS) - {kind}:
        assert getattr(interface, other + 's') == {}

    for name, grouping in (('d', 'offers'), ('d', ''), ('d', 3), ('provides', None)):
        with pytest.raises(ValueError):
            add(name, InterfaceElement(name, kind), grouping=grouping)
    for grouping in (None, 'provides', 'requires'):
        with pytest.raises(RuntimeError, match="%s 'c' is already in the interface" % kind):
            add('c', InterfaceElement('c', kind), grouping)
    assert list(getattr(interface, section)) == ['c', 'b', 'a']


def test_adding_to_a_section_by_its_name():
    interface = Interface()
    element = InterfaceElement('a', 'action', 'b/C')
    interface.add_element('actions', 'a', element, 'requires')
    assert list(interface.elements()) == [('actions', 'a', element, 'requires')]
    assert interface.required_actions == {'a': element}
    with pytest.raises(RuntimeError):
        interface.add_element('actions', 'a', element)
    with pytest.raises(KeyError):
        interface.add_element('action', 'b', element)


def test_adding_dynamic_parameters():
    interface = Interface()
    interface.add_dynamic_parameter('gain')
    with pytest.raises(RuntimeError, match="'gain' is already in the interface"):
        interface.add_dynamic_parameter('gain')
    assert interface.dynamic_parameters == ['gain']


@pytest.mark.parametrize('kind', KINDS)
def test_what_is_no_element_or_no_text_is_a_type_error(kind):
    interface = Interface()
    add = getattr(interface, 'add_' + kind)
    for element in ('a/B', None, {'type': 'a/B'}):
        with pytest.raises(TypeError, match="%s 'a' is .*, expected an InterfaceElement" % kind):
            add('a', element)
    for name in (3, None, b'a', ['a']):
        with pytest.raises(TypeError, match='the name of (a|an) %s is .*, expected text' % kind):
            add(name, InterfaceElement('a', kind))
        with pytest.raises(TypeError, match='dynamic_parameter is .*, expected text'):
            interface.add_dynamic_parameter(name)
    assert list(interface.elements()) == interface.dynamic_parameters == []


@pytest.mark.parametrize('nothing', ['[]', '{}', '', 'null'])
def test_an_empty_section_is_accepted(nothing):
    interface = capability_interface_from_string(
        'name: A\nspec_version: 1\nspec_type: interface\ninterface:\n'
        + ''.join('  %ss: %s\n' % (kind, nothing) for kind in (*KINDS, 'dynamic_parameter')))
    assert list(interface.elements()) == interface.dynamic_parameters == []


def test_what_is_returned_is_a_copy(camera):
    for section in ('topics', 'services', 'actions', 'parameters'):
        for prefix in ('', 'provided_', 'required_'):
            getattr(camera, prefix + section)['new'] = None
    camera.dynamic_parameters.append('new')
    assert camera == capability_interface_from_file_path(CAMERA)


@pytest.mark.parametrize('kind', [*KINDS, 'dynamic_parameter'])
def test_kinds_of_elements(kind):
    element = InterfaceElement('a', kind)
    assert (element.name, element.kind, element.type) == ('a', kind, None)
    assert element.description == 'No description given.'
    assert InterfaceElement('a', kind, 'b/C', 'd').description == 'd'


@pytest.mark.parametrize('kind', ['topics', 'Topic', '', None, 3, ['topic']])
def test_there_are_no_other_kinds_of_elements(kind):
    with pytest.raises(ValueError, match='expected topic, service, action, parameter'):
        InterfaceElement('a', kind)


def test_equality_looks_at_everything_but_the_default_provider(camera):
    other = capability_interface_from_file_path(CAMERA)
    other.default_provider = 'a_package/usb_camera'
    assert camera == other
    other.add_dynamic_parameter('gain')
    assert camera != other
    for change in ({'type': 'a/B'}, {'description': 'another'}):
        other = capability_interface_from_file_path(CAMERA)
        vars(other.topics['camera/image_raw']).update(change)
        assert camera != other
    assert (capability_interface_from_string(HEAD + 'interface: {topics: {a: {type: b/C}}}')
            != capability_interface_from_string(
                HEAD + 'interface: {topics: {provides: {a: {type: b/C}}}}'))


def test_to_yaml_writes_what_people_write(camera):
    assert camera.to_yaml() == '''\
name: RGBCamera
spec_version: 1
spec_type: interface
description: This Capability describes the interface exposed by a generic RGBCamera.
interface:
  topics:
    provides:
      camera/image_raw:
        type: sensor_msgs/Image
        description: raw image from the camera
      camera/camera_info:
        type: sensor_msgs/CameraInfo
  services:
    camera/set_info:
      type: sensor_msgs/SetCameraInfo
'''
