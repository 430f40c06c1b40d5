"""
Write the page of the JSON that verbs print, doc/json.rst, from what the verbs themselves say.

``PYTHONPATH=src python3 doc/make_json.py``; a test compares the page with them.
"""
from pathlib import Path

from rocon_uri.cli import VERBS
from rocon_uri.cli.json_forms import json_forms

PAGE = Path(__file__).resolve().parent / 'json.rst'


def json_page() -> str:
    """The text of the page."""
    lines = ['.. Written by make_json.py.', '', 'JSON for programs', '=================', '',
             'With ``--json``, before or after the verb, a verb prints one JSON object. This is '
             'what ``rocon_uri', 'help json`` says of it.', '', '.. code-block:: text', '']
    lines += [('   ' + line).rstrip() for line in json_forms(VERBS).splitlines()]
    return '\n'.join(lines) + '\n'


if __name__ == '__main__':
    PAGE.write_text(json_page(), encoding='utf-8')
