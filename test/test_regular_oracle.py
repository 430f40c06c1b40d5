"""
Two patterns are compared as interegular compares them, an engine that others wrote.

It comes from PyPI into build/lint, with all that test/lint_requirements.txt names.
"""
from __future__ import annotations

import os
import sys

import pytest
from hypothesis import HealthCheck, given, settings
from regular_patterns import SMALL_ATOMS, admits_names, language, patterns
from sources import ROOT

from rocon_uri.regular.inclusion import includes
from rocon_uri.regular.intersection import common_name
from rocon_uri.regular.tree import ALPHABET

_before = list(sys.path)
sys.path += map(str, (ROOT / 'build' / 'lint' / 'lib').glob('python3.*/site-packages'))
try:
    import interegular
    from interegular.fsm import Alphabet, anything_else
except ImportError:
    if os.environ.get('CI'):
        raise
    pytest.skip('interegular is not installed', allow_module_level=True)
finally:
    sys.path[:] = _before

# One symbol stands for all characters that the patterns cannot tell apart: it takes long otherwise.
GROUPS = 'a', 'b', '0', '123456789', '_'
SYMBOLS = Alphabet.from_groups(*GROUPS, ''.join(set(ALPHABET).difference(*GROUPS)),
                               [anything_else])
NAMES = interegular.parse_pattern('[a-zA-Z][a-zA-Z0-9_]*').to_fsm(SYMBOLS)
LARGEST = 8         # Glushkov positions: with more, the oracle takes seconds for some


def automaton(text):
    """The legal names that a pattern matches, as an automaton of interegular."""
    return interegular.parse_pattern('(?:%s)' % text).to_fsm(SYMBOLS) & NAMES


# without anchors, which interegular does not read; they change nothing
texts = patterns(SMALL_ATOMS).map(lambda text: text.strip('^$')).filter(
    lambda text: len(text) < 40 and admits_names(text) and language(text).tree.size <= LARGEST)


@settings(max_examples=200, deadline=None, suppress_health_check=list(HealthCheck))
@given(texts, texts)
def test_intersection_and_inclusion_agree_with_interegular(one, other):
    ours, theirs = language(one), language(other)
    first, second = automaton(one), automaton(other)
    shared = common_name(ours, theirs)
    assert (shared is None) == first.isdisjoint(second)
    if shared is not None:
        assert first.accepts(shared) and second.accepts(shared)
    assert includes(theirs, ours) == (first <= second)
    assert includes(ours, theirs) == (second <= first)
    assert first.accepts(ours.example()) and second.accepts(theirs.example())
