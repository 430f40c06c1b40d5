"""The URIs that a verb is given, as arguments and in files, and a report of the bad ones."""
from __future__ import annotations

import itertools
import sys

from rocon_uri.cli.lines import read_lines
from rocon_uri.cli.progress import beside_progress
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.misplaced_name import misplaced_name
from rocon_uri.sources.wording import quoted, quoted_path
from rocon_uri.uri import parse

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict, Iterator, List, Optional, Sequence, Tuple
    from rocon_uri.uri import RoconURI

__all__ = ['GivenURI', 'Report', 'say']


def say(text: str) -> None:
    """Tell the user something on stderr, below what was printed so far."""
    with beside_progress():
        sys.stdout.flush()
        print(text, file=sys.stderr)


class GivenURI:
    """A URI and the text that it was read from; file and line (from 1) are None for an argument."""

    __slots__ = ('uri', 'text', 'file', 'line')

    def __init__(self, uri: RoconURI, text: str, file: Optional[str] = None,
                 line: Optional[int] = None) -> None:
        self.uri = uri
        self.text = text
        self.file = file
        self.line = line

    @property
    def label(self) -> str:
        """What to call it among others: the app that asks, or else the text."""
        return self.uri.rocon_app or self.text

    def mention_one_slash(self) -> None:
        """Say it if ``//`` was read as ``/``, since that can hide a typing error."""
        if self.uri.read_with_one_slash:
            say('rocon_uri: note: %s is read as %s, since %s is a hardware_platform, not a concert'
                % (quoted(self.text), quoted(self.uri.short), self.uri.hardware_platform))

    def mention_misplaced_name(self) -> None:
        """Say it if the name is probably meant as a value of another field."""
        note = misplaced_name(self.uri)
        if note:
            say('rocon_uri: note: in %s, %s' % (quoted(self.text), note))

    def as_json(self) -> Dict[str, object]:
        """URI, as ``rocon_uri --help`` describes it."""
        uri = self.uri
        return {
            'text': self.text, 'file': self.file, 'line': self.line,
            'uri': str(uri), 'short': uri.short,
            'fields': {
                'concert_name': uri.concert_name,
                'hardware_platform': uri.hardware_platform.list,
                'name': uri.name.string,
                'application_framework': uri.application_framework.list,
                'operating_system': uri.operating_system.list,
                'rocon_app': uri.rocon_app,
            },
            'read_with_one_slash': uri.read_with_one_slash,
        }


class Report:
    """
    What was bad: said on stderr when it is met, and kept where JSON is asked for.

    ``errors`` is a list of ERROR, as ``rocon_uri --help`` describes it. ``status`` is the exit
    status, 0 until something was bad, then 2.
    """

    def __init__(self, json: bool) -> None:
        self.status = 0
        self.errors: List[Dict[str, object]] = []
        self._json = json

    def read(self, text: str, file: Optional[str] = None,
             line: Optional[int] = None) -> Optional[GivenURI]:
        """Read a URI; None for a text that is not legal, which is reported."""
        try:
            return GivenURI(parse(text), text, file, line)
        except RoconURIValueError as error:
            self.bad_uri(error, file, line)
            return None

    def read_file(self, path: str) -> Iterator[List[GivenURI]]:
        """
        Read a file of URIs, one a line; ``-`` is standard input.

        Blank lines and those whose first character is ``#`` are skipped. Those that are not legal
        are reported. Each list that is yielded is what can be had without waiting.
        """
        name = '<stdin>' if path == '-' else path
        numbers = itertools.count(1)
        try:
            for lines in read_lines(path):
                batch = []
                for line, number in zip(lines, numbers):
                    text = line.strip()
                    if text and line[0] != '#':
                        given = self.read(text, name, number)
                        if given:
                            batch.append(given)
                yield batch
        except OSError as error:
            message = 'cannot read %s: %s' % (quoted_path(name), error.strerror or error)
            say('rocon_uri: ' + message)
            self.note(message, name)

    def bad_uri(self, error: RoconURIValueError, file: Optional[str] = None,
                line: Optional[int] = None) -> None:
        """Report a fault in a URI."""
        if file is None:
            say('rocon_uri: ' + error.pretty())
        else:
            say('%s:%s: %s' % (file, line, error))
        self.note(str(error), file, line, error.suggestions, error.uri, error.field, error.value,
                  error.span)

    def note(self, message: str, file: Optional[str], line: Optional[int] = None,
             suggestions: Sequence[str] = (), uri: Optional[str] = None,
             field: Optional[str] = None, value: Optional[str] = None,
             span: Optional[Tuple[int, int]] = None) -> None:
        """Keep an ERROR with these members, without saying it."""
        self.status = 2
        if self._json:
            self.errors.append({
                'message': message, 'uri': uri, 'field': field, 'value': value, 'span': span,
                'suggestions': list(suggestions), 'file': file, 'line': line})
