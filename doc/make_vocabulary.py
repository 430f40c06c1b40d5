"""
Write the page of the values that come with the package, doc/registered_values.rst.

``PYTHONPATH=src python3 doc/make_vocabulary.py``; a test compares the page with the vocabulary.
"""
from pathlib import Path
from textwrap import wrap

from rocon_uri import Vocabulary
from rocon_uri.grammar import VOCABULARY_FIELDS

PAGE = Path(__file__).resolve().parent / 'registered_values.rst'
HEAD = '''\
.. Written by make_vocabulary.py.

Registered values
=================

These values come with the package, each in its group. A group is a value too, and matches all of
its members. ``rosrun rocon_uri rocon_uri fields`` shows them as a tree, with those that packages
on your machine add: `The vocabulary <vocabulary.rst>`__ says how.
'''


def table(field):
    """The lines of the table of a field: its groups from the top, and their members."""
    yield '.. list-table::'
    yield '   :header-rows: 1'
    yield '   :widths: 20 80'
    yield ''
    yield '   * - group'
    yield '     - members'
    waiting = [None]
    while waiting:
        group = waiting.pop(0)
        members = field.children(group)
        yield '   * - %s' % ('in no group' if group is None else '``%s``' % group)
        text = ', '.join('``%s``' % member for member in members)
        for number, line in enumerate(wrap(text, 90)):
            yield ('       ' if number else '     - ') + line
        waiting[:0] = [member for member in members if field.children(member)]


def vocabulary_page():
    """The text of the page."""
    lines = [HEAD]
    for name in VOCABULARY_FIELDS:
        field = Vocabulary.bundled().field(name)
        count = sum(1 for value in field if not field.children(value))
        lines += [name, '-' * len(name), '', '%d values, and groups of them.' % count, '',
                  *table(field), '']
    return '\n'.join(lines)


if __name__ == '__main__':
    PAGE.write_text(vocabulary_page(), encoding='utf-8')
