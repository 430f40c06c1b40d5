"""The name checks agree with those of ROS, which they stand in for."""
from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocon_uri.sources.ros_names import (
    is_legal_base_name, is_legal_name, is_legal_resource_name, legalised)

NAMES = [
    # name              base   resource  graph
    ('bob',             True,  True,     True),
    ('Bob_7',           True,  True,     True),
    ('',                False, False,    True),
    (None,              False, False,    False),
    ('7bob',            False, False,    False),
    ('_bob',            False, False,    False),
    ('bob-1',           False, False,    False),
    ('bob ',            False, False,    False),
    ('bob\n',           False, False,    False),
    ('a/b',             False, True,     True),
    ('a/b/c',           False, True,     True),
    ('a/',              False, True,     True),
    ('a//b',            False, False,    False),
    ('/a',              False, False,    True),
    ('~a',              False, False,    True),
    ('~',               False, False,    True),
    ('/',               False, False,    True),
    ('a~b',             False, False,    False),
    ('b\u00f6b',        False, False,    False),
    ('bob\u0663',       False, False,    False),
    ('b' * 100000,      True,  True,     True),
]


@pytest.mark.parametrize('name, base, resource, graph', NAMES)
def test_what_is_legal(name, base, resource, graph):
    assert is_legal_base_name(name) is base
    assert is_legal_resource_name(name) is resource
    assert is_legal_name(name) is graph


near_names = st.text(alphabet='abZ09_/~ \n-.', max_size=8)
ascii_texts = st.text(alphabet=st.characters(max_codepoint=127), max_size=8)


@given(st.one_of(near_names, ascii_texts, st.none()))
def test_in_ascii_they_are_the_checks_of_ros(name):
    graph = pytest.importorskip('rosgraph.names')
    resource = pytest.importorskip('roslib.names')
    assert is_legal_name(name) == graph.is_legal_name(name)
    assert is_legal_base_name(name) == graph.is_legal_base_name(name)
    assert is_legal_resource_name(name) == resource.is_legal_resource_name(name)


@given(st.text())
def test_beyond_ascii_they_only_refuse_more(name):
    graph = pytest.importorskip('rosgraph.names')
    resource = pytest.importorskip('roslib.names')
    for ours, theirs in ((is_legal_name, graph.is_legal_name),
                         (is_legal_base_name, graph.is_legal_base_name),
                         (is_legal_resource_name, resource.is_legal_resource_name)):
        assert ours(name) == (theirs(name) and name.isascii())


@given(st.text())
def test_any_text_becomes_a_base_name_and_a_base_name_in_lower_case_stays(text):
    name = legalised(text)
    assert is_legal_base_name(name)
    assert legalised(name) == name
