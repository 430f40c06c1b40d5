"""
Makes findings.rst of the linter's table of findings.

Example: PYTHONPATH=src python3 doc/make_findings.py
"""
from __future__ import annotations

from itertools import groupby
from pathlib import Path
from textwrap import fill, indent

from rocon_uri.lint.explanations import EXPLANATIONS, Explanation

HEAD = '''\
.. Made by doc/make_findings.py of src/rocon_uri/lint/explanations.yaml: change that.

.. _findings:

What the linter finds
=====================

``rocon_uri specs check`` (`The command line <command_line.rst>`__) ends each finding with an id,
which is stable. ``rocon_uri specs check --explain ID`` prints what this page says of it. A finding
that is right and does no harm can be ignored everywhere, with the option ``--ignore ID``, or on
one line of a YAML file, with a comment on that line:

.. code-block:: yaml

   launch: dance.launch    # rocon_uri: ignore[launch-missing]

In a package.xml or a launch file, the comment may also stand alone on the line above. What follows the
``]`` may say why:

.. code-block:: xml

   <!-- rocon_uri: ignore[file-missing] CMake makes it -->
   <rocon_app>rapps/dance.rapp</rocon_app>

For whole files of a package, a file ``.rocon_uri.yaml`` beside its package.xml says it:

.. code-block:: yaml

   ignore:
     - file-missing                    # in all files
     - 'unknown-key:rapps/*.rapp'      # in those; a * stands for slashes, too

At most 1,000 items of it count, with at most 255 characters in a pattern of paths.
'''


REMARKS = {'Launch files': '''\
A launch file that starts an app manager tells it what the robot is. A manager that was never
configured calls itself ``robot``, which is a group: every app of a robot is compatible with it,
since ``rocon:/turtlebot`` and ``rocon:/robot/x`` have turtlebots in common. That is what the
specification says, and probably not what was meant. The linter cannot see it, since the name may
come from an argument.
'''}


def page() -> str:
    """The text of the page."""
    parts = [HEAD]
    for section, explanations in groupby(EXPLANATIONS.values(), lambda each: each.section):
        parts.append('%s\n%s\n' % (section, '-' * len(section)))
        if section in REMARKS:
            parts.append(fill(' '.join(REMARKS[section].split()), 100) + '\n')
        parts += map(entry, explanations)
    return '\n'.join(parts)


def entry(explanation: Explanation) -> str:
    """One kind of finding."""
    title = explanation.id
    return '\n'.join([
        '.. _finding-%s:\n' % title, title, '~' * len(title), '', paragraph(explanation.what),
        paragraph('*Why:* ' + explanation.why), paragraph('*Mend:* ' + explanation.mend),
        '.. code-block:: %s\n' % language(explanation.example),
        indent(explanation.example, '   ')])


def paragraph(text: str) -> str:
    """A text with what it quotes from files as reST has it."""
    return fill(text.replace('`', '``'), 100, break_on_hyphens=False, break_long_words=False) + '\n'


def language(example: str) -> str:
    """What an example is written in."""
    if example.startswith('<'):
        return 'xml'
    return 'yaml' if ':' in example else 'text'


if __name__ == '__main__':
    Path(__file__).with_name('findings.rst').write_text(page(), encoding='utf-8')
