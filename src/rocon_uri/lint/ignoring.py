"""
Which findings are not shown: those that are ignored on the command line, in a comment or in the
``.rocon_uri.yaml`` of a package::

    launch: dance.launch    # rocon_uri: ignore[launch-missing]

    <!-- rocon_uri: ignore[file-missing] -->
    <rocon_app>rapps/dance.rapp</rocon_app>

    ignore:                             # in .rocon_uri.yaml, for all files of the package
      - file-missing
      - 'unknown-key:rapps/*.rapp'      # for those files only; a * stands for slashes, too
"""
from __future__ import annotations

import os
import re
from fnmatch import fnmatchcase
from typing import Collection, Dict, FrozenSet, Iterable, Iterator, List, NamedTuple, Tuple

from rocon_uri.lint.checked_file import CheckedFile, is_inside
from rocon_uri.lint.explanations import EXPLANATIONS
from rocon_uri.lint.finding import Finding
from rocon_uri.lint.source_lines import SourceLines, is_xml
from rocon_uri.sources.wording import quoted
from rocon_uri.sources.yaml_data import value_place

__all__ = ['CONFIGURATION', 'Ignored', 'read_configuration', 'without_ignored']

#: the file in the folder of a package that says what is ignored in its files
CONFIGURATION = '.rocon_uri.yaml'

_ids_in_yaml = re.compile(r'#\s*rocon_uri:\s*ignore\[([^][]*)\]').findall
_ids_in_xml = re.compile(r'<!--\s*rocon_uri:\s*ignore\[([^][]*)\]\s*-->').findall
_is_xml_comment = re.compile(r'\s*<!--((?!-->).)*-->\s*').fullmatch


class Ignored(NamedTuple):
    """Findings that a package does not want to see."""

    #: the folder of the package
    folder: str
    #: their id
    id: str
    #: the files that they are in: a pattern of paths relative to the folder
    glob: str

    def covers(self, finding: Finding) -> bool:
        """
        Is this finding, whose file has an absolute path, one of them?

        >>> finding = Finding('/ours/a/dance.rapp', 1, 1, 'error', 'icon ...', 'file-missing')
        >>> Ignored('/ours', 'file-missing', 'a/*.rapp').covers(finding)
        True
        """
        return (finding.id == self.id and is_inside(finding.file_name, self.folder)
                and fnmatchcase(os.path.relpath(finding.file_name, self.folder), self.glob))


def read_configuration(package_folder: str) -> Tuple[List[Ignored], List[Finding]]:
    """
    What the ``.rocon_uri.yaml`` of a package says, if there is one.

    :param str package_folder: the folder of the package
    :returns: (list of `Ignored`, list of `Finding`: what is wrong with the file)
    """
    file = CheckedFile(os.path.join(package_folder, CONFIGURATION), package_folder)
    if not os.path.lexists(file.path):
        return [], []
    data = file.read()
    configuration = file.mapping({} if data is None else data, 'the configuration')
    configuration.warn_of_unknown(('ignore',))
    entries = configuration.sequence('ignore')
    ignored = []
    for index, entry in enumerate(entries):
        place = value_place(entries, index)
        fault_id, _, glob = file.text(entry, 'an item of ignore', place).partition(':')
        if fault_id in EXPLANATIONS:
            ignored.append(Ignored(folder=package_folder, id=fault_id, glob=glob or '*'))
        elif fault_id:
            file.warn('%s is not the id of a finding%s' % (
                quoted(fault_id), file.suggestion(fault_id, EXPLANATIONS)), place,
                'wrong-value')
    return ignored, file.findings


def without_ignored(findings: Iterable[Finding], ids: Collection[str],
                    configured: Iterable[Ignored]) -> Iterator[Finding]:
    """
    The findings that are shown.

    :param findings: iterable of `Finding`, with absolute paths
    :param ids: collection of str, those that are ignored in all files
    :param configured: as `read_configuration` returns them for each package

    >>> list(without_ignored([Finding('/a', 1, 1, 'error', 'no', 'cycle')], ['cycle'], []))
    []
    """
    comments = _Comments()
    by_id: Dict[str, List[Ignored]] = {}
    for ignored in configured:
        by_id.setdefault(ignored.id, []).append(ignored)
    for finding in findings:
        if not (finding.id in ids or finding.id in comments.ids(finding)
                or any(ignored.covers(finding) for ignored in by_id.get(finding.id, ()))):
            yield finding


class _Comments:
    """The comments on the lines of findings, each line read once."""

    def __init__(self) -> None:
        self._lines = SourceLines()
        self._ids: Dict[Tuple[str, int], FrozenSet[str]] = {}

    def ids(self, finding: Finding) -> FrozenSet[str]:
        """Those in a comment on its line, in XML also in one alone on the line above."""
        if finding.line is None:
            return frozenset()
        place = finding.file_name, finding.line
        if place not in self._ids:
            self._ids[place] = frozenset(self._read(*place))
        return self._ids[place]

    def _read(self, path: str, number: int) -> Iterator[str]:
        line = self._lines.line(path, number)
        if not is_xml(path):
            found = _ids_in_yaml(line)
        else:
            above = self._lines.line(path, number - 1)
            found = _ids_in_xml(line) + (_ids_in_xml(above) if _is_xml_comment(above) else [])
        for ids in found:
            yield from map(str.strip, ids.split(','))
