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

What cannot be an interface is refused with the place and the reason:

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

from capabilities.specs._reading import (
    SpecSource, key_place, load_spec_file, load_spec_file_path, load_spec_string, value_place)
from capabilities.specs.common import NO_DESCRIPTION, CapabilitySpec, InvalidSpec
from capabilities.specs.interface_sections import GROUPINGS, SECTIONS, Interface
from rocon_uri.sources.wording import did_you_mean, near_misses, shown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from os import PathLike
    from typing import IO, Any, Dict, Optional, Union

__all__ = ['CapabilityInterface', 'Interface', 'InterfaceElement', 'InvalidInterface',
           'capability_interface_from_dict', 'capability_interface_from_file',
           'capability_interface_from_file_path', 'capability_interface_from_string']

_ELEMENT_KINDS = (*SECTIONS.values(), 'dynamic_parameter')
_ELEMENT_KEYS = ('type', 'description')


class InvalidInterface(InvalidSpec):
    """A capability interface that is not complete, or has an entry that cannot be used."""


class InterfaceElement:
    """
    One topic, service, action or parameter of an interface.

    :param str name: its ROS name
    :param str element_kind: ``'topic'``, ``'service'``, ``'action'``, ``'parameter'`` or
        ``'dynamic_parameter'``
    :param str element_type: ``package/Type``, or the type of a parameter; ``None`` if there is none
    :param str description: free text; ``None`` gives ``'No description given.'``
    :raises ValueError: if the kind is another

    The attributes are ``name``, ``kind``, ``type`` (and ``element_type``) and ``description``.

    >>> InterfaceElement('scan', 'topic', 'sensor_msgs/LaserScan').type
    'sensor_msgs/LaserScan'
    """

    def __init__(self, name: str, element_kind: str, element_type: Optional[str] = None,
                 description: Optional[str] = None) -> None:
        if element_kind not in _ELEMENT_KINDS:
            raise ValueError('%s is not a kind of interface element, expected %s' % (
                shown(element_kind), ', '.join(_ELEMENT_KINDS)))
        self.name = name
        self.kind = element_kind
        self.type = element_type
        self.description = NO_DESCRIPTION if description is None else description

    @property
    def element_type(self) -> Optional[str]:
        """The same as ``type``."""
        return self.type


