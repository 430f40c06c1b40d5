"""Regular expressions to test with: random texts over the whole syntax, and their languages."""
from __future__ import annotations

from typing import Optional

from hypothesis import strategies as st

from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.regular.inclusion import Difference
from rocon_uri.regular.language import Language
from rocon_uri.regular.syntax import parse


def language(text: str) -> Language:
    return Language(text, parse(text))


def difference(one: Language, other: Language) -> Optional[str]:
    """A name that one language has and the other one does not have, None if there is none."""
    found = Difference(one, other).find()
    return None if found is None else found.text() + one.example(found.positions)


def admits_names(text: str) -> bool:
    try:
        parse(text)
    except RoconURIValueError as error:
        assert 'admits no name' in error.problem
        return False
    return True


@st.composite
def pieces(draw, atoms, inner):
    atom = draw(st.one_of(atoms, atoms, inner.map('({})'.format), inner.map('(?:{})'.format)))
    return atom + draw(st.sampled_from(['', '', '', '*', '+', '?', '{2}', '{0}', '{1,}', '{0,2}',
                                        '{2,3}']))


def patterns(atoms):
    """Texts over the whole syntax; each `|` is in a group."""
    def branch(inner):
        return st.lists(pieces(atoms, inner), max_size=4).map(''.join)

    def branches(inner):
        return st.lists(branch(inner), min_size=1, max_size=3).map('|'.join)

    inside = st.recursive(atoms, branches, max_leaves=4)
    anchored = st.tuples(st.sampled_from(['', '', '^']), branch(inside),
                         st.sampled_from(['', '', '$']))
    return anchored.map(''.join)


ALL_ATOMS = st.sampled_from(['a', 'b', 'A', '0', '_', '.', r'\d', r'\D', r'\w', r'\W', '[ab]',
                             '[^a]', '[a-c0-1]', r'[^\w]', r'[\d_]', r'[^\Db]', '[A-Z]', 'bob'])
SMALL_ATOMS = st.sampled_from(['a', 'b', '0', '.', '[ab]', '[^a]', r'\d', 'ab', 'aa'])
