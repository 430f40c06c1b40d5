"""
Check all that packages export, for continuous integration.

Examples:
  rocon_uri specs check
  rocon_uri specs check src
  rocon_uri specs check . --format github

Checks the specs, rapps and rules that the packages in and below PATH export, and
every .interactions file in them. They may refer to each other and to packages on
the package path. Prints findings as FILE:LINE:COLUMN: SEVERITY: TEXT, or in the
form that GitHub reads. An error is something that does not work, or not as it is
written; a warning is something that works but was probably not meant.

Exit status: 0 if there is no error, warnings or not; 1 if there is one; 2 if a
PATH is not a directory or has no package in it, though the others are checked
JSON: {"findings": [{"file", "line", "column", "severity", "text"}, ...],
"packages": [NAME, ...], "errors": [ERROR, ...]}, with null as line and column
of a finding that has no place
"""
from __future__ import annotations

import os

from rocon_uri.cli.display import print_json
from rocon_uri.cli.given import say
from rocon_uri.cli.packages import (
    PackageReport, add_package_path, escape_unencodable, package_path, quiet_loggers)
from rocon_uri.sources.wording import quoted_path

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict, List, Tuple

    from rocon_uri.sources.packages import Package, PackageError

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('paths', metavar='PATH', nargs='*',
                        help='a package, or a folder with packages below it (default: all on '
                        'the package path)')
    add_package_path(parser)
    parser.add_argument('--format', choices=('text', 'github'), default='text',
                        help='github is for the log of a GitHub workflow, which shows each '
                        'finding beside its line')
    parser.add_argument('--junit', metavar='FILE',
                        help='also write a report of test results, as catkin reads it')


def main(args: argparse.Namespace) -> int:
    # here, since they load catkin_pkg and YAML, and a verb can be asked for help without
    from rocon_uri.sources.packages import find_packages
    from rocon_uri.lint import ERROR, check_package_index
    from rocon_uri.lint.finding import junit_text
    escape_unencodable()
    quiet_loggers()
    report = PackageReport(args.json)
    around = package_path(args, report, is_needed=not args.paths)
    if args.paths:
        checked, faults = _given_packages(args.paths, report)
        others = find_packages(around)
    else:
        faults = []
        checked, others = find_packages(around, faults), {}
    findings = check_package_index(checked, others, faults)
    if args.json:
        print_json({'findings': [finding.as_json() for finding in findings],
                    'packages': list(checked), 'errors': report.errors})
    else:
        for finding in findings:
            print(finding.as_github() if args.format == 'github' else finding)
    if args.junit is not None and not report.status:     # no report is a failure for catkin
        _write(junit_text(' '.join(checked) or 'nothing', findings), args.junit, report)
    errors = sum(finding.severity == ERROR for finding in findings)
    say('rocon_uri: %s and %s in %s' % (
        _counted(errors, 'error'), _counted(len(findings) - errors, 'warning'),
        _counted(len(checked), 'package')))
    return report.status or (1 if errors else 0)


def _given_packages(paths: List[str], report: PackageReport
                    ) -> Tuple[Dict[str, Package], List[PackageError]]:
    """The packages in some folders, and their faults. A folder that has neither is reported."""
    from rocon_uri.sources.packages import find_packages      # see main
    packages: Dict[str, Package] = {}
    faults: List[PackageError] = []
    for path in paths:
        new_faults: List[PackageError] = []
        found = find_packages([path], new_faults)
        if not found and not new_faults:
            report.bad('%s %s' % (quoted_path(path), 'has no package in it' if os.path.isdir(path)
                                  else 'is not a directory'))
        for name, package in found.items():
            packages.setdefault(name, package)
        faults += new_faults
    return packages, faults


def _write(text: str, path: str, report: PackageReport) -> None:
    try:
        os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text + '\n')
    except OSError as error:
        report.bad('cannot write %s: %s' % (quoted_path(path), error.strerror))


def _counted(number: int, what: str) -> str:
    return '%s %s%s' % (number or 'no', what, '' if number == 1 else 's')
