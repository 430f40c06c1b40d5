"""
List capability interfaces, semantic interfaces and providers.

Example:
  rocon_uri specs list --package-path ~/catkin_ws/src

Exit status: 0; 2 if a folder or a file was bad, though the others are listed
JSON: {"specs": [{"name", "spec_type", "description", "file", "implements",
"redefines"}, ...], "errors": [ERROR, ...]}, with null for
what a spec does not have
"""
from __future__ import annotations

from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.packages import (
    PackageReport, add_package_path, escape_unencodable, shortened, workspace)

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict

    from capabilities.spec_index import Spec

__all__ = ['add_arguments', 'main']

_HEADINGS = {'interface': 'interfaces', 'semantic_interface': 'semantic interfaces',
             'provider': 'providers'}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_package_path(parser)


def main(args: argparse.Namespace) -> int:
    escape_unencodable()
    report = PackageReport(args.json)
    index = workspace(args, report).spec_index
    if args.json:
        print_json({'specs': [_as_json(spec) for spec in index.specs.values()],
                    'errors': report.errors})
    else:
        _show(index.specs)
    return report.status


def _show(specs: Dict[str, Spec]) -> None:
    paint = painter()
    width = max(map(len, specs), default=0)
    for spec_type, heading in _HEADINGS.items():
        found = [spec for spec in specs.values() if spec.spec_type == spec_type]
        if found:
            print(paint(heading, 'bold'))
        for spec in found:
            print('  %s%s  %s' % (paint(spec.name, 'cyan'), ' ' * (width - len(spec.name)),
                                  shortened(_about(spec))))


def _about(spec: Spec) -> str:
    for key in 'implements', 'redefines':
        if hasattr(spec, key):
            return '%s %s' % (key, getattr(spec, key))
    return str(spec.description)


def _as_json(spec: Spec) -> Dict[str, object]:
    return {'name': spec.name, 'spec_type': spec.spec_type, 'description': spec.description,
            'file': spec.file_name, 'implements': getattr(spec, 'implements', None),
            'redefines': getattr(spec, 'redefines', None)}
