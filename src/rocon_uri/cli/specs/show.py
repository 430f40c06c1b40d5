"""
Show a capability spec and what it takes to run it.

Examples:
  rocon_uri specs show std_capabilities/DifferentialMobileBase
  rocon_uri specs show kobuki_capabilities/kobuki_bumper

For an interface or a semantic interface prints the ROS names, as clients see them,
and the providers. For a provider prints what it implements, remaps and depends on,
and the order in which to start providers.

Exit status: 0; 2 if there is no spec NAME that can be read, or a folder was bad
JSON: {"spec": {...}, "spec_type", "file", "resolved": {...},
"providers": [NAME, ...], "start_order": [NAME, ...], "faults": [TEXT, ...],
"errors": [ERROR, ...]}; spec and resolved are as in the file of a spec; what does
not exist is null
"""
from __future__ import annotations

from rocon_uri.cli.completion import offer, spec_names
from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.packages import (
    add_package_path, meant, mention_faults, one_line, workspace)
from rocon_uri.cli.rows import print_names, print_rows
from rocon_uri.sources import wording
from rocon_uri.sources.wording import did_you_mean, quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict, List, Optional, Sequence, Tuple

    from capabilities.planning.faults import Fault
    from capabilities.spec_index import Spec, SpecIndex
    from capabilities.specs.interface import CapabilityInterface
    from capabilities.specs.provider import CapabilityProvider
    from rocon_uri.sources.launch_file import LaunchFiles

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    offer(spec_names, parser.add_argument('name', metavar='NAME', help='package/name of a spec'))
    add_package_path(parser)


def main(args: argparse.Namespace) -> int:
    report, exported = workspace(args)
    index = exported.spec_index
    spec = index.specs.get(args.name)
    if spec is None:
        suggestions = meant(args.name, index.names)
        report.bad('no spec has the name %s%s' % (quoted(args.name), did_you_mean(suggestions)),
                   suggestions=suggestions)
    from rocon_uri.cli.causes import may_cause, may_define      # here, since it loads YAML
    shown = Shown(spec, index, exported.launch_files)
    mention_faults(args, report, exported, lambda file: (
        spec is None and may_define(args.name, file, exported)
        or any(may_cause(fault, file, exported) for fault in shown.plan_faults)))
    if args.json:
        print_json({
            'spec': spec and spec.to_dict(), 'spec_type': spec and spec.spec_type,
            'file': spec and spec.file_name,
            'resolved': shown.resolved and shown.resolved.to_dict(),
            'providers': shown.providers, 'start_order': shown.start_order,
            'faults': shown.faults, 'errors': report.errors})
    elif spec is not None:
        _print(spec, shown)
    return report.status


class Shown:
    """A spec, and what the other specs say about it."""

    def __init__(self, spec: Optional[Spec], index: SpecIndex, launch_files: LaunchFiles) -> None:
        from capabilities.planning.providers import plan_for_provider    # here, since it loads YAML
        from capabilities.specs.common import InvalidSpec
        from capabilities.specs.interface import CapabilityInterface
        from capabilities.specs.provider import CapabilityProvider
        from capabilities.specs.semantic_interface import SemanticCapabilityInterface
        #: the interface that clients of a semantic interface see
        self.resolved: Optional[CapabilityInterface] = None
        #: what to start for a provider, itself last, and what prevents that
        self.start_order: List[str] = []
        self.plan_faults: List[Fault] = []
        self.faults: List[str] = []
        #: those of an interface or semantic interface
        self.providers = [] if spec is None else index.providers_of(spec.name)
        if isinstance(spec, CapabilityProvider):
            plan = plan_for_provider(index, spec.name, launch_files=launch_files)
            self.start_order, self.plan_faults = plan.order, plan.faults
            self.faults = list(map(str, plan.faults))
        elif isinstance(spec, SemanticCapabilityInterface):
            try:
                self.resolved = spec.resolve(index.interfaces[spec.redefines])
            except InvalidSpec as error:
                self.faults = [str(error)]
        self.provider = spec if isinstance(spec, CapabilityProvider) else None
        self.interface = spec if isinstance(spec, CapabilityInterface) else self.resolved


def _print(spec: Spec, shown: Shown) -> None:
    paint = painter()
    print('%s %s' % (spec.spec_type.replace('_', ' '), paint(spec.name, 'bold')))
    print('  ' + one_line(spec.description))
    print('  in ' + wording.printable(str(spec.file_name)))
    if shown.provider is not None:
        _print_provider(shown.provider)
        print_names('to start, in this order', shown.start_order)
    else:
        redefines = getattr(spec, 'redefines', None)
        if redefines is not None:
            print('redefines %s' % paint(redefines, 'cyan'))
        if shown.interface is not None:
            _print_interface(shown.interface)
        print_names('providers', shown.providers)
    print_names('faults', map(one_line, shown.faults))


def _print_provider(spec: CapabilityProvider) -> None:
    paint = painter()
    print('implements %s' % paint(spec.implements, 'cyan'))
    for key in 'launch_file', 'nodelet_manager':
        if getattr(spec, key) is not None:
            print('%s %s' % (key, wording.printable(getattr(spec, key))))
    print_names('depends on', (
        dependency.capability_name if dependency.preferred_provider is None
        else '%s by %s' % (dependency.capability_name, dependency.preferred_provider)
        for dependency in spec.dependencies.values()))
    for kind, new_names in spec.remappings_by_type.items():
        print_rows('remaps ' + kind, [(name, '->', new_name)
                                       for name, new_name in new_names.items()])


def _print_interface(interface: CapabilityInterface) -> None:
    rows: Dict[Tuple[str, Optional[str]], List[Sequence[str]]] = {}
    for section, name, element, grouping in interface.elements():
        rows.setdefault((section, grouping), []).append((name, element.type or ''))
    for (section, grouping), named in rows.items():
        print_rows('%s %s' % (grouping, section) if grouping else section, named)
    print_names('dynamic_parameters', map(one_line, interface.dynamic_parameters))
