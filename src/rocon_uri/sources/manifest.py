"""
The one reader of a ``package.xml``: the name of a package, and what it exports.

A manifest is UTF-8 of at most 1 MiB, as catkin_pkg reads it whatever its XML declaration says, and
declares no entities.
"""
from __future__ import annotations

import codecs
import os
import re
from typing import TYPE_CHECKING, Dict, List, NamedTuple, Optional, Tuple, Union
from xml.parsers import expat

from rocon_uri.sources.encoding import not_utf8_at, utf16_problem
from rocon_uri.sources.located import LocatedError, with_id
from rocon_uri.sources.wording import cannot_be_read, quoted
from rocon_uri.sources.yaml_data import MAX_SIZE, end_position
from rocon_uri.sources.yaml_source import read_file

if TYPE_CHECKING:
    from catkin_pkg.package import Package as CatkinPackage

__all__ = ['Element', 'Export', 'MANIFEST', 'Package', 'PackageError', 'as_package',
           'manifest_elements', 'package_from_manifest', 'read_manifest']

#: the name of the file that makes a folder a package
MANIFEST = 'package.xml'

_is_name = re.compile('[A-Za-z0-9][A-Za-z0-9_-]*').fullmatch    # as catkin_pkg has it


class PackageError(LocatedError):
    """
    A package that is left out: its manifest, ``file_name``, is faulty, or its name is taken.

    ``file_name`` is the folder where that cannot be read. The attributes are those of
    `rocon_uri.sources.located.LocatedError`.

    >>> print(PackageError('no element found', 'a_package/package.xml', 3, 1))
    a_package/package.xml:3:1: no element found
    """

    id = 'invalid-manifest'

    @property
    def msg(self) -> str:
        """The earlier name of ``problem``."""
        return self.problem


class Element(NamedTuple):
    """The root of a manifest, or an element directly in it."""

    #: its name
    tag: str
    #: its attributes
    attributes: Dict[str, str]
    #: the text in it, without white space around it; ``<export>`` has its own only in part
    text: str
    #: where it begins, counted from 1
    place: Tuple[int, int]


class Export(NamedTuple):
    """One element directly in the ``<export>`` of a manifest."""

    #: the element's name
    tag: str
    #: its attributes
    attributes: Dict[str, str]
    #: The text in it, without white space around it: escapes and CDATA are resolved, comments left
    #: out. An element in it is written ``<tag>``, so that no path leads to a file by accident.
    text: str
    #: where it begins, counted from 1, or None where that is not known
    line: Optional[int]
    #: counted from 1, or None
    column: Optional[int]

    def file(self, attribute: str = '') -> str:
        """
        The file or folder that an attribute, or else the text, names; '' if it names none.

        It is relative to the package, whose folder is ``${prefix}``.

        >>> Export('rocon_uri', {'rules': '${prefix}/robots.yaml'}, '', 9, 5).file('rules')
        './robots.yaml'
        """
        name = self.attributes.get(attribute, '') if attribute else self.text
        return name.replace('${prefix}', '.')


class Package(NamedTuple):
    """What is known of a package from its manifest."""

    #: its name, as the manifest says it
    name: str
    #: the absolute path of its folder
    folder: str
    #: the absolute path of its package.xml
    manifest: str
    #: what it exports, in the order of the manifest
    exports: List[Export]

    def files(self, tag: str, attribute: str = '') -> List[str]:
        """
        The paths that elements of this tag name, by an attribute (if they have it) or their text.

        They are absolute and normalised, in the order of the exports. They need not exist.

        >>> laser = Export('rocon_app', {}, 'rapps/scan.rapp', 9, 5)
        >>> Package('ours', '/src/ours', '/src/ours/package.xml', [laser]).files('rocon_app')
        ['/src/ours/rapps/scan.rapp']
        """
        names = [export.file(attribute) for export in self.exports if export.tag == tag]
        # An empty text leaves a slash at the end, which says that the folder itself is meant.
        return [os.path.normpath(os.path.join(self.folder, name)) if name
                else os.path.join(self.folder, '') for name in names if name or not attribute]


def read_manifest(path: str) -> str:
    """
    The text of a package.xml.

    :raises PackageError: if it cannot be read, is too large, not UTF-8 or declares entities
    """
    try:
        content = read_file(path)
    except OSError as error:
        raise with_id(PackageError(cannot_be_read(error), path), 'cannot-read') from error
    problem = utf16_problem(content)
    if problem:
        raise PackageError(problem, path, 1, 1)
    try:
        text = content.decode('utf-8')
    except UnicodeDecodeError as error:
        raise PackageError(not_utf8_at(content, error.start), path,
                           *end_position(content[:error.start].decode('utf-8'))) from error
    if len(content) > MAX_SIZE:
        raise PackageError('larger than 1 MiB, which is all that is read', path)
    if '<!ENTITY' in text:  # not every expat bounds how large they become
        raise PackageError('it declares entities, and those are not read', path)
    return text[1:] if text.startswith('\ufeff') else text     # a byte order mark is no column


