"""A file that is checked, its findings, and the checks that several kinds of files share."""
from __future__ import annotations

import os
from typing import Collection, List, Optional, Sequence

from capabilities.specs.interface import CapabilityInterface
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.lint.finding import ERROR, WARNING, Finding
from rocon_uri.misplaced_name import misplaced_name
from rocon_uri.sources.checked import CheckedMapping, Reading
from rocon_uri.sources.launch_file import MISSING, LaunchFault, LaunchFiles
from rocon_uri.sources.located import NOWHERE, LocatedError, Place
from rocon_uri.sources.resources import not_a_path
from rocon_uri.sources.ros_names import is_legal_base_name, is_legal_name
from rocon_uri.sources.wording import (
    NamesByPart, NearMisses, cannot_be_read, did_you_mean, quoted)
from rocon_uri.sources.yaml_data import split_lines
from rocon_uri.sources.yaml_source import read_file
from rocon_uri.uri import parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['CheckedFile', 'is_inside']

_SUGGESTING = 20    # findings: with more, no near misses are looked for, which takes long


def is_inside(path: str, folder: str) -> bool:
    """
    Does a path, as it is written, lead to a folder or to something in it?

    Symbolic links are not followed: the devel space of a package may consist of them.

    :param str path: absolute or relative, like that of the folder
    :param str folder: the folder
    :returns: bool

    >>> is_inside('ours/launch/../dance.launch', 'ours'), is_inside('ours/../theirs', 'ours')
    (True, False)
    """
    return os.path.join(os.path.normpath(path), '').startswith(
        os.path.join(os.path.normpath(folder), ''))


