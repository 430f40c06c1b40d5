"""The lines of the files that findings are in, to show them and to read the comments on them."""
from __future__ import annotations

import re
from typing import Dict, List

from rocon_uri.sources.yaml_data import split_lines
from rocon_uri.sources.yaml_source import read_file

__all__ = ['SourceLines', 'is_xml']

_split_xml_lines = re.compile('\r\n|[\r\n]').split


def is_xml(path: str) -> bool:
    """
    Is this a file of XML, by its name?

    >>> is_xml('ours/package.xml'), is_xml('ours/dance.rapp')
    (True, False)
    """
    return path.endswith(('.xml', '.launch'))


class SourceLines:
    """
    Lines of files, each of which is read once.

    >>> SourceLines().line('test/unit/specs/interfaces/RGBCamera.yaml', 1)
    '%YAML 1.1'
    """

    def __init__(self) -> None:
        self._files: Dict[str, List[str]] = {}

    def line(self, path: str, number: int) -> str:
        """
        One line of a file.

        :param str path: the file
        :param int number: counted from 1, as the reader of such files counts
        :returns: str without the end of the line; '' where there is no such line or file
        """
        if path not in self._files:
            try:
                text = read_file(path).decode('utf-8-sig', 'replace')
            except OSError:
                text = ''
            self._files[path] = (_split_xml_lines if is_xml(path) else split_lines)(text)
        lines = self._files[path]
        return lines[number - 1] if 0 < number <= len(lines) else ''
