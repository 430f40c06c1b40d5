"""
Which findings are not shown: those that are ignored on the command line, in a comment or in the
``.rocon_uri.yaml`` of a package::

    launch: dance.launch    # rocon_uri: ignore[launch-missing]

    <!-- rocon_uri: ignore[file-missing] -->
    <rocon_app>rapps/dance.rapp</rocon_app>

    ignore:                             # in .rocon_uri.yaml, for all files of the package
      - file-missing
      - 'unknown-key:rapps/*.rapp'      # for those files only; a * stands for slashes, too

Matching a glob takes linear time, and each is compared once with each file that has such findings:
what is in a package must not occupy whoever checks it.
"""
from __future__ import annotations

import os
import re
from fnmatch import translate
from pathlib import PurePath
from typing import (
    Collection, Dict, FrozenSet, Iterable, Iterator, List, NamedTuple, Pattern, Tuple)

from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.explanations import EXPLANATIONS
from rocon_uri.lint.finding import Finding
from rocon_uri.lint.source_lines import SourceLines, is_xml
from rocon_uri.sources.wording import quoted
from rocon_uri.sources.yaml_data import value_place

__all__ = ['CONFIGURATION', 'Ignored', 'read_configuration', 'without_ignored']

#: the file in the folder of a package that says what is ignored in its files
CONFIGURATION = '.rocon_uri.yaml'

_MAX_ITEMS = 1000   # of a configuration
_MAX_GLOB = 255     # characters

_ids_in_yaml = re.compile(r'#\s*rocon_uri:\s*ignore\[([^][]*)\]').findall
_ids_in_xml = re.compile(r'<!--\s*rocon_uri:\s*ignore\[([^][]*)\](?:(?!--).)*-->').findall
_is_xml_comment = re.compile(r'\s*<!--((?!-->).)*-->\s*').fullmatch


class Ignored(NamedTuple):
    """Findings that a package does not want to see."""

    #: the folder of the package
    folder: str
    #: their id
    id: str
    #: matches the paths of the files that they are in, relative to the folder
    glob: Pattern[str]


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
        if index == _MAX_ITEMS:
            file.error('ignore has %d items, of which only %d count' % (len(entries), _MAX_ITEMS),
                       place, 'wrong-value')
            break
        fault_id, glob = map(str.strip, file.text(entry, 'an item of ignore', place).partition(
            ':')[::2])
        if fault_id in EXPLANATIONS:
            try:
                ignored.append(Ignored(
                    folder=package_folder, id=fault_id, glob=_compiled(glob or '*')))
            except re.error as error:
                file.error('%s is not a pattern of paths: %s' % (quoted(glob), error.msg), place,
                           'wrong-value')
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
    comments, configurations = _Comments(), _Configurations(configured)
    for finding in findings:
        if not (finding.id in ids or finding.id in comments.ids(finding)
                or configurations.cover(finding.file_name, finding.id)):
            yield finding


class _Configurations:
    """What packages ignore in their files."""

    def __init__(self, ignored: Iterable[Ignored]) -> None:
        self._globs: Dict[Tuple[str, str], List[Pattern[str]]] = {}     # by folder and id
        self._covered: Dict[Tuple[str, str], bool] = {}                 # by file and id
        for folder, fault_id, glob in ignored:
            self._globs.setdefault((folder, fault_id), []).append(glob)

    def cover(self, path: str, fault_id: str) -> bool:
        """Are the findings with this id in a file ignored?"""
        key = path, fault_id
        if key not in self._covered:
            self._covered[key] = any(
                glob.match(os.path.relpath(path, folder))
                for folder in map(str, PurePath(os.path.normpath(path)).parents)
                for glob in self._globs.get((folder, fault_id), ()))
        return self._covered[key]


def _compiled(glob: str) -> Pattern[str]:
    """
    A glob as a regular expression; re.error if it is not one, as of ``[z-a]``, or is too long.

    >>> [bool(_compiled('**/a*.rapp').match(path)) for path in ('ab.rapp', 'x/y/a.rapp', 'ba.rapp')]
    [True, True, False]
    """
    if len(glob) > _MAX_GLOB:
        raise re.error('it has more than %d characters' % _MAX_GLOB)
    glob = glob[2:] if glob.startswith('./') else glob
    folders, glob = ('(?:.*/)?', glob[3:]) if glob.startswith('**/') else ('', glob)
    # What a * stands for is not tried again once the text after it was found. fnmatch does the same
    # from Python 3.9 on, and takes exponential time before.
    first, *others = [translate(part)[:-2] for part in re.split(r'\*+', glob)]  # without its \Z
    middle = ''.join('(?=(?P<g%d>.*?%s))(?P=g%d)' % (number, part, number)
                     for number, part in enumerate(others[:-1]))
    return re.compile(folders + first + middle + '.*'.join(['', *others[-1:]]) + r'\Z', re.DOTALL)


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
