"""One file that is checked: what is found in it, and the checks that files of all kinds share."""
from __future__ import annotations

import os
import re

from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import near_misses, quoted
from rocon_uri.lint.finding import ERROR, WARNING, Finding
from rocon_uri.sources.ros_names import is_legal_base_name, is_legal_name
from rocon_uri.uri import parse
from rocon_uri.sources.wording import did_you_mean
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load_file, read_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Iterable, List, Mapping, Optional, Tuple
    from capabilities.specs.interface import CapabilityInterface
    from rocon_uri.vocabulary import Vocabulary

    Place = Tuple[Optional[int], Optional[int]]

__all__ = ['CheckedFile', 'NOWHERE', 'is_inside']

NOWHERE: Place = (None, None)

_split_lines = re.compile('\r\n|[\r\n\x85\u2028\u2029]').split      # as YAML counts them


def is_inside(path: str, folder: str) -> bool:
    """
    Is a path one of a folder or of something in it, by its letter?

    Symbolic links are not followed: the devel space of a package may consist of them.

    :param str path: absolute, or relative to where the folder is relative to
    :param str folder: the folder
    :returns: bool

    >>> is_inside('ours/launch/../dance.launch', 'ours'), is_inside('ours/../theirs', 'ours')
    (True, False)
    """
    return os.path.join(os.path.normpath(path), '').startswith(
        os.path.join(os.path.normpath(folder), ''))


class CheckedFile:
    """
    A file of a package, and what is found in it.

    :param str path: the file
    :param str package_folder: where the package is that it belongs to

    ``findings`` is a list of `Finding`. A place is (line, column), each from 1 or None.
    """

    def __init__(self, path: str, package_folder: str) -> None:
        self.path = path
        self.package_folder = package_folder
        self.findings: List[Finding] = []
        self._lines: Optional[List[str]] = None

    def add(self, severity: str, text: str, place: Place = NOWHERE) -> None:
        """Note something, `ERROR` or `WARNING`."""
        self.findings.append(Finding(self.path, place[0], place[1], severity, text))

    def error(self, text: str, place: Place = NOWHERE) -> None:
        """Note something that will not work, or not as it says."""
        self.add(ERROR, text, place)

    def warn(self, text: str, place: Place = NOWHERE) -> None:
        """Note something that works, and is probably not what was meant."""
        self.add(WARNING, text, place)

    def load(self) -> Any:
        """What the file holds, read as YAML; None if it cannot be read, which is noted."""
        try:
            return load_file(self.path)
        except YamlError as error:
            self.error(error.problem, error.place)
        except OSError as error:
            self.error('cannot be read: %s' % (error.strerror or error))
        return None

    def check_ros_name(self, name: str, what: str, place: Place) -> None:
        """A topic, a service and the like must have a name that the ROS graph allows."""
        if not name or not is_legal_name(name):
            self.error('%s %s is not a legal ROS name' % (what, quoted(name)), place)

    def check_type(self, type_name: str, what: str, place: Place) -> None:
        """The type of a topic, a service or an action is written package/Type."""
        parts = type_name.split('/')
        if len(parts) != 2 or not all(map(is_legal_base_name, parts)):
            # as ROS 2 writes it
            meant = ('%s/%s' % (parts[0], parts[2]) if len(parts) == 3
                     and parts[1] in ('msg', 'srv', 'action') else None)
            self.error('type %s of %s is not of the form package/Type%s' % (
                quoted(type_name), what, did_you_mean([meant] if meant else [])), place)

    def check_keys(self, mapping: Any, known: Iterable[str], what: str) -> None:
        """What has no meaning in a mapping that was read from the file is probably misspelt."""
        for key in mapping:
            if key not in known:
                self.warn('unknown key %s in %s%s' % (
                    quoted(str(key)), what, self._suggestion(str(key), known)),
                    mapping.key_position(key))

    def check_file(self, name: str, what: str, place: Place, *folders: str,
                   if_missing: str = ERROR) -> Optional[str]:
        """
        A file that this one names has to be there, in one of the folders, inside the package.

        :returns: str, its path; None if it is not there
        """
        paths = [os.path.normpath(os.path.join(folder, name)) for folder in folders]
        inside = [path for path in paths if is_inside(path, self.package_folder)]
        for path in inside:
            if os.path.isfile(path):
                return path
        if inside:
            is_there = any(map(os.path.exists, inside))
            self.add(if_missing, '%s %s %s' % (
                what, quoted(name), 'is not a file' if is_there else 'does not exist'), place)
        else:
            self.error('%s %s is outside the package' % (what, quoted(name)), place)
        return None

    def check_exists(self, name: str, what: str, known: Mapping[str, Any], place: Place) -> bool:
        """
        What this file names, ``package/name``, has to be known.

        :returns: bool
        """
        if name in known:
            return True
        package, _, own_name = name.partition('/')
        alike = (other for other in known     # of all names, there may be too many
                 if other.startswith(package + '/') or other.endswith('/' + own_name))
        self.error('%s %s does not exist%s' % (
            what, quoted(name), self._suggestion(name, alike)), place)
        return False

    def check_remapped_names(self, kind: str, new_names: Any, interface: CapabilityInterface,
                             ) -> None:
        """
        Only names that the interface has can be called something else, and by a legal name.

        :param str kind: ``'topics'``, ``'services'``, ``'actions'`` or ``'parameters'``
        :param new_names: mapping of names to new ones, as it was read from the file
        :param interface: what the names are of
        """
        names = getattr(interface, kind)
        for name, new_name in new_names.items():
            place = new_names.key_position(name)
            if name not in names:
                # Transports publish below a topic: image, image/compressed.
                is_below = name.rpartition('/')[0] in names
                self.add(WARNING if is_below else ERROR, '%s has no %s in %s to remap%s' % (
                    quoted(interface.name), quoted(name), kind,
                    self._suggestion(name, names)), place)
            self.check_ros_name(new_name, 'new name', new_names.value_position(name))

    def check_compatibility(self, text: str, vocabulary: Vocabulary, place: Place) -> None:
        """A compatibility string has to be a rocon URI, and should be read as it was meant."""
        try:
            uri = parse(text, vocabulary)
        except RoconURIValueError as error:
            hint = did_you_mean(error.suggestions) if self._has_few_findings() else ''
            self.error('compatibility: %s%s%s' % (
                error.problem, hint, '; ' + error.advice if error.advice else ''),
                self._place_in_text(text, error.span[0], place))
            return
        if uri.read_with_one_slash:
            self.warn('compatibility: %s is read as %s, since %s is a hardware_platform and no '
                      'concert' % (quoted(text), quoted(uri.short), uri.hardware_platform),
                      self._place_in_text(text, 0, place))

    def _suggestion(self, text: str, candidates: Iterable[str]) -> str:
        return did_you_mean(near_misses(text, candidates)) if self._has_few_findings() else ''

    def _has_few_findings(self) -> bool:
        """Are there no more than a person reads? Near misses take long to find."""
        return len(self.findings) < 20

    def _place_in_text(self, text: str, index: int, place: Place) -> Place:
        """Where a character of a text stands that begins here, behind a quotation mark or not."""
        line, column = place
        if line is None or column is None:
            return place
        if self._lines is None:
            try:
                self._lines = _split_lines(read_file(self.path).decode('utf-8', 'replace'))
            except OSError:
                self._lines = []
        shown = self._lines[line - 1][column - 1:] if line <= len(self._lines) else ''
        start = next((start for start in (0, 1) if shown.startswith(text, start)), None)
        return place if start is None else (line, column + start + index)
