"""The forms of a matrix of requests and resources: for people, for a spreadsheet, for a browser."""
from __future__ import annotations

import sys

from rocon_uri.cli.display import columns, painter
from rocon_uri.cli.given import shown_name
from rocon_uri.compatibility import LEGEND, MARKS, UNDECIDED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterator, List, Optional, Protocol, Tuple
    from rocon_uri.cli.given import GivenURI, Line, Report

    class Matches(Protocol):
        """Each resource, with what is said of it to each request."""

        #: the requests
        requests: List[GivenURI]
        #: where the resources are
        path: str

        def __iter__(self) -> Iterator[Tuple[Line, List[Optional[bool]]]]: ...

__all__ = ['print_matrix', 'print_table', 'write_page']


def print_matrix(matches: Matches) -> None:
    """Print a letter for each request before each resource, below what the columns are."""
    paint = painter()
    print(paint(LEGEND + UNDECIDED, 'faint'))
    number = len(matches.requests)
    is_wide = sys.stdout.isatty() and 2 * number > columns() // 2
    if is_wide:     # the columns have numbers, and no blanks between them
        digits = len(str(number))
        for index, request in enumerate(matches.requests, 1):
            print('%*d  %s' % (digits, index, paint(request.label, 'bold')))
        for digit in range(digits):
            print(''.join(('%*d' % (digits, index))[digit] for index in range(1, number + 1)))
    else:
        for index, request in enumerate(matches.requests):
            print('| ' * index + paint(request.label, 'bold'))
    marks = {fits: paint(mark, style)
             for (fits, mark), style in zip(MARKS.items(), ('green', 'faint', 'red'))}
    between = '' if is_wide else ' '
    for (_, text, _), verdicts in matches:
        print('%s  %s' % (between.join(marks[verdict] for verdict in verdicts), text))


def print_table(matches: Matches, form: str) -> None:
    """Print it as a table, ``'csv'`` or ``'tsv'``."""
    import csv      # here, since most calls do not need it
    writer = csv.writer(sys.stdout, 'excel' if form == 'csv' else 'excel-tab', lineterminator='\n')
    writer.writerow(['resource', *(request.label for request in matches.requests)])
    for (_, text, _), verdicts in matches:
        writer.writerow([text, *(MARKS[verdict] for verdict in verdicts)])


def write_page(matches: Matches, path: str, report: Report) -> None:
    """Write it as a page; a report is told if that fails."""
    from rocon_uri.cli.fleet_report import Column, FleetReport, write_fleet    # see above
    columns = [Column(label=given.label, about=given.text, uri=given.uri)
               for given in matches.requests]
    page = FleetReport(columns, 'resources', 'requests')
    for (uri, text, _), _ in matches:
        page.add(text, uri)
    write_fleet(page, 'What fits in ' + shown_name(matches.path), path, report)
