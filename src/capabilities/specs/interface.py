"""
Capability interfaces: the topics, services, actions and parameters that a capability has.

>>> from capabilities.specs.interface import capability_interface_from_file_path
>>> camera = capability_interface_from_file_path('test/unit/specs/interfaces/RGBCamera.yaml')
>>> for name, topic in camera.provided_topics.items():
...     print(name, topic.type, topic.description)
camera/image_raw sensor_msgs/Image raw image from the camera
camera/camera_info sensor_msgs/CameraInfo No description given.
>>> list(camera.services), camera.required_services, camera.actions
(['camera/set_info'], {}, {})

A spec that is not an interface is refused, with the place and the reason:

>>> capability_interface_from_string('''
... name: RGBCamera
... spec_version: 1
... spec_type: interface
... interface:
...   topcs: {'camera/image_raw': {type: sensor_msgs/Image}}
... ''', 'camera.yaml')
Traceback (most recent call last):
    ...
capabilities.specs.interface.InvalidInterface: camera.yaml:6:3: unknown section 'topcs' in \
interface (did you mean 'topics'?)
"""
from __future__ import annotations

from typing import Any, Dict, Optional

from capabilities.specs._reading import SpecLoader, SpecReading
from capabilities.specs.common import NO_DESCRIPTION, CapabilitySpec, InvalidSpec
from capabilities.specs.interface_sections import (
    GROUPINGS, SECTIONS, Interface, InterfaceElement)
from rocon_uri.sources.checked import CheckedMapping
from rocon_uri.sources.wording import did_you_mean, near_misses, shown
from rocon_uri.sources.yaml_data import value_place

__all__ = ['CapabilityInterface', 'Interface', 'InterfaceElement', 'InvalidInterface',
           'capability_interface_from_dict', 'capability_interface_from_file',
           'capability_interface_from_file_path', 'capability_interface_from_string']

_ELEMENT_KEYS = ('type', 'description')


class InvalidInterface(InvalidSpec):
    """A capability interface that is not complete, or has an entry that cannot be used."""


class CapabilityInterface(Interface, CapabilitySpec):
    """
    A capability interface: an `Interface` with a name.

    :param str name: its name
    :param int spec_version: the version of the specification, 1
    :param str description: free text; ``None`` gives ``'No description given.'``

    Beside the attributes of every spec it has ``default_provider`` (str), the name of a provider,
    ``'unknown'`` until it is set. That describes the robot, not the interface: no file has it, and
    ``==`` does not compare it.

    >>> CapabilityInterface('RGBCamera', 1).default_provider
    'unknown'
    """

    spec_type = 'interface'

    def __init__(self, name: str, spec_version: int, description: Optional[str] = None) -> None:
        Interface.__init__(self)
        CapabilitySpec.__init__(self, name, spec_version, description)
        self.default_provider = 'unknown'

    @property
    def interface(self) -> Interface:
        """The interface itself, which is its own content."""
        return self

    def to_dict(self) -> Dict[str, object]:
        sections: Dict[str, Any] = {}
        for section, name, element, grouping in self.elements():
            elements = sections.setdefault(section, {})
            if grouping is not None:
                elements = elements.setdefault(grouping, {})
            elements[str(name)] = data = {}
            if element.type is not None:
                data['type'] = str(element.type)
            if element.description != NO_DESCRIPTION:
                data['description'] = str(element.description)
        if self.dynamic_parameters:
            sections['dynamic_parameters'] = [str(name) for name in self.dynamic_parameters]
        return {**CapabilitySpec.to_dict(self), 'interface': sections}


def _make(reading: SpecReading) -> CapabilityInterface:
    interface = CapabilityInterface(reading.name, 1, reading.description)
    sections = reading.spec.mapping('interface')
    for section in sections:
        if section in SECTIONS:
            _read_section(interface, sections, section)
        elif section == 'dynamic_parameters':
            _read_dynamic_parameters(interface, sections)
        else:
            raise sections.unknown_key(section, (*SECTIONS, 'dynamic_parameters'), 'section')
    return interface


def _read_section(interface: Interface, sections: CheckedMapping, section: str) -> None:
    """Add the elements of one section, grouped or not."""
    elements = sections.mapping(section)
    for name in elements:
        if name in GROUPINGS:
            group = elements.mapping(name, '%s of %s' % (name, section))
            for grouped_name in group:
                _read_element(interface, section, group, grouped_name, name)
        else:
            _read_element(interface, section, elements, name, None)


def _read_element(interface: Interface, section: str, elements: CheckedMapping, key: object,
                  grouping: Optional[str]) -> None:
    """Add one element."""
    kind = SECTIONS[section]
    name = elements.key_text(key, 'the name of a ' + kind)
    if elements.get(name) == []:
        raise elements.wrong(name, 'a mapping with a type', kind + ' %s')
    element = elements.mapping(name, kind + ' %s', 'a mapping with a type', is_checked=False)
    element.refuse_duplicates(harmless=('description',))
    element_type = element.text('type')
    if element_type is None:
        near = near_misses(name, GROUPINGS) if grouping is None else []
        raise elements.reading.fault('%s has no type%s' % (element.title, did_you_mean(near)),
                                     elements.key_place(name), 'missing-key')
    element.warn_of_unknown(_ELEMENT_KEYS)
    description = element.text('description', may_be_empty=True)
    try:
        interface.add_element(
            section, name, InterfaceElement(name, kind, element_type, description), grouping)
    except RuntimeError:
        raise elements.reading.fault('duplicate ' + element.title, elements.key_place(name),
                                     'duplicate-key') from None


def _read_dynamic_parameters(interface: Interface, sections: CheckedMapping) -> None:
    """Add the names in the list of dynamic parameters."""
    names = sections.sequence('dynamic_parameters', 'a list of names')
    for index, given in enumerate(names):
        place = value_place(names, index)
        name = sections.reading.text(given, 'the name of a dynamic_parameter', place)
        try:
            interface.add_dynamic_parameter(name)
        except RuntimeError:
            raise sections.reading.fault('duplicate dynamic_parameter ' + shown(name), place,
                                         'duplicate-key') from None


_loader = SpecLoader('interface', ('interface',), InvalidInterface, _make)

# Each is described where SpecLoader defines it, and in its own help().
capability_interface_from_dict = _loader.from_dict
capability_interface_from_file = _loader.from_file
capability_interface_from_file_path = _loader.from_file_path
capability_interface_from_string = _loader.from_string
