"""
Can this launch file be started, as far as the file itself shows it?

roslaunch starts a file that is XML with exactly one ``<launch>``, at its top. `LaunchFiles` says
what is against one, and reads it again only when it has changed:

>>> files = LaunchFiles()
>>> files.look_at('espeak.launch', 'examples/workspace/cafe_capabilities/launch').fault is None
True
>>> print(files.look_at('espaek.launch', 'examples/workspace/cafe_capabilities/launch').fault)
launch file 'espaek.launch' does not exist (did you mean 'espeak.launch'?)

A launch file has to be inside its package: below the nearest folder, from the one that its name is
relative to upwards, that has a ``package.xml``. Symbolic links are followed. What it includes is
not looked at.
"""
from __future__ import annotations

import codecs
import os
import stat
import threading
from dataclasses import dataclass, field, replace
from typing import Callable, Dict, List, NamedTuple, NoReturn, Optional, Tuple
from xml.parsers import expat

from rocon_uri.sources.resources import not_a_path
from rocon_uri.sources.wording import cannot_be_read, did_you_mean, near_misses, quoted
from rocon_uri.sources.yaml_data import MAX_SIZE
from rocon_uri.sources.yaml_source import read_file

__all__ = ['MISSING', 'NOT_XML', 'NO_LAUNCH', 'OUTSIDE', 'UNREADABLE', 'LaunchFault', 'LaunchFile',
           'LaunchFiles', 'RememberedLaunchFiles']

#: the kinds of faults: nothing is there
MISSING = 'launch-missing'
#: it is outside the package of the file that names it
OUTSIDE = 'launch-outside'
#: it is not a file, cannot be opened, or is larger than 1 MiB
UNREADABLE = 'launch-unreadable'
#: it is not XML, or XML whose entities expand to more than 1 MiB
NOT_XML = 'launch-not-xml'
#: it has another element at its top, or a second ``<launch>``
NO_LAUNCH = 'launch-no-launch'

_MAX_FILES = 65536      # that are remembered; one takes about 1 KiB
_MAX_NAMES = 200        # of launch files in a folder; among more no near miss is looked for
_NODELET_MANAGER = [argument.encode(encoding) for encoding in ('ascii', 'utf-16-le', 'utf-16-be')
                    for argument in ['capability_server_nodelet_manager_name']]


@dataclass(frozen=True)
class LaunchFault:
    """
    What is against a launch file. Its text is one line.

    >>> print(LaunchFault(OUTSIDE, 'is outside the package', '../../a.launch', '/ws/a.launch'))
    launch file '../../a.launch' is outside the package
    """

    #: `MISSING`, `OUTSIDE`, `UNREADABLE`, `NOT_XML` or `NO_LAUNCH`
    kind: str
    #: what is wrong, without the name of the file
    problem: str
    #: the file as it is named
    name: str
    #: where it is looked for
    path: str
    #: the line, counted from 1; None if the fault has no single place
    line: Optional[int] = None
    #: counted from 1, or None
    column: Optional[int] = None
    #: what could have been named instead
    alternatives: Tuple[str, ...] = field(default=(), repr=False)

    @property
    def suggestions(self) -> List[str]:
        """The names of files that were probably meant: a list of at most three str."""
        own_name = os.path.basename(self.name)
        elsewhere = [path for path in self.alternatives if os.path.basename(path) == own_name]
        if elsewhere:
            return elsewhere
        # What nearly all names end in would make all of them alike.
        stems = {_stem(path): path for path in self.alternatives}
        return [stems[stem] for stem in near_misses(_stem(self.name), stems)]

    def __str__(self) -> str:
        place = '' if self.line is None else ' (line %s, column %s)' % (self.line, self.column)
        return 'launch file %s %s%s%s' % (
            quoted(self.name), self.problem, place, did_you_mean(self.suggestions))


def _stem(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0]


class LaunchFile(NamedTuple):
    """
    A launch file, and what is against it.

    >>> LaunchFile('launch/dance.launch', None, None, False).fault is None
    True
    """

    #: where it is looked for
    path: str
    #: where it is, with all symbolic links followed; None where nothing is there
    real_path: Optional[str]
    #: what is against it, or None
    fault: Optional[LaunchFault]
    #: does its text contain ``capability_server_nodelet_manager_name``?
    names_nodelet_manager: bool


