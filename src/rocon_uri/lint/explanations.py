"""
What each kind of finding means: from ``explanations.yaml``, the one table of all kinds.

>>> EXPLANATIONS['launch-missing'].what
'The launch file that an app or a provider names does not exist.'
"""
from __future__ import annotations

import os
from typing import Dict, NamedTuple

from rocon_uri.sources.yaml_source import load_file

__all__ = ['EXPLANATIONS', 'Explanation']


class Explanation(NamedTuple):
    """One kind of finding."""

    #: its id, which is stable
    id: str
    #: the section of the page on findings that it is in
    section: str
    #: what it is, in one sentence
    what: str
    #: why it matters
    why: str
    #: how to mend it
    mend: str
    #: lines that are right
    example: str

    def __str__(self) -> str:
        example = ''.join('\n    ' + line for line in self.example.splitlines())
        return '%s\n  %s\n\nWhy: %s\n\nMend: %s\n%s' % (
            self.id, self.what, self.why, self.mend, example)


def _read() -> Dict[str, Explanation]:
    sections = load_file(os.path.join(os.path.dirname(__file__), 'explanations.yaml'))
    return {fault_id: Explanation(id=fault_id, section=section, **texts)
            for section, explanations in sections.items()
            for fault_id, texts in explanations.items()}


#: all kinds of findings by id, in the order of the page
EXPLANATIONS: Dict[str, Explanation] = _read()
