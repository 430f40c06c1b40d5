"""Output of answers: in colour on a terminal, as JSON for programs."""
from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Callable, Dict, List
    from rocon_uri.compatibility import Explanation

__all__ = ['columns', 'fields_as_json', 'painter', 'print_json']

_CODES = {'bold': '1', 'faint': '2', 'red': '31', 'green': '32', 'yellow': '33',
          'cyan': '36'}


def painter() -> Callable[[str, str], str]:
    """
    A function that colours text if standard output is a terminal, and else leaves it alone.

    :returns: callable that takes the text and ``'bold'``, ``'faint'``, ``'red'``, ``'green'``,
        ``'yellow'`` or ``'cyan'``, and returns the text to print; https://no-color.org is respected
    """
    if (sys.stdout.isatty() and not os.environ.get('NO_COLOR')
            and os.environ.get('TERM') != 'dumb'):
        return lambda text, style: '\x1b[%sm%s\x1b[0m' % (_CODES[style], text)
    return lambda text, style: text


def columns() -> int:
    """How wide the terminal is, as COLUMNS says or it does itself; 80 where nobody knows."""
    try:
        found = int(os.environ.get('COLUMNS', ''))
    except ValueError:
        found = 0
    try:
        found = found or os.get_terminal_size(sys.stdout.fileno()).columns
    except (OSError, ValueError):       # not a terminal; ValueError: closed
        pass
    return found if found > 0 else 80


def print_json(answer: object) -> None:
    """Print an object, for people to read as well."""
    import json     # here, since most calls do not need it
    print(json.dumps(answer, indent=2))


def fields_as_json(explanation: Explanation) -> List[Dict[str, object]]:
    """What an explanation says of each field, as ``rocon_uri help json`` describes it."""
    return [{'field': field.field, 'a': field.a, 'b': field.b,
             'compatible': field.is_compatible, 'in_common': field.shared}
            for field in explanation.fields]
