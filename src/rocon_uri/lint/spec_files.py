"""Checks capability specs that can be read."""
from __future__ import annotations

from typing import List, Union

from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import CapabilityInterface
from capabilities.specs.provider import CapabilityProvider, DependsOnRelationship
from capabilities.specs.semantic_interface import SemanticCapabilityInterface
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import WARNING, Finding
from rocon_uri.sources.checked import CheckedMapping
from rocon_uri.sources.wording import quoted
from rocon_uri.sources.yaml_data import key_place, value_place
from rocon_uri.workspace import Workspace

__all__ = ['check_spec']

Spec = Union[CapabilityInterface, SemanticCapabilityInterface, CapabilityProvider]


def check_spec(spec: Spec, path: str, package_folder: str,
               workspace: Workspace) -> List[Finding]:
    """
    Check one spec.

    :param spec: an interface, a semantic interface or a provider that is in the index
    :param str path: the file that it was read from
    :param str package_folder: the folder of the package that exports it
    :param Workspace workspace: what it may refer to
    :returns: list of `Finding`
    """
    file = CheckedFile(path, package_folder)
    source = CheckedMapping(file, spec.source or {}, 'the spec')
    for warning in spec.warnings:
        file.warn(warning.problem, warning.place, warning.id)
    if isinstance(spec, CapabilityInterface):
        _check_interface(spec, source, file)
    elif isinstance(spec, CapabilityProvider):
        _check_provider(spec, source, file, workspace)
    else:
        _check_semantic_interface(spec, source, file, workspace)
    return file.findings


def _check_interface(spec: CapabilityInterface, source: CheckedMapping, file: CheckedFile) -> None:
    sections = source.mapping('interface')
    for section, name, element, grouping in spec.elements():
        elements = sections.mapping(section)
        if grouping is not None:
            elements = elements.mapping(grouping)
        file.check_ros_name(name, element.kind, elements.key_place(name))
        if section != 'parameters':     # their types are words like int and URDF
            file.check_type(element.type or '', '%s %s' % (element.kind, quoted(name)),
                            value_place(elements.get(name), 'type'))
    for index, name in enumerate(spec.dynamic_parameters):
        file.check_ros_name(name, 'dynamic_parameter',
                            value_place(sections.get('dynamic_parameters'), index))


def _check_semantic_interface(spec: SemanticCapabilityInterface, source: CheckedMapping,
                              file: CheckedFile, workspace: Workspace) -> None:
    namespace = spec.global_namespace
    if namespace is not None:
        file.check_ros_name(namespace.rstrip('/') or namespace, 'global_namespace',
                            source.value_place('global_namespace'))
    kinds = source.mapping('remappings')
    for kind in kinds:
        new_names = kinds.mapping(kind, is_checked=False)
        for name in new_names:
            file.check_ros_name(new_names.get(name), 'new name', new_names.value_place(name))
    try:
        spec.resolve(workspace.redefined_by(spec))
    except InvalidSpec as error:
        file.refuse(error)


def _check_provider(spec: CapabilityProvider, source: CheckedMapping, file: CheckedFile,
                    workspace: Workspace) -> None:
    if spec.launch_file is not None:
        # The capability server looks beside the spec; people also write it from the package.
        file.check_launch_file(spec.launch_file, source.value_place('launch_file'),
                               workspace.launch_files, if_in_package=WARNING)
    interface = workspace.interface(spec.implements)
    if interface is not None:
        kinds = source.mapping('remappings')
        for kind in kinds:
            file.check_remapped_names(kind, kinds.mapping(kind, is_checked=False), interface)
    for index, dependency in enumerate(spec.dependencies.values()):
        _check_dependency(dependency, index, source, file, workspace)
    if spec.name in workspace.cycles:
        file.error(str(workspace.cycles[spec.name]), source.value_place('depends_on'), 'cycle')


def _check_dependency(dependency: DependsOnRelationship, index: int, source: CheckedMapping,
                      file: CheckedFile, workspace: Workspace) -> None:
    given = source.get('depends_on')
    name, preferred = dependency.capability_name, dependency.preferred_provider
    place = source.value_place('depends_on')
    if isinstance(given, dict):
        place = key_place(given, name)
    elif isinstance(given, list):
        place = value_place(given, index)
    file.check_exists(name, 'capability', workspace.capability_names, place, 'no-interface')
    if preferred is None:
        return
    place = value_place(given[name], 'provider')
    if file.check_exists(preferred, 'preferred provider', workspace.provider_names,
                         place, 'unknown-provider'):
        implemented = workspace.providers[preferred].implements
        redefined = getattr(workspace.capabilities.get(implemented), 'redefines', None)
        if name not in (implemented, redefined):
            file.error('preferred provider %s implements %s, not %s' % (
                quoted(preferred), quoted(implemented), quoted(name)), place, 'wrong-provider')
