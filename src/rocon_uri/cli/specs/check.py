"""
Check all that packages export, for continuous integration.

Examples:
  rocon_uri specs check
  rocon_uri specs check src our_rapps --format github
  rocon_uri specs check rapps/dance/dance.rapp --ignore file-missing
  rocon_uri specs check --explain launch-missing

Checks package.xml files, and the specs, apps and rules that packages export, and
every .interactions file in them. They may refer to each other and to packages on
the package path. PATH is a folder with packages in or below it, the name of a
package on the package path, or a single file, which is checked as what its package
makes of it; without any, the working directory is checked. A single file may also
refer to packages below the working directory.

Prints findings as FILE:LINE:COLUMN: SEVERITY: TEXT [ID]. An error is something that
does not work, or not as it is written; a warning is something that works but was
probably not meant. A finding is left out with --ignore ID, with a comment
"# rocon_uri: ignore[ID]" on its line (in XML "<!-- rocon_uri: ignore[ID] -->", on
the line or above), or with "ignore: [ID, 'ID:rapps/*.rapp']" in a .rocon_uri.yaml
beside the package.xml.

Exit status: 0 if there is no error, warnings or not; 1 if there is one; 2 if a
PATH is bad or has no package in it, though the others are checked
JSON: {"findings": [{"file", "line", "column", "severity", "id", "text"}, ...],
"packages": [NAME, ...], "errors": [ERROR, ...]}, with null as line and column
of a finding that has no place; with --explain {"id", "section", "what", "why",
"mend", "example", "errors"}
"""
from __future__ import annotations

import os

from rocon_uri.cli.display import columns, painter, print_json
from rocon_uri.cli.given import say
from rocon_uri.cli.packages import (
    PackageReport, add_package_path, escape_unencodable, package_path, quiet_loggers)
from rocon_uri.sources.wording import (
    carets, did_you_mean, near_misses, printable, quoted, quoted_path)

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict, Iterable, List

    from rocon_uri.lint import Checked
    from rocon_uri.lint.finding import Finding

__all__ = ['add_arguments', 'main']

