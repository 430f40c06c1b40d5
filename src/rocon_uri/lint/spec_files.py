"""What can be wrong in a capability spec that can be read."""
from __future__ import annotations

from capabilities.specs.common import InvalidSpec
from rocon_uri.sources.wording import quoted
from rocon_uri.lint.checked_file import NOWHERE, CheckedFile
from rocon_uri.lint.finding import WARNING
from rocon_uri.lint.launch_files import check_launch_file
from rocon_uri.sources.yaml_data import YamlMapping, YamlSequence

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, List
    from capabilities.specs.interface import CapabilityInterface
    from capabilities.specs.provider import CapabilityProvider
    from capabilities.specs.semantic_interface import SemanticCapabilityInterface
    from rocon_uri.lint.checked_file import Place
    from rocon_uri.lint.finding import Finding
    from rocon_uri.lint.surroundings import Surroundings

__all__ = ['check_spec']


def check_spec(spec: Any, path: str, package_folder: str,
               surroundings: Surroundings) -> List[Finding]:
    """
    Check one spec.

    :param spec: an interface, a semantic interface or a provider that is in the index
    :param str path: the file that it was read from
    :param str package_folder: where the package is that exports it
    :param Surroundings surroundings: what it may refer to
    :returns: list of `Finding`
    """
    file = CheckedFile(path, package_folder)
    for warning in spec.warnings:
        file.warn(warning.problem, warning.place)
    if spec.spec_type == 'interface':
        _check_interface(spec, file)
    elif spec.spec_type == 'provider':
        _check_provider(spec, file, surroundings)
    else:
        _check_semantic_interface(spec, file, surroundings)
    return file.findings


def _check_interface(spec: CapabilityInterface, file: CheckedFile) -> None:
    sections: Any = (spec.source or {}).get('interface')
    for section, name, element, grouping in spec.elements():
        elements = sections[section] if grouping is None else sections[section][grouping]
        file.check_ros_name(name, element.kind, elements.key_position(name))
        if section != 'parameters':     # their types are words like int and URDF
            file.check_type(element.type or '', '%s %s' % (element.kind, quoted(name)),
                            elements[name].value_position('type'))
    for index, name in enumerate(spec.dynamic_parameters):
        file.check_ros_name(name, 'dynamic_parameter',
                            sections['dynamic_parameters'].item_position(index))


def _check_semantic_interface(spec: SemanticCapabilityInterface, file: CheckedFile,
                              surroundings: Surroundings) -> None:
    namespace = spec.global_namespace
    if namespace is not None:
        file.check_ros_name(namespace.rstrip('/') or namespace, 'global_namespace',
                            _place(spec, 'global_namespace'))
    for new_names in _remappings(spec).values():
        for name, new_name in (new_names or {}).items():
            file.check_ros_name(new_name, 'new name', new_names.value_position(name))
    try:
        spec.resolve(surroundings.capabilities[spec.redefines])
    except InvalidSpec as error:
        file.error(error.problem, error.place)


def _check_provider(spec: CapabilityProvider, file: CheckedFile,
                    surroundings: Surroundings) -> None:
    if spec.launch_file is not None:
        # The capability server looks beside the spec; people also write it from the package.
        file.findings += check_launch_file(spec.launch_file, _place(spec, 'launch_file'), file,
                                           surroundings.launch_files, if_in_package=WARNING)
    interface = surroundings.interface(spec.implements)
    if interface is not None:
        for kind, new_names in _remappings(spec).items():
            file.check_remapped_names(kind, new_names or {}, interface)
    for dependency in spec.dependencies.values():
        _check_dependency(dependency, spec, file, surroundings)
    if spec.name in surroundings.cycles:
        file.error(str(surroundings.cycles[spec.name]), _place(spec, 'depends_on'))


def _check_dependency(dependency: Any, spec: CapabilityProvider, file: CheckedFile,
                      surroundings: Surroundings) -> None:
    given = (spec.source or {}).get('depends_on')
    name, preferred = dependency.capability_name, dependency.preferred_provider
    place = _place(spec, 'depends_on')
    if isinstance(given, YamlMapping):
        place = given.key_position(name)
    elif isinstance(given, YamlSequence):
        place = given.item_position(given.index(name))
    file.check_exists(name, 'capability', surroundings.capabilities, place)
    if preferred is None or not isinstance(given, YamlMapping):
        return
    place = given[name].value_position('provider')
    if file.check_exists(preferred, 'preferred provider', surroundings.providers, place):
        implemented = surroundings.providers[preferred].implements
        redefined = getattr(surroundings.capabilities.get(implemented), 'redefines', None)
        if name not in (implemented, redefined):
            file.error('preferred provider %s implements %s, not %s' % (
                quoted(preferred), quoted(implemented), quoted(name)), place)


def _remappings(spec: Any) -> Any:
    """The remappings as they stand in the file, by kind."""
    return (spec.source or {}).get('remappings') or {}


def _place(spec: Any, key: str) -> Place:
    """Where the value of a key begins."""
    return spec.source.value_position(key) if spec.source and key in spec.source else NOWHERE
