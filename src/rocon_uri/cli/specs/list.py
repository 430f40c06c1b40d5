"""
List capability interfaces, semantic interfaces and providers.

Example:
  rocon_uri specs list --package-path ~/catkin_ws/src

Exit status: 0; 2 if a folder was bad, though the others are listed
JSON: {"specs": [{"name", "spec_type", "description", "file", "implements",
"redefines"}, ...], "errors": [ERROR, ...]}, with null for
what a spec does not have
"""
from __future__ import annotations

import argparse

from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.packages import add_package_path, mention_faults, shortened, workspace

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_package_path(parser)


def main(args: argparse.Namespace) -> int:
    report, exported = workspace(args)
    mention_faults(args, report, exported)
    specs = {spec.name: {
        'name': spec.name, 'spec_type': spec.spec_type, 'description': spec.description,
        'file': spec.file_name, 'implements': getattr(spec, 'implements', None),
        'redefines': getattr(spec, 'redefines', None),
    } for spec in exported.spec_index.specs.values()}
    if args.json:
        print_json({'specs': list(specs.values()), 'errors': report.errors})
        return report.status
    paint = painter()
    width = max(map(len, specs), default=0)
    for spec_type in 'interface', 'semantic_interface', 'provider':
        found = {name: spec for name, spec in specs.items() if spec['spec_type'] == spec_type}
        if found:
            print(paint('%ss' % spec_type.replace('_', ' '), 'bold'))
        for name, spec in found.items():
            about = next(('%s %s' % (key, spec[key]) for key in ('implements', 'redefines')
                          if spec[key] is not None), spec['description'])
            print('  %s%s  %s' % (paint(name, 'cyan'), ' ' * (width - len(name)),
                                  shortened(str(about))))
    return report.status