_INDENT = '    '    # of the line that a finding is in


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the verb takes."""
    parser.add_argument('paths', metavar='PATH', nargs='*',
                        help='a folder, the name of a package or a file (default: the working '
                        'directory)')
    add_package_path(parser)
    parser.add_argument('--format', choices=('text', 'json', 'github', 'junit', 'sarif'),
                        default='text',
                        help='github is for the log of a GitHub workflow, which shows each '
                        'finding beside its line; json is the same as --json')
    parser.add_argument('--junit', metavar='FILE',
                        help='also write a report of test results, as catkin reads it')
    ignore = parser.add_argument(
        '--ignore', metavar='ID', action='append', default=[],
        help='leave out the findings with this id (can be given several times)')
    parser.add_argument('--warnings-as-errors', action='store_true',
                        help='make errors of all warnings')
    parser.add_argument('-q', '--quiet', action='store_true',
                        help='print findings only, not how many there are')
    explain = parser.add_argument(
        '--explain', metavar='ID',
        help='say what a finding means and how to mend it, and check nothing')
    for argument in ignore, explain:
        argument.completer = _all_ids   # type: ignore[attr-defined]    # for argcomplete


def _all_ids(**_: object) -> List[str]:
    """What the shell offers for an ID."""
    from rocon_uri.lint.explanations import EXPLANATIONS
    return list(EXPLANATIONS)


def main(args: argparse.Namespace) -> int:
    """Do it, and return the exit status."""
    # here, since they load catkin_pkg and YAML, and a verb can be asked for help without
    from dataclasses import replace
    from rocon_uri.exported_rules import rules_paths
    from rocon_uri.lint import ERROR, WARNING, check_package_index
    from rocon_uri.lint.checked_file import is_inside
    from rocon_uri.lint.junit import junit_text
    from rocon_uri.lint.targets import find_targets
    from rocon_uri.sources.packages import find_packages
    escape_unencodable()
    if args.json and args.format not in ('text', 'json'):
        say('rocon_uri specs check: error: give --json or --format %s' % args.format)
        return 2
    report = PackageReport(args.json or args.format == 'json')
    if args.explain is not None:
        return _explain(args, report)
    _check_ids(args.ignore, report)
    others = find_packages(package_path(args, report, is_needed=False))
    targets = find_targets(args.paths or [os.curdir], others)
    for error in targets.errors:
        report.bad(error)
    if not targets.are_whole:
        others = {**others, **find_packages([os.curdir])}
    quiet_loggers([fault.file_name for fault in targets.faults] + [
        path for path in rules_paths(targets.packages)
        if any(is_inside(path, given) for given in targets.only)])
    checked = check_package_index(targets.packages, others, targets.faults, targets.only,
                                  args.ignore, targets.findings)
    if args.warnings_as_errors:
        checked = checked._replace(findings=[
            replace(finding, severity=ERROR) for finding in checked.findings])
    if args.junit is not None and not report.status:     # no report is a failure for catkin
        _write(junit_text(checked.findings, checked.files), args.junit, report)
    _show(args, checked, list(targets.packages), report)
    errors = sum(finding.severity == ERROR for finding in checked.findings)
    if not args.quiet:
        say('rocon_uri: %s and %s in %s' % (
            _counted(errors, 'error'), _counted(len(checked.findings) - errors, WARNING),
            _counted(len(targets.packages), 'package') if targets.are_whole else
            _counted(len(checked.files), 'file')))
    return report.status or (1 if errors else 0)


def _show(args: argparse.Namespace, checked: Checked, packages: List[str],
          report: PackageReport) -> None:
    """Print the findings in the form that is asked for."""
    if args.json or args.format == 'json':
        print_json({'findings': [finding.as_json() for finding in checked.findings],
                    'packages': packages, 'errors': report.errors})
    elif args.format == 'sarif':
        from rocon_uri.lint.sarif import sarif_log
        print_json(sarif_log(checked.findings))
    elif args.format == 'junit':
        from rocon_uri.lint.junit import junit_text
        print(junit_text(checked.findings, checked.files))
    elif args.format == 'github':
        for finding in checked.findings:
            print(finding.as_github())
    else:
        _show_text(checked.findings)


def _show_text(findings: Iterable[Finding]) -> None:
    """Print a line for each finding; on a terminal in colour, with the line that it is in."""
    import sys
    if not sys.stdout.isatty():
        for finding in findings:
            print(finding)
        return
    from rocon_uri.lint.source_lines import SourceLines
    paint = painter()
    colours = {'error': 'red', 'warning': 'yellow'}
    lines = SourceLines()
    width = columns() - len(_INDENT)
    for finding in findings:
        text, sentence = str(finding), printable(finding.sentence)
        colour = colours[finding.severity]
        print(text[:-len(sentence)] + paint(finding.severity, colour)
              + sentence[len(finding.severity):])
        if finding.line is not None:
            for line in _marked(lines.line(finding.file_name, finding.line), finding.column or 1,
                                finding.problem, width):
                print(_INDENT + line)


def _marked(line: str, column: int, problem: str, width: int) -> List[str]:
    """
    The part of a line around a column, and carets below the text there that a problem quotes.

    It has at most so many characters, since carets are below nothing once a line is wrapped.
    """
    import re
    start = max(0, column - 41)
    end = start + min(101, max(60, width) - 2 * len('...'))
    before = '...' if start else ''
    shown = ''.join(c if c.isprintable() else ' ' if c == '\t' else '?' for c in line[start:end])
    after = '...' if len(line) > end else ''
    if not shown.strip():
        return []
    at = column - 1 - start
    quoted = [len(text) for text in re.findall("'([^']+)'", problem)
              if line.startswith(text, column - 1)]
    return [before + shown + after,
            carets(before + shown[:at], shown[at:at + max(quoted, default=1)])]


def _explain(args: argparse.Namespace, report: PackageReport) -> int:
    """Print what a finding means."""
    from rocon_uri.lint.explanations import EXPLANATIONS
    _check_ids([args.explain], report)
    explanation = EXPLANATIONS.get(args.explain)
    if args.json or args.format == 'json':
        texts: Dict[str, object] = {} if explanation is None else dict(explanation._asdict())
        print_json({**texts, 'errors': report.errors})
    elif explanation is not None:
        print(explanation)
    return report.status


def _check_ids(ids: Iterable[str], report: PackageReport) -> None:
    """Report what is not the id of a finding."""
    from rocon_uri.lint.explanations import EXPLANATIONS
    for fault_id in ids:
        if fault_id not in EXPLANATIONS:
            near = near_misses(fault_id, EXPLANATIONS)
            report.bad('%s is not the id of a finding%s' % (quoted(fault_id), did_you_mean(near)),
                       suggestions=near)


def _write(text: str, path: str, report: PackageReport) -> None:
    try:
        os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text + '\n')
    except OSError as error:
        message = 'cannot write %s: %s' % (quoted_path(path), error.strerror)
        say('rocon_uri: ' + message)
        report.note(message, path)


def _counted(number: int, what: str) -> str:
    return '%s %s%s' % (number or 'no', what, '' if number == 1 else 's')
