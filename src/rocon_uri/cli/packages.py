"""The packages that a verb looks at, what they export, and a report of what is wrong with them."""
from __future__ import annotations

import os
import sys

from rocon_uri.cli.given import Report, say
from rocon_uri.sources import wording

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import List, Optional, Sequence, Tuple

    from rocon_uri.sources.located import Fault
    from rocon_uri.workspace import Workspace

__all__ = ['PackageReport', 'add_package_path', 'escape_unencodable', 'package_path',
           'printable', 'quiet_loggers', 'shortened', 'workspace']


def add_package_path(parser: argparse.ArgumentParser) -> None:
    """Let a verb take ``--package-path``."""
    parser.add_argument('--package-path', metavar='PATH',
                        help='folders with packages below them, %s between (default: '
                        'ROS_PACKAGE_PATH)' % os.pathsep)


def printable(text: object) -> str:
    """
    What somebody wrote into a file, on one line: no control characters, white space is one blank.

    >>> printable('Dance\\x1b[31m\\n')
    'Dance\\\\x1b[31m'
    """
    return wording.printable(' '.join(str(text).split()))


def shortened(text: str) -> str:
    """What is left of a description where there is one line for it."""
    line = printable(text)
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
        if isinstance(fault, OSError):
            file = os.fsdecode(fault.filename or '')
            self.bad('%s: %s' % (printable(file), fault.strerror or fault), file)
        else:
            self.bad(str(fault), fault.file_name, fault.line)


def package_path(args: argparse.Namespace, report: PackageReport,
                 is_needed: bool = True) -> List[str]:
    """The folders to look for packages in; bad ones are reported, and the lack of a needed one."""
    text = args.package_path
    if text is None:
        text = os.environ.get('ROS_PACKAGE_PATH', '')   # often names folders that do not exist
    folders = [folder for folder in text.split(os.pathsep) if folder]
    if is_needed and not folders:
        report.bad('no package path, expected ROS_PACKAGE_PATH or --package-path')
    if args.package_path is not None:
        for folder in folders:
            if not os.path.isdir(folder):
                report.bad('%s is not a directory' % wording.quoted_path(folder))
    return folders


def workspace(args: argparse.Namespace) -> Tuple[PackageReport, Workspace]:
    """All that the packages on the package path export, with a report of their faults."""
    from rocon_uri.workspace import read_workspace  # here, since it loads catkin_pkg and YAML
    escape_unencodable()
    quiet_loggers()
    report = PackageReport(args.json)
    found = read_workspace(package_path(args, report))
    for fault in found.faults:
        report.bad_file(fault)
    return report, found


def quiet_loggers() -> None:
    """Say nothing twice: what discovery logs is reported too, or is for the linter to say."""
    import logging      # discovery has loaded it in any case
    logger = logging.getLogger('capabilities')
    if not logger.handlers:
        logger.addHandler(logging.NullHandler())


def escape_unencodable() -> None:
    """Print what the terminal's encoding does not have as escapes, instead of failing."""
    sys.stdout.reconfigure(errors='backslashreplace')   # type: ignore[union-attr]