class CheckedFile(Reading):
    """
    A file of a package, which is read to the end whatever is wrong with it.

    :param str path: the file
    :param str package_folder: the folder of its package

    ``findings`` is a list of `Finding`: those in this file and in the launch files that it names.
    """

    def __init__(self, path: str, package_folder: str) -> None:
        super().__init__(path, LocatedError)
        self.path = path
        self.package_folder = package_folder
        self.findings: List[Finding] = []
        self._lines: Optional[List[str]] = None
        self._near_misses = NearMisses()

    def add(self, severity: str, problem: str, place: Place, fault_id: str) -> None:
        """Note a finding with a severity, `ERROR` or `WARNING`."""
        self.findings.append(Finding(file_name=self.path, line=place[0], column=place[1],
                                     severity=severity, problem=problem, id=fault_id))

    def error(self, problem: str, place: Place, fault_id: str) -> None:
        """Note what will not work, or not as the file says."""
        self.add(ERROR, problem, place, fault_id)

    def warn(self, problem: str, place: Place, fault_id: str) -> None:
        """Note what works, but is probably not what was meant."""
        self.add(WARNING, problem, place, fault_id)

    def refuse(self, fault: LocatedError) -> None:
        """Note a fault as an error."""
        self.error(fault.problem, fault.place, fault.id)

    def expectation(self, found: object, known: Sequence[str]) -> str:
        """The end of an error: what was expected. It is empty after many findings."""
        return super().expectation(found, known) if self._has_few_findings() else ''

    def read(self) -> object:
        """The file's content, read as YAML; None where that fails, which is noted."""
        try:
            content = read_file(self.path)
        except OSError as error:
            self.error(cannot_be_read(error), NOWHERE, 'cannot-read')
            return None
        return self.data(content)

    def check_ros_name(self, name: str, what: str, place: Place) -> None:
        """Check that the ROS graph allows the name of a topic, a service or the like."""
        if not name or not is_legal_name(name):
            self.error('%s %s is not a legal ROS name' % (what, quoted(name)), place,
                       'illegal-name')

    def check_type(self, type_name: str, what: str, place: Place) -> None:
        """Check that the type of a topic, a service or an action is written package/Type."""
        parts = type_name.split('/')
        if len(parts) != 2 or not all(map(is_legal_base_name, parts)):
            is_of_ros_2 = len(parts) == 3 and parts[1] in ('msg', 'srv', 'action')
            self.error('type %s of %s is not of the form package/Type%s' % (
                quoted(type_name), what,
                did_you_mean(['%s/%s' % (parts[0], parts[2])] if is_of_ros_2 else [])), place,
                'illegal-type')

    def check_file(self, name: str, what: str, place: Place, folder: str,
                   if_missing: str = ERROR) -> Optional[str]:
        """
        Check that a file that this one names is in a folder, inside the package.

        :returns: str, its path; None if it is not
        """
        path = os.path.normpath(os.path.join(folder, name))
        if not is_inside(path, self.package_folder):
            self.error('%s %s is outside the package' % (what, quoted(name)), place,
                       'file-outside')
            return None
        if os.path.isfile(path):
            return path
        denied = _denied(path)
        if denied:
            self.add(if_missing, '%s %s %s' % (what, quoted(name), denied), place, 'cannot-read')
            return None
        is_there = os.path.exists(path)
        other = None if is_there else not_a_path(name, folder, self.package_folder)
        problem = 'is not a file' if is_there else 'does not exist'
        if other is not None:
            problem = other.problem + did_you_mean(other.paths)
        self.add(if_missing, '%s %s %s' % (what, quoted(name), problem), place, 'file-missing')
        return None

    def check_launch_file(self, name: str, place: Place, launch_files: LaunchFiles,
                          if_in_package: str = ERROR) -> None:
        """
        Check that roslaunch can start a launch file, by the facts that verdicts on apps stand on.

        :param str name: the launch file, as this file names it
        :param str if_in_package: the severity where it exists relative to the package instead
        """
        fault = launch_files.look_at(name, os.path.dirname(os.path.abspath(self.path))).fault
        if fault is not None and fault.line is not None:
            self.add_in_launch_file(fault)
        elif fault is not None:
            is_in_package = fault.kind == MISSING and os.path.isfile(
                os.path.join(self.package_folder, name))
            self.add(if_in_package if is_in_package else ERROR, str(fault), place, fault.kind)

    def add_in_launch_file(self, fault: LaunchFault) -> None:
        """Note what is wrong in a launch file, at its place there."""
        self.findings.append(Finding(file_name=os.path.normpath(fault.path), line=fault.line,
                                     column=fault.column, severity=ERROR,
                                     problem='launch file %s' % fault.problem, id=fault.kind))

    def check_exists(self, name: str, what: str, known: NamesByPart, place: Place,
                     fault_id: str) -> bool:
        """Check that what this file names, ``package/name``, exists; return whether it does."""
        if name not in known:
            meant = known.near_misses(name) if self._has_few_findings() else []
            self.error('%s %s does not exist%s' % (what, quoted(name), did_you_mean(meant)), place,
                       fault_id)
        return name in known

    def check_remapped_names(self, kind: str, new_names: CheckedMapping,
                             interface: CapabilityInterface) -> None:
        """
        Check that an interface has the names that are remapped, and that the new ones are legal.

        :param str kind: ``'topics'``, ``'services'``, ``'actions'`` or ``'parameters'``
        :param new_names: the new name by each name of the interface
        """
        names = getattr(interface, kind)
        for name in new_names:
            if name not in names:
                # Transports publish below a topic: image, image/compressed.
                is_below = name.rpartition('/')[0] in names
                self.add(WARNING if is_below else ERROR, '%s has no %s in %s to remap%s' % (
                    quoted(interface.name), quoted(name), kind,
                    self.suggestion(name, names)), new_names.key_place(name), 'unknown-name')
            self.check_ros_name(new_names.get(name), 'new name', new_names.value_place(name))

    def check_compatibility(self, text: str, vocabulary: Vocabulary, place: Place) -> None:
        """Check that a compatibility string is a rocon URI; warn of what was probably not meant."""
        try:
            uri = parse(text, vocabulary)
        except RoconURIValueError as error:
            hint = did_you_mean(error.suggestions) if self._has_few_findings() else ''
            self.error('compatibility: %s%s%s' % (
                error.problem, hint, '; ' + error.advice if error.advice else ''),
                self._place_in_text(text, error.span[0], place), 'invalid-uri')
            return
        if uri.read_with_one_slash:
            self.warn('compatibility: %s is read as %s, since %s is a hardware_platform, not a '
                      'concert' % (quoted(text), quoted(uri.short), uri.hardware_platform),
                      self._place_in_text(text, 0, place), 'one-slash')
        misplaced = misplaced_name(uri)
        if misplaced is not None:
            index = text.partition('#')[0].rfind('/' + uri.name.string) + 1
            self.warn('compatibility: ' + misplaced, self._place_in_text(text, index, place),
                      'misplaced-name')

    def suggestion(self, text: str, candidates: Collection[str]) -> str:
        """The end of an error: what was probably meant. It is empty after many, or much work."""
        if not self._has_few_findings():
            return ''
        return did_you_mean(self._near_misses.of(text, candidates))

    def _has_few_findings(self) -> bool:
        return len(self.findings) < _SUGGESTING

    def _place_in_text(self, text: str, index: int, place: Place) -> Place:
        """Where a character of a text is that begins at the place, or after a quote there."""
        line, column = place
        if line is None or column is None:
            return place
        if self._lines is None:
            try:
                self._lines = split_lines(read_file(self.path).decode('utf-8-sig', 'replace'))
            except OSError:
                self._lines = []
        shown = self._lines[line - 1][column - 1:] if line <= len(self._lines) else ''
        start = next((start for start in (0, 1) if shown.startswith(text, start)), None)
        return place if start is None else (line, column + start + index)


def _denied(path: str) -> str:
    """Why it cannot be found out whether something is there; '' where it can."""
    try:
        os.stat(path)
    except PermissionError as error:
        return cannot_be_read(error)
    except (OSError, ValueError):
        pass
    return ''