def package_from_manifest(path: str) -> Package:
    """
    The package of one package.xml.

    :raises PackageError: if it cannot be read, is not XML, or has no name
    """
    path = os.path.abspath(path)
    reader = _ManifestReader(path)
    reader.read(read_manifest(path))
    names = reader.elements
    if len(names) != 1:
        raise PackageError('The manifest must contain exactly one "name" tag', path,
                           *(names[1].place if names else (1, 1)))
    name = names[0].text
    if not _is_name(name):
        raise PackageError('Package name %s does not follow naming conventions (letters, digits, _ '
                           'and -)' % quoted(name), path, *names[0].place)
    return Package(name=name, folder=os.path.dirname(path), manifest=path,
                   exports=reader.exports)


def manifest_elements(path: str) -> List[Element]:
    """
    The root of a package.xml and the elements directly in it, in their order.

    :raises PackageError: as `package_from_manifest`, but not for the name
    """
    reader = _ManifestReader(path, all_elements=True)
    reader.read(read_manifest(path))
    return reader.elements


class _ManifestReader:
    """
    Collects the names and the exports of a manifest while expat reads it.

    With ``all_elements`` it collects these too, which takes twice as long.
    """

    def __init__(self, path: str, all_elements: bool = False) -> None:
        self.path = path
        self._all = all_elements
        self.elements: List[Element] = []
        self.exports: List[Export] = []
        self._depth = 0
        self._section = ''              # the element below <package> that is read
        self._text: List[str] = []      # of the element or the export that is read
        self._parser = expat.ParserCreate('utf-8')
        self._parser.buffer_text = True
        self._parser.XmlDeclHandler = self._declaration
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._text.append

    def read(self, text: str) -> None:
        """Read a whole manifest; PackageError if it is not XML."""
        try:
            self._parser.Parse(text, True)
        except expat.ExpatError as error:
            raise PackageError('not XML: ' + expat.ErrorString(error.code), self.path,
                               error.lineno, error.offset + 1) from error

    def _declaration(self, version: str, encoding: Optional[str], standalone: int) -> None:
        try:
            codecs.lookup(encoding or 'utf-8')
        except (LookupError, ValueError):
            raise PackageError('the encoding %s of its XML declaration is unknown'
                               % quoted(str(encoding)), self.path, 1, 1) from None

    def _start(self, tag: str, attributes: Dict[str, str]) -> None:
        if self._depth == 0 and tag != 'package':
            raise PackageError('The manifest must contain a single "package" root tag', self.path,
                               *self._place())
        if self._depth == 0 and attributes.get('format', '1').strip() not in ('1', '2', '3'):
            raise PackageError('format version %s is unknown, expected 1, 2 or 3'
                               % quoted(attributes['format']), self.path, *self._place())
        self._depth += 1
        if self._depth <= 2:
            if self._all or tag == 'name':
                self.elements.append(Element(tag=tag, attributes=attributes, text='',
                                             place=self._place()))
            self._section = tag
            self._text.clear()
        elif self._section == 'export' and self._depth == 3:
            line, column = self._place()
            self.exports.append(Export(tag=tag, attributes=attributes, text='', line=line,
                                       column=column))
            self._text.clear()
        elif self._section == 'export':
            self._text.append('<%s>' % tag)

    def _end(self, tag: str) -> None:
        if self._depth == 2 and (self._all or tag == 'name'):
            self.elements[-1] = self.elements[-1]._replace(
                text=''.join(self._text).strip(' \n\r\t'))
        elif self._depth == 3 and self._section == 'export':
            self.exports[-1] = self.exports[-1]._replace(text=''.join(self._text).strip())
            self._text.clear()
        self._depth -= 1

    def _place(self) -> Tuple[int, int]:
        return self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber + 1


def as_package(package: Union[Package, CatkinPackage]) -> Package:
    """
    A package of catkin_pkg as this module describes it; one of this module is returned as it is.

    catkin_pkg leaves the text of an export as XML, which is read here, and gives it no place.
    """
    if isinstance(package, Package):
        return package
    manifest = os.path.abspath(package.filename)
    exports = [Export(tag=export.tagname, attributes=export.attributes,
                      text=_text_of(export.content or ''), line=None, column=None)
               for export in package.exports]
    return Package(name=package.name, folder=os.path.dirname(manifest), manifest=manifest,
                   exports=exports)


def _text_of(content: str) -> str:
    """The text of an element, given as the XML in it."""
    reader = _ManifestReader('')
    try:
        reader.read('<package><export><_>%s</_></export></package>' % content)
        return reader.exports[0].text
    except PackageError:    # made by code that escaped nothing
        return content.strip()