class LaunchFiles:
    """
    Launch files, of which each is read again only when it has changed. Threads may share it.

    What is remembered is bounded: the 65,536 files that were read last.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()       # not held while a file is read
        self._files: Dict[Tuple[str, str], Tuple[_Identity, LaunchFile]] = {}

    def look_at(self, name: str, folder: str) -> LaunchFile:
        """
        What is known about a launch file. It costs one ``stat`` where the file has not changed.

        :param str name: its path, absolute or relative to the folder
        :param str folder: where the file is that names it: the spec, or the app
        :returns: `LaunchFile`; it raises nothing
        """
        identity = _identity(os.path.join(folder, name))
        with self._lock:
            kept = self._files.get((name, folder))
        if kept is not None and identity is not None and kept[0] == identity:
            return kept[1]
        file = _read(name, folder)
        with self._lock:
            self._files.pop((name, folder), None)
            if len(self._files) >= _MAX_FILES:
                del self._files[next(iter(self._files))]
            self._files[name, folder] = identity, file
        return file

    def remembered(self) -> RememberedLaunchFiles:
        """What is known without a look at the disk, for callers that hold a lock."""
        return RememberedLaunchFiles(self._remembered)

    def _remembered(self, name: str, folder: str) -> Optional[LaunchFile]:
        with self._lock:
            kept = self._files.get((name, folder))
        return None if kept is None else kept[1]


class RememberedLaunchFiles:
    """Launch files as they were when they were looked at last. The disk is not touched."""

    def __init__(self, look_at: Callable[[str, str], Optional[LaunchFile]]) -> None:
        #: as `LaunchFiles.look_at`, but None for what was never looked at
        self.look_at = look_at


_Identity = Optional[Tuple[int, ...]]


def _identity(path: str) -> _Identity:
    """The state of a file, which is another one after each change; None if it has none."""
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    return (status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns)


class _Refused(Exception):
    """What is against a file: kind, problem and place of the fault."""

    def __init__(self, kind: str, problem: str, line: Optional[int] = None,
                 column: Optional[int] = None) -> None:
        super().__init__(problem)
        self.kind = kind
        self.problem = problem
        self.place = line, column


def _read(name: str, folder: str) -> LaunchFile:
    path = os.path.join(folder, name)
    real_path: Optional[str] = None
    fault: Optional[LaunchFault] = None
    names_nodelet_manager = False
    try:
        package = _package_folder(folder)
        real_path = os.path.realpath(path)
        if package is not None and not _is_inside(real_path, package):
            raise _Refused(OUTSIDE, 'is outside the package')
        content = _content(path)
        names_nodelet_manager = any(argument in content for argument in _NODELET_MANAGER)
        _check_xml(content)
    except _Refused as refused:
        line, column = refused.place
        fault = LaunchFault(kind=refused.kind, problem=refused.problem, name=name, path=path,
                            line=line, column=column)
        if refused.kind == MISSING:
            real_path = None
            problem, alternatives = not_a_path(name, folder, package) or (
                refused.problem, _alternatives(name, folder, package))
            fault = replace(fault, problem=problem, alternatives=alternatives)
    except OSError as error:
        fault = LaunchFault(kind=UNREADABLE, problem=cannot_be_read(error), name=name, path=path)
    except ValueError:      # there is a NUL in it, or a lone surrogate
        real_path = None
        fault = LaunchFault(kind=UNREADABLE, problem='is not the name of a file', name=name,
                            path=path)
    return LaunchFile(path=path, real_path=real_path, fault=fault,
                      names_nodelet_manager=names_nodelet_manager)


def _content(path: str) -> bytes:
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise _Refused(UNREADABLE, 'is not a file')
    except (FileNotFoundError, NotADirectoryError):
        raise _Refused(MISSING, 'does not exist') from None
    content = read_file(path)
    if len(content) > MAX_SIZE:
        raise _Refused(UNREADABLE, 'is larger than 1 MiB, which is all that is read')
    return content


def _package_folder(folder: str) -> Optional[str]:
    """The nearest folder upwards with a package.xml; None if there is none."""
    folder = os.path.abspath(folder)
    while not os.path.isfile(os.path.join(folder, 'package.xml')):
        folder, below = os.path.dirname(folder), folder
        if folder == below:
            return None
    return folder


def _is_inside(real_path: str, package: str) -> bool:
    """
    Is it in the folder of the package?

    In an install space that consists of links, it is where the link of the package.xml leads to.
    """
    manifest = os.path.realpath(os.path.join(package, 'package.xml'))
    return any(os.path.commonpath([root, real_path]) == root
               for root in (os.path.realpath(package), os.path.dirname(manifest)))


def _alternatives(name: str, folder: str, package: Optional[str]) -> Tuple[str, ...]:
    """What could have been named in place of a file that is not there."""
    beside, own_name = os.path.split(name)
    try:
        names = sorted(os.listdir(os.path.join(folder, beside)))
    except OSError:
        names = []
    found = [os.path.join(beside, other) for other in names     # not a link that leads nowhere
             if other.endswith(('.launch', '.xml')) and other != own_name]
    if len(found) > _MAX_NAMES:
        found = []
    if package is not None and os.path.isfile(os.path.join(package, name)):
        found.append(os.path.relpath(os.path.join(package, name), folder))
    return tuple(found)


def _check_xml(content: bytes) -> None:
    """Refuse what is not XML with one <launch> at its top, as roslaunch does."""
    parser = expat.ParserCreate()
    references = content.count(b'&')
    path: List[str] = []
    declared: List[str] = []

    def refuse(kind: str, problem: str, line: Optional[int] = None, offset: int = 0) -> NoReturn:
        if line is None:
            line, offset = parser.CurrentLineNumber, parser.CurrentColumnNumber
        has_mark = line == 1 and content.startswith(codecs.BOM_UTF8)    # which is no column
        raise _Refused(kind, problem, line, offset + 1 - has_mark)

    def start(tag: str, _: Dict[str, str]) -> None:
        if not path and tag != 'launch':
            refuse(NO_LAUNCH, 'has %s at its top, expected <launch>' % quoted('<%s>' % tag))
        if path and tag == 'launch':
            refuse(NO_LAUNCH, 'has a second <launch>')
        path.append(tag)

    def entity(name: str, _: int, value: Optional[str], *rest: Optional[str]) -> None:
        # Not every expat bounds what entities expand to. Those of one file are few and short.
        if value and ('&' in value or '%' in value or len(value) * references > MAX_SIZE):
            refuse(NOT_XML, 'is not XML that is read: entity %s can grow too large' % quoted(name))

    def declaration(_: str, encoding: Optional[str], __: int) -> None:
        declared.append(encoding or '')

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: path.pop()
    parser.EntityDeclHandler = entity
    parser.XmlDeclHandler = declaration
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        refuse(NOT_XML, 'is not XML: %s' % expat.ErrorString(error.code), error.lineno,
               error.offset)
    except (LookupError, ValueError):   # of Python, which expat asks about other encodings
        refuse(NOT_XML, 'is not XML: encoding %s cannot be read' % quoted(''.join(declared)))
