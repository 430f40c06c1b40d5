"""What is said of URIs that are legal, but may hide a typing error."""
from __future__ import annotations

from rocon_uri.cli.given import say
from rocon_uri.misplaced_name import misplaced_name
from rocon_uri.sources.wording import quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Dict
    from rocon_uri.cli.given import GivenURI

__all__ = ['Notes']


class Notes:
    """Notes about URIs. One of a kind is said in full, the others are counted."""

    def __init__(self) -> None:
        self._counts: Dict[str, int] = {}       # of URIs, by kind

    def mention(self, given: GivenURI) -> None:
        """Say what may be wrong with a URI."""
        self.mention_one_slash(given)
        note = misplaced_name(given.uri)
        if note:
            kind, _, _ = note.partition(' (did you mean')
            self._mention(kind, 'in %s, %s' % (quoted(given.text), note))

    def mention_one_slash(self, given: GivenURI) -> None:
        """Say it if ``//`` was read as ``/``."""
        if given.uri.read_with_one_slash:
            kind = '%s is a hardware_platform, not a concert' % given.uri.hardware_platform
            self._mention(kind, '%s is read as %s, since %s' % (
                quoted(given.text), quoted(given.uri.short), kind))

    def say_others(self) -> None:
        """Say how many other URIs have the same notes."""
        for kind, count in self._counts.items():
            if count > 1:
                say('rocon_uri: note: %s, also in %d other URI%s'
                    % (kind, count - 1, 's' if count > 2 else ''))

    def _mention(self, kind: str, note: str) -> None:
        self._counts[kind] = self._counts.get(kind, 0) + 1
        if self._counts[kind] == 1:
            say('rocon_uri: note: ' + note)
