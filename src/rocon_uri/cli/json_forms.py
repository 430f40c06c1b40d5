"""
The JSON that each verb prints with --json.

A VERB prints one object. It always has "errors", a list of ERROR. Words in capitals
stand for what they name, and are described here or where they are used.

ERROR is what is wrong, in which URI, where in it, and what was probably meant; null
where that does not apply:
  {"message", "uri", "field", "value", "span": [START, END],
   "suggestions": [TEXT, ...], "file", "line"}

URI is the text as it was given, the file and the line it stands on (null for an
argument), the canonical text, the short one, the fields as in the message
rocon_uri/RoconURI, and whether // was read as /:
  {"text", "file", "line", "uri", "short", "fields": {"concert_name",
   "hardware_platform": [TEXT, ...], "name", "application_framework":
   [TEXT, ...], "operating_system": [TEXT, ...], "rocon_app"},
   "read_with_one_slash": BOOL}
"""
from __future__ import annotations

from importlib import import_module

from rocon_uri.cli.parsers import json_form

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Iterable

__all__ = ['json_forms']


def json_forms(verbs: Iterable[str]) -> str:
    """What the JSON of each verb contains."""
    parts = [(__doc__ or '').strip()]
    for verb in verbs:
        module = import_module('rocon_uri.cli.' + verb)
        parts.append('rocon_uri %s\n%s' % (verb, _indented(json_form(module.__doc__))))
        for name in getattr(module, 'VERBS', ()):
            form = json_form(import_module('%s.%s' % (module.__name__, name)).__doc__)
            parts.append('rocon_uri %s %s\n%s' % (verb, name, _indented(form)))
    return '\n\n'.join(parts)


def _indented(text: str) -> str:
    return '\n'.join('  ' + line for line in text.splitlines())