class CapabilityInterface(Interface, CapabilitySpec):
    """
    A capability interface: an `Interface` with a name.

    :param str name: its name
    :param int spec_version: the version of the specification, 1
    :param str description: free text; ``None`` gives ``'No description given.'``

    Beside the attributes that every spec has: ``default_provider`` (str), the name of a provider,
    ``'unknown'`` until it is set. It says how a robot is set up, not what the interface is: it is
    in no file, and makes no difference to ``==``.

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
        """What the interface is made of, which is itself."""
        return self

    def to_dict(self) -> Dict[str, Any]:
        """
        The spec as plain data, in the order of the file.

        :returns: dict, from which `capability_interface_from_dict` makes an equal spec
        """
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


def capability_interface_from_file_path(file_path: Union[str, PathLike[str]]
                                        ) -> CapabilityInterface:
    """
    Read the capability interface in a file.

    :param str file_path: where the file is
    :returns: `CapabilityInterface`
    :raises InvalidInterface: if the spec is not complete or has invalid entries
    :raises OSError: if the file is not there, or cannot be read
    """
    return capability_interface_from_dict(*load_spec_file_path(file_path, InvalidInterface))


def capability_interface_from_file(file_handle: IO[Any]) -> CapabilityInterface:
    """
    Read the capability interface in an open file.

    :param file_handle: open for reading, as text or binary
    :returns: `CapabilityInterface`
    :raises InvalidInterface: if the spec is not complete or has invalid entries
    :raises OSError: if the file cannot be read
    """
    return capability_interface_from_dict(*load_spec_file(file_handle, InvalidInterface))


def capability_interface_from_string(string: str, file_name: str = '<string>'
                                     ) -> CapabilityInterface:
    """
    Read a capability interface.

    :param str string: the text of the spec
    :param str file_name: the name that errors give
    :returns: `CapabilityInterface`
    :raises InvalidInterface: if the spec is not complete or has invalid entries
    :raises AttributeError: if ``string`` is not a str
    """
    return capability_interface_from_dict(*load_spec_string(string, file_name, InvalidInterface))


def capability_interface_from_dict(spec: Dict[Any, Any], file_name: str = '<dict>'
                                   ) -> CapabilityInterface:
    """
    Make a capability interface of plain data.

    :param dict spec: what a file would hold
    :param str file_name: the name that errors give
    :returns: `CapabilityInterface`
    :raises InvalidInterface: if the spec is not complete or has invalid entries
    """
    source = SpecSource(spec, file_name, 'interface', ('interface',), InvalidInterface)
    interface = CapabilityInterface(source.name, 1, source.description)
    sections = source.names_in(spec, 'interface', 'interface')
    for section in sections:
        if section in SECTIONS:
            _read_section(source, interface, section, sections)
        elif section == 'dynamic_parameters':
            _read_dynamic_parameters(source, interface, sections)
        else:
            raise source.error(*source.unknown(
                'section', sections, section, (*SECTIONS, 'dynamic_parameters'), 'interface'))
    return source.finished(interface)


def _read_section(source: SpecSource, interface: Interface, section: str,
                  sections: Dict[Any, Any]) -> None:
    """Add the elements of one section, grouped or not."""
    elements = source.names_in(sections, section, section)
    for name in elements:
        if name in GROUPINGS:
            group = source.names_in(elements, name, '%s of %s' % (name, section))
            for grouped_name in group:
                _read_element(source, interface, section, group, grouped_name, name)
        else:
            _read_element(source, interface, section, elements, name, None)


def _read_element(source: SpecSource, interface: Interface, section: str,
                  elements: Dict[Any, Any], key: Any, grouping: Optional[str]) -> None:
    """Add one element."""
    kind, element = SECTIONS[section], elements[key]
    name = source.name_in(elements, key, 'the name of a ' + kind)
    if element is None:
        element = {}
    if not isinstance(element, dict):
        raise source.error(value_place(elements, name),
                           kind + ' %s is %s, expected a mapping with a type', name, element)
    source.check_repeated(element, ('description',), ' in ' + kind + ' %s', name)
    if element.get('type') is None:
        near = near_misses(name, GROUPINGS) if grouping is None else []
        raise source.error(key_place(elements, name),
                           kind + ' %s has no type' + did_you_mean(near), name)
    source.warn_of_unknown(element, _ELEMENT_KEYS, kind + ' %s', name)
    element_type = source.text_in(element, 'type', element['type'], 'type of ' + kind + ' %s', name)
    description = source.description_in(element, 'description of ' + kind + ' %s', name)
    try:
        interface.add_element(
            section, name, InterfaceElement(name, kind, element_type, description), grouping)
    except RuntimeError:
        raise source.error(key_place(elements, name),
                           kind + ' %s is there twice', name) from None


def _read_dynamic_parameters(source: SpecSource, interface: Interface,
                             sections: Dict[Any, Any]) -> None:
    """Add the names in the list of dynamic parameters."""
    names = sections['dynamic_parameters']
    if names is None or names == {}:
        return
    if not isinstance(names, (list, tuple)):
        raise source.error(value_place(sections, 'dynamic_parameters'),
                           'dynamic_parameters is %s, expected a list of names', names)
    for index, name in enumerate(names):
        source.text_in(names, index, name, 'the name of a dynamic_parameter')
        try:
            interface.add_dynamic_parameter(name)
        except RuntimeError:
            raise source.error(value_place(names, index),
                               'dynamic_parameter %s is there twice', name) from None
