"""What can be wrong with the exports in a ``package.xml``."""
from __future__ import annotations

import os
from collections import namedtuple
from xml.parsers.expat import ExpatError

from capabilities.discovery import EXPORTS
from rocon_uri.sources.wording import quoted
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.sources.yaml_source import read_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, List
    from rocon_uri.lint.finding import Finding

__all__ = ['check_exports']

_FILE_EXPORTS = EXPORTS + ('rocon_app',)    # those whose text is the path of a file

#: The file that one element of the export section names, and where: a line and a column from 1.
Export = namedtuple('Export', 'path line column')


def check_exports(path: str) -> List[Finding]:
    """
    Each export of a spec, a rapp or rules has to name a file inside the package, and none twice.

    :param str path: a package.xml that is valid
    :returns: list of `Finding`
    """
    file = CheckedFile(path, os.path.dirname(path))
    seen = set()
    try:
        exports = _exports(read_file(path))
    except (OSError, ValueError, ExpatError) as error:      # it has changed since it was found
        file.error('cannot be read: %s' % (getattr(error, 'strerror', None) or error))
        return file.findings
    for name, line, column in exports:
        exported = file.check_file(name.strip(), 'exported file', (line, column),
                                   file.package_folder)
        if exported in seen:
            file.error('%s is exported twice' % quoted(name.strip()), (line, column))
        elif exported is not None:
            seen.add(exported)
    return file.findings


def _exports(content: bytes) -> List[Export]:
    """The exports of files that this package understands."""
    from xml.parsers import expat
    parser = expat.ParserCreate()
    parser.buffer_text = True
    path: List[str] = []
    found: List[Export] = []

    def start(tag: str, attributes: Dict[str, str]) -> None:
        path.append(tag)
        if path[:-1] == ['package', 'export']:
            place = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
            if tag in _FILE_EXPORTS:
                found.append(Export('', *place))
            elif tag == 'rocon_uri' and attributes.get('rules'):
                found.append(Export(attributes['rules'].replace('${prefix}', '.'), *place))
        elif len(path) > 3 and path[:2] == ['package', 'export'] and path[2] in _FILE_EXPORTS:
            found[-1] = found[-1]._replace(path=found[-1].path + '<%s>' % tag)      # no such file

    def text(data: str) -> None:
        if path[:-1] == ['package', 'export'] and path[-1] in _FILE_EXPORTS:
            found[-1] = found[-1]._replace(path=found[-1].path + data)

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: path.pop()
    parser.CharacterDataHandler = text
    parser.Parse(content, True)
    return found
