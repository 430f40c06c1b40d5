"""
A fleet report: robots by apps, and for each pair what fits and what does not, as one page.

A cell is the number of an outcome. Outcomes are few, since what differs from robot to robot is
which fields fit; the reasons against an app on all robots are the same.
"""
from __future__ import annotations

from typing import Dict, Iterable, List, NamedTuple, Optional, Sequence, Tuple

from rocon_uri.cli.fleet_page import page_text
from rocon_uri.cli.given import Report, say
from rocon_uri.compatibility import LEGEND, MARKS, UNDECIDED, explain
from rocon_uri.exceptions import PatternTooComplex
from rocon_uri.sources.wording import quoted_path
from rocon_uri.uri import RoconURI, with_any_name

__all__ = ['Column', 'FIELDS', 'FleetReport', 'write_fleet']

#: the fields that are compared
FIELDS = ('concert_name', 'hardware_platform', 'name', 'application_framework', 'operating_system')


class Column(NamedTuple):
    """What robots are compared with: a request, or an app."""

    #: what it is called
    label: str
    #: what else is said of it
    about: str
    #: what it runs on; None if that is no URI, and the reasons say all
    uri: Optional[RoconURI]


class FleetReport:
    """
    Robots by apps.

    :param columns: sequence of `Column`
    :param str rows_are: what the rows are called, such as 'robots'
    :param str columns_are: what the columns are called, such as 'apps'

    >>> from rocon_uri import parse
    >>> report = FleetReport([Column('dance', '', parse('rocon:/pr2'))], 'robots', 'apps')
    >>> report.add('rocon:/kobuki', parse('rocon:/kobuki'))
    >>> report.as_data()['cells'], report.as_data()['outcomes']
    ([[0]], [{'mark': '.', 'fields': '.xxx', 'reasons': []}])
    """

    def __init__(self, columns: Sequence[Column], rows_are: str, columns_are: str) -> None:
        self._columns = columns
        self._names = rows_are, columns_are
        self._rows: List[str] = []
        self._texts: List[List[str]] = []
        self._cells: List[List[int]] = []
        self._outcomes: Dict[Tuple[str, str, Tuple[str, ...]], int] = {}
        self._fitting: Dict[Tuple[object, ...], str] = {}
        #: bool: does any cell fit?
        self.found = False

    def add(self, text: str, uri: RoconURI,
            reasons: Optional[Sequence[Iterable[str]]] = None) -> None:
        """
        Add a row.

        :param str text: the robot, as it was given
        :param RoconURI uri: the same
        :param reasons: for each column what is against it, beside fields that do not fit; None for
            nothing
        """
        self._rows.append(text)
        self._texts.append(_texts(uri))
        cells: List[int] = []
        for index, column in enumerate(self._columns):
            fields = '' if column.uri is None else self._compared(column.uri, uri)
            against = () if reasons is None else tuple(reasons[index])
            mark = ('.' if '.' in fields or against else '?' if '?' in fields else 'x')
            self.found = self.found or mark == 'x'
            cells.append(self._outcomes.setdefault((mark, fields, against), len(self._outcomes)))
        self._cells.append(cells)

    def _compared(self, asked: RoconURI, uri: RoconURI) -> str:
        """A letter for each field: does it fit?"""
        if asked.name_text != '*' and uri.name_text != '*':
            return _marks(asked, uri)
        key = (asked, uri.concert_name, uri.hardware_platform.string,
               uri.application_framework.string, uri.operating_system.string)
        found = self._fitting.get(key)
        if found is None:
            found = self._fitting[key] = _marks(asked, with_any_name(uri))
        return found

    def as_data(self) -> Dict[str, object]:
        """The report as plain data, for JSON."""
        rows_are, columns_are = self._names
        texts = [[] if column.uri is None else _texts(column.uri) for column in self._columns]
        # the concert, which few name
        first = 0 if any(fields[0] != '*' for fields in texts + self._texts if fields) else 1
        return {
            'rows': [{'text': text, 'fields': fields[first:]}
                     for text, fields in zip(self._rows, self._texts)],
            'cells': self._cells, 'fields': list(FIELDS[first:]),
            'columns': [{'label': column.label, 'about': column.about, 'fields': fields[first:]}
                        for column, fields in zip(self._columns, texts)],
            'outcomes': [{'mark': mark, 'fields': fields[first:], 'reasons': list(reasons)}
                         for mark, fields, reasons in self._outcomes],
            'rows_are': rows_are, 'columns_are': columns_are,
            'rows_have': rows_are[:-1], 'columns_have': columns_are[:-1],
            'meanings': {'x': 'fits', '.': 'does not fit', '?': 'is too complex to say'},
            'legend': LEGEND + UNDECIDED}

    def page(self, title: str) -> str:
        """The report as a page of HTML, which needs nothing else."""
        return page_text(self.as_data(), title)


def _texts(uri: RoconURI) -> List[str]:
    return [uri.concert_name or '*', uri.hardware_platform.string, uri.name_text,
            uri.application_framework.string, uri.operating_system.string]


def _marks(asked: RoconURI, uri: RoconURI) -> str:
    try:
        compared = {field.field: field.is_compatible for field in explain(asked, uri).fields}
    except PatternTooComplex:       # all else fits
        compared = {'name': None}
    return ''.join(MARKS[compared.get(field, True)] for field in FIELDS)


def write_fleet(fleet: FleetReport, title: str, path: str, report: Report) -> None:
    """
    Write a page.

    :param FleetReport fleet: what is on it
    :param str title: what it is called
    :param str path: its file
    :param Report report: is told if it cannot be written
    """
    try:
        with open(path, 'w', encoding='utf-8', errors='backslashreplace') as file:
            file.write(fleet.page(title))
    except OSError as error:
        message = 'cannot write %s: %s' % (quoted_path(path), error.strerror)
        say('rocon_uri: ' + message)
        report.note(message, path)
