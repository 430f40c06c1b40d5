"""
Semantic capability interfaces: an interface with a meaning of its own, and new ROS names.

>>> from capabilities.specs.semantic_interface import semantic_capability_interface_from_file_path
>>> path = 'test/specs/semantic_interfaces/FrontRGBCamera.yaml'
>>> front_camera = semantic_capability_interface_from_file_path(path)
>>> front_camera.redefines, front_camera.global_namespace
('a_package/RGBCamera', 'front_camera')
>>> front_camera.remappings['camera/image_raw']
'front_camera/image_raw'

`SemanticCapabilityInterface.resolve` gives the interface that a client of it sees:

>>> from capabilities.specs.interface import capability_interface_from_file_path
>>> camera = capability_interface_from_file_path('test/unit/specs/interfaces/RGBCamera.yaml')
>>> list(front_camera.resolve(camera).topics)
['front_camera/image_raw', 'front_camera/camera_info']
"""
from __future__ import annotations

from typing import Dict, Mapping, Optional, Sequence, Set, Tuple

from capabilities.specs._reading import SpecLoader, SpecReading
from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import CapabilityInterface, InterfaceElement
from capabilities.specs.remappings import RemappingSpec, read_remappings
from rocon_uri.sources.located import with_id
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted
from rocon_uri.sources.yaml_data import key_place, value_place

__all__ = ['InvalidSemanticInterface', 'SemanticCapabilityInterface',
           'semantic_capability_interface_from_dict', 'semantic_capability_interface_from_file',
           'semantic_capability_interface_from_file_path',
           'semantic_capability_interface_from_string']


class InvalidSemanticInterface(InvalidSpec):
    """A semantic capability interface that is not complete, or has an entry that cannot be used,
    or does not fit the interface that it redefines."""


class SemanticCapabilityInterface(RemappingSpec):
    """
    A semantic capability interface.

    :param str name: its name
    :param str redefines: the name of the interface that it gives a meaning to
    :param int spec_version: the version of the specification, 1
    :param str description: free text; ``None`` gives ``'No description given.'``
    :param str global_namespace: the namespace that all ROS names are put in, or ``None``
    :param dict remappings: new names by name, by kind (``{'topics': {'scan': 'left_scan'}}``)
    :raises ValueError: if there are remappings of another kind
    :raises RuntimeError: if a name is remapped to two others

    The attributes have the names of the parameters and can be set, like those of every spec; but
    ``remappings`` is a copy, a dict of all kinds together. ``default_provider`` (str) is that
    of `capabilities.specs.interface.CapabilityInterface`.

    >>> SemanticCapabilityInterface('Left', 'a_package/RGBCamera', 1).remappings
    {}
    """

    spec_type = 'semantic_interface'

    def __init__(self, name: str, redefines: str, spec_version: int,
                 description: Optional[str] = None, global_namespace: Optional[str] = None,
                 remappings: Optional[Mapping[str, Mapping[str, str]]] = None) -> None:
        super().__init__(name, spec_version, description, remappings)
        self.redefines = redefines
        self.global_namespace = global_namespace
        self.default_provider = 'unknown'

    def resolve(self, interface: CapabilityInterface) -> CapabilityInterface:
        """
        The interface that a client of this semantic interface sees.

        Names that are remapped get their new names. All others but private ones go into the global
        namespace: ``camera/image`` becomes ``left/camera/image``, ``/cmd_vel`` becomes
        ``/left/cmd_vel``. Dynamic parameters stay as they are.

        :param CapabilityInterface interface: the one that this one redefines
        :returns: `capabilities.specs.interface.CapabilityInterface` of this one's name
        :raises InvalidSemanticInterface: if a name is remapped that the interface does not have,
            or two names come out the same

        >>> camera = CapabilityInterface('RGBCamera', 1)
        >>> camera.add_topic('/image', InterfaceElement('/image', 'topic', 'sensor_msgs/Image'))
        >>> left = SemanticCapabilityInterface('Left', 'a_package/RGBCamera', 1, None, 'left')
        >>> list(left.resolve(camera).topics)
        ['/left/image']
        """
        resolved = CapabilityInterface(self.name, self.spec_version, self.description)
        resolved.default_provider = self.default_provider
        self._check_remapped_names(interface)
        old_names: Dict[Tuple[str, str], str] = {}
        for section, name, element, grouping in interface.elements():
            new_name = self._remappings_by_type[section].get(name) or self._in_namespace(name)
            old_name = old_names.setdefault((section, new_name), name)
            if old_name != name:
                problem = '%s and %s of %s both come out as %s' % (
                    quoted(old_name), quoted(name), section, quoted(new_name))
                raise self._error(section, [name, old_name], problem, 'remapping-collision')
            renamed = InterfaceElement(new_name, element.kind, element.type, element.description)
            try:
                resolved.add_element(section, new_name, renamed, grouping)
            except ValueError as error:     # the new name is that of a grouping
                raise self._error(section, [name], str(error), 'remapping-collision') from None
        for dynamic_parameter in interface.dynamic_parameters:
            resolved.add_dynamic_parameter(dynamic_parameter)
        return resolved

    def to_dict(self) -> Dict[str, object]:
        data = super().to_dict()
        data['redefines'] = str(self.redefines)
        if self.global_namespace is not None:
            data['global_namespace'] = str(self.global_namespace)
        data.update(self._remappings_to_dict())
        return data

    def _in_namespace(self, name: str) -> str:
        """The name, in the global namespace."""
        if not self.global_namespace or name.startswith('~'):
            return name
        new_name = self.global_namespace.rstrip('/') + '/' + name.lstrip('/')
        return '/' + new_name.lstrip('/') if name.startswith('/') else new_name

    def _check_remapped_names(self, interface: CapabilityInterface) -> None:
        """Refuse to remap what the interface does not have."""
        names: Dict[str, Set[str]] = {section: set() for section in self._remappings_by_type}
        for section, name, _, _ in interface.elements():
            names[section].add(name)
        for section, new_names in self._remappings_by_type.items():
            for name in new_names:
                if name not in names[section]:
                    problem = '%s has no %s in %s to remap%s' % (
                        quoted(interface.name), quoted(name), section,
                        did_you_mean(near_misses(name, names[section])))
                    raise self._error(section, [name], problem, 'unknown-name')

    def _error(self, section: str, names: Sequence[str], problem: str, fault_id: str
               ) -> InvalidSemanticInterface:
        """The error of these names, with the place of the first remapping, or of the namespace."""
        source = self.source or {}
        new_names = (source.get('remappings') or {}).get(section) or {}
        place = next((key_place(new_names, name) for name in names if name in new_names),
                     value_place(source, 'global_namespace'))
        file_name = '<%s>' % self.name if self.file_name is None else self.file_name
        return with_id(InvalidSemanticInterface(problem, file_name, *place), fault_id)


def _make(reading: SpecReading) -> SemanticCapabilityInterface:
    semantic_interface = SemanticCapabilityInterface(
        reading.name, reading.required_name('redefines'), 1, reading.description,
        reading.spec.text('global_namespace'))
    read_remappings(reading, semantic_interface)
    return semantic_interface


_loader = SpecLoader(
    'semantic_interface', ('redefines', 'global_namespace', 'remappings'), InvalidSemanticInterface,
    _make)

# Each is described where SpecLoader defines it, and in its own help().
semantic_capability_interface_from_dict = _loader.from_dict
semantic_capability_interface_from_file = _loader.from_file
semantic_capability_interface_from_file_path = _loader.from_file_path
semantic_capability_interface_from_string = _loader.from_string
