"""The packages that a verb looks at, what they export, and a report of what is wrong with them."""
from __future__ import annotations

import io
import os
import shlex
import sys

from rocon_uri.cli.given import Report, say
from rocon_uri.sources import wording
from rocon_uri.sources.wording import near_misses

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from logging import LogRecord
    from typing import Callable, Collection, Iterable, List, Optional, Sequence, Set, Tuple

    from rocon_uri.sources.located import Fault
    from rocon_uri.sources.packages import PackageError
    from rocon_uri.workspace import Workspace

__all__ = ['PackageReport', 'add_package_path', 'escape_unencodable', 'meant', 'mention_faults',
           'one_line', 'package_path', 'quiet_loggers', 'shortened', 'shown_path',
           'workspace']


def add_package_path(parser: argparse.ArgumentParser) -> None:
    """Let a verb take ``--package-path``."""
    parser.add_argument('--package-path', metavar='PATH', action='append',
                        help='folders with packages below them, %s between; several add up '
                        '(default: ROS_PACKAGE_PATH)' % os.pathsep)


def one_line(text: object) -> str:
    """
    What somebody wrote into a file, on one line: no control characters, white space is one blank.

    >>> one_line('Dance\\x1b[31m\\n')
    'Dance\\\\x1b[31m'
    """
    return wording.printable(' '.join(str(text).split()))


def shown_path(path: str) -> str:
    """A path as a terminal shows it: relative, if it is below the working directory."""
    relative = os.path.relpath(path)
    return wording.printable(path if relative.startswith(os.pardir) else relative)


def shortened(text: str) -> str:
    """What is left of a description where there is one line for it."""
    line = one_line(text)
    return line if len(line) <= 100 else line[:97] + '...'


class PackageReport(Report):
    """A report that also takes what is wrong with files that are not lists of URIs."""

    def bad(self, message: str, file: Optional[str] = None, line: Optional[int] = None,
            suggestions: Sequence[str] = ()) -> None:
        """Report a fault in one line; a message about a file names it, too."""
        say(message if file else 'rocon_uri: ' + message)
        self.note(message, file, line, suggestions)

    def bad_file(self, fault: Fault) -> None:
        """Report what discovery or the reading of a file has found."""
        self.bad(*fault_message(fault))

    def keep(self, message: str, file: Optional[str] = None, line: Optional[int] = None) -> None:
        """Keep what spoils no answer for JSON. Parameters as in `bad`."""
        status = self.status
        self.note(message, file, line)
        self.status = status


def fault_message(fault: Fault) -> Tuple[str, str, Optional[int]]:
    """A fault as (message, file, line)."""
    if isinstance(fault, OSError):
        file = os.fsdecode(fault.filename or '')
        return '%s: %s' % (wording.printable(file), fault.strerror or fault), file, None
    return str(fault), fault.file_name, fault.line


def meant(name: str, names: Collection[str]) -> List[str]:
    """The names that are like this one, as a whole or without the package."""
    package, _, own_name = name.rpartition('/')
    near = near_misses(own_name, {other.partition('/')[2] for other in names})
    alike = [other for own in near for other in names if other.endswith('/' + own)]
    if alike or any(other.startswith(package + '/') for other in names):
        return alike[:3]
    return near_misses(name, names)


def package_path(args: argparse.Namespace, report: Optional[PackageReport] = None,
                 is_needed: bool = True) -> List[str]:
    """The folders to look for packages in; a report gets bad ones, and the lack of a needed one."""
    if args.package_path is None:
        text = os.environ.get('ROS_PACKAGE_PATH', '')   # often names folders that do not exist
    else:
        text = os.pathsep.join(args.package_path)
    folders = [folder for folder in text.split(os.pathsep) if folder]
    if report is None:
        return folders
    if is_needed and not folders:
        report.bad('no package path, expected ROS_PACKAGE_PATH or --package-path')
    if args.package_path is not None:
        for folder in folders:
            if not os.path.isdir(folder):
                report.bad('%s is not a directory' % wording.quoted_path(folder))
    return folders


def workspace(args: argparse.Namespace) -> Tuple[PackageReport, Workspace]:
    """All that the packages on the package path export, and a report without their faults yet."""
    # here, since they load catkin_pkg and YAML
    from rocon_uri.exported_rules import rules_paths
    from rocon_uri.sources.packages import find_packages
    from rocon_uri.workspace import load_workspace
    escape_unencodable()
    report = PackageReport(args.json)
    faults: List[PackageError] = []
    packages = find_packages(package_path(args, report), faults)
    quiet_loggers([*rules_paths(packages), *(fault.file_name for fault in faults)])
    return report, load_workspace(packages, faults)


def mention_faults(args: argparse.Namespace, report: PackageReport, exported: Workspace,
                   is_cause: Callable[[str], bool] = lambda file: False) -> None:
    """
    Count the files with faults, which spoil no answer, and show the faults that are about it.

    :param args: those of the verb, which took `add_package_path`
    :param report: keeps all faults for JSON, and its status
    :param exported: what `workspace` returned
    :param is_cause: takes the path of a file: may its faults be why the answer is as it is?
    """
    others = {}
    for fault in exported.faults:
        message, file, line = fault_message(fault)
        report.keep(message, file, line)
        if file is not None and is_cause(file):
            say(message)
        else:
            others[file] = fault
    if others:
        folders = package_path(args)
        check = ['specs', 'check', *(folder for folder in folders if any(
            file.startswith(os.path.join(os.path.abspath(folder), '')) for file in others))]
        if args.package_path is not None and len(folders) > 1:
            check += ['--package-path', os.pathsep.join(folders)]
        say('%d %s: rocon_uri %s' % (
            len(others), 'file has faults' if len(others) == 1 else 'files have faults',
            ' '.join(map(shlex.quote, check))))


def quiet_loggers(reported: Iterable[str]) -> None:
    """
    Say nothing twice: what discovery logs is reported too, or is for the linter to say.

    :param reported: iterable of str, the absolute paths of the manifests and the files of rules
        whose faults the verb reports
    """
    import logging      # discovery has loaded it in any case
    logger = logging.getLogger('capabilities')
    if not logger.handlers:
        logger.addHandler(logging.NullHandler())
    _reported.clear()
    _reported.update(reported)
    logging.getLogger('rocon_uri').addFilter(_is_not_reported)      # which adds it once


_reported: Set[str] = set()     # the files whose faults are not to be logged


def _is_not_reported(record: LogRecord) -> bool:
    return not any(getattr(fault, 'file_name', None) in _reported for fault in record.args or ())


def escape_unencodable() -> None:
    """Print what the terminal's encoding does not have as escapes, instead of failing."""
    if isinstance(sys.stdout, io.TextIOWrapper):    # another stream is the caller's
        sys.stdout.reconfigure(errors='backslashreplace')
