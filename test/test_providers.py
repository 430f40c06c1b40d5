"""Which provider runs a capability, in which order providers start, and what stands in the way."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Set

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from capabilities.discovery import (
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.providers import (
    StartPlan, choose_provider, find_cycles, plan_for_capabilities, plan_for_provider)
from capabilities.spec_index import SpecIndex
from capabilities.specs.interface import CapabilityInterface
from capabilities.specs.provider import CapabilityProvider
from capabilities.specs.semantic_interface import SemanticCapabilityInterface

WORKSPACE = str(Path(__file__).parent / 'workspace')
CORPUS = os.environ.get('ROCON_URI_CORPUS', '')


def spec_index_of(path: str) -> SpecIndex:
    packages = package_index_from_package_path([path])
    return spec_index_from_spec_file_index(spec_file_index_from_package_index(packages))[0]


def spec_index(*lines: str) -> SpecIndex:
    """
    The index of some providers in the package p, one a line: 'name Interface depends ...'.

    A dependency is an interface, or 'Interface=provider' where one is preferred. A line of one
    word adds an interface without a provider; all that are implemented are added by themselves.
    """
    index = SpecIndex()
    for line in lines:
        words = line.split()
        if 'p/' + words[:2][-1] not in index.interface_names:
            index.add_interface(CapabilityInterface(words[:2][-1], 1), 'f', 'p')
    for line in lines:
        words = line.split()
        if len(words) > 1:
            provider = CapabilityProvider(words[0], 1, 'p/' + words[1])
            for word in words[2:]:
                interface, _, preferred = word.partition('=')
                provider.add_depends_on('p/' + interface, 'p/' + preferred if preferred else None)
            index.add_provider(provider, 'f', 'p')
    return index


CAMERAS = spec_index('left Camera', 'right Camera', 'scanner Laser', 'Arm')


class TestChoice:

    @pytest.mark.parametrize('capability, preferred, defaults, chosen', [
        ('p/Laser', None, None, 'p/scanner'),
        ('p/Laser', None, {'p/Laser': 'p/scanner'}, 'p/scanner'),
        ('p/Camera', None, {'p/Camera': 'p/right', 'p/Arm': 'p/none'}, 'p/right'),
        ('p/Camera', 'p/left', None, 'p/left'),
        ('p/Camera', 'p/left', {'p/Camera': 'p/right'}, 'p/left'),
        ('p/Camera', 'p/left', {'p/Camera': 'p/none'}, 'p/left'),
    ])
    def test_preferred_then_default_then_only_one(
            self, capability: str, preferred: Optional[str], defaults: Optional[Dict[str, str]],
            chosen: str) -> None:
        assert choose_provider(CAMERAS, capability, preferred, defaults) == chosen

    @pytest.mark.parametrize('capability, preferred, defaults, kind, text', [
        ('p/Lazer', None, None, FaultKind.NO_INTERFACE,
         "capability 'p/Lazer': no package exports this capability (did you mean 'p/Laser'?)"),
        ('p/Lazer', 'p/scanner', None, FaultKind.NO_INTERFACE,
         "capability 'p/Lazer': no package exports this capability (did you mean 'p/Laser'?)"),
        ('q/scanner', None, None, FaultKind.NO_INTERFACE,
         "capability 'q/scanner': no package exports this capability"),
        ('p/Arm', None, None, FaultKind.NO_PROVIDER,
         "capability 'p/Arm': no provider implements it"),
        ('p/Camera', None, {'p/Laser': 'p/scanner'}, FaultKind.AMBIGUOUS,
         "capability 'p/Camera': several providers implement it, and none is the default: "
         "'p/left', 'p/right'"),
        ('p/Laser', 'p/skanner', None, FaultKind.UNKNOWN_PROVIDER,
         "capability 'p/Laser': no package exports the preferred provider 'p/skanner' (did you "
         "mean 'p/scanner'?)"),
        ('p/Laser', None, {'p/Laser': 'q/none'}, FaultKind.UNKNOWN_PROVIDER,
         "capability 'p/Laser': no package exports the default provider 'q/none'"),
        ('p/Laser', 'p/left', {'p/Laser': 'p/scanner'}, FaultKind.WRONG_PROVIDER,
         "capability 'p/Laser': the preferred provider 'p/left' implements 'p/Camera' instead"),
        ('p/Laser', None, {'p/Laser': 'p/left'}, FaultKind.WRONG_PROVIDER,
         "capability 'p/Laser': the default provider 'p/left' implements 'p/Camera' instead"),
    ])
    def test_no_choice(self, capability: str, preferred: Optional[str],
                       defaults: Optional[Dict[str, str]], kind: FaultKind, text: str) -> None:
        fault = choose_provider(CAMERAS, capability, preferred, defaults)
        assert isinstance(fault, Fault)
        assert fault.kind is kind
        assert str(fault) == text
        assert fault.is_default == ('default provider' in text)

    def test_a_fault_carries_its_parts(self) -> None:
        fault = choose_provider(CAMERAS, 'p/Camera', None, {'p/Camera': 'p/scanner'})
        assert fault == Fault(
            FaultKind.WRONG_PROVIDER, 'p/Camera', asked_for='p/Camera', provider='p/scanner',
            is_default=True, implements='p/Laser', candidates=('p/left', 'p/right'))
        assert fault.to_dict() == {
            'kind': 'wrong-provider', 'capability': 'p/Camera', 'asked_for': 'p/Camera',
            'required_by': None, 'provider': 'p/scanner', 'is_default': True,
            'implements': 'p/Laser', 'candidates': ['p/left', 'p/right'],
            'semantic_candidates': [], 'cycle': [], 'launch_file': None, 'line': None,
            'column': None, 'sharers': [], 'running': None}

    def test_a_provider_that_is_not_there_is_told_beside_those_that_are(self) -> None:
        assert choose_provider(CAMERAS, 'p/Camera', 'p/none') == Fault(
            FaultKind.UNKNOWN_PROVIDER, 'p/Camera', asked_for='p/Camera', provider='p/none',
            candidates=('p/left', 'p/right'))

    def test_a_semantic_interface_has_providers_of_its_own(self) -> None:
        index = spec_index('camera Camera')
        index.add_semantic_interface(SemanticCapabilityInterface('Front', 'p/Camera', 1), 'f', 'p')
        fault = choose_provider(index, 'p/Front')
        assert fault.kind is FaultKind.NO_PROVIDER
        index.add_provider(CapabilityProvider('front', 1, 'p/Front'), 'f', 'p')
        assert choose_provider(index, 'p/Front') == 'p/front'
        assert choose_provider(index, 'p/Camera') == 'p/camera'


class TestPlan:

    def test_dependencies_first_and_each_once(self) -> None:
        index = spec_index('navigation Navigation Base Laser', 'base Base Bringup',
                           'laser Laser Bringup', 'bringup Bringup', 'arm Arm')
        plan = plan_for_capabilities(index, ['p/Navigation', 'p/Base'])
        assert plan.order == ['p/bringup', 'p/base', 'p/laser', 'p/navigation']
        assert plan.providers == {'p/Navigation': 'p/navigation', 'p/Base': 'p/base',
                                  'p/Bringup': 'p/bringup', 'p/Laser': 'p/laser'}
        assert plan.dependencies == {
            'p/navigation': ['p/base', 'p/laser'], 'p/base': ['p/bringup'], 'p/bringup': [],
            'p/laser': ['p/bringup']}
        assert plan.can_start

    def test_a_provider_can_be_asked_for(self) -> None:
        index = spec_index('left Camera Power', 'right Camera', 'power Power')
        assert plan_for_provider(index, 'p/left').order == ['p/power', 'p/left']
        with pytest.raises(KeyError, match='p/none'):
            plan_for_provider(index, 'p/none')

    def test_a_provider_of_an_interface_that_was_removed(self) -> None:
        index = spec_index('laser Laser')
        index.remove_interface('p/Laser')
        [fault] = plan_for_provider(index, 'p/laser').faults
        assert fault.kind is FaultKind.NO_INTERFACE

    def test_defaults_and_preferences_decide_at_every_depth(self) -> None:
        index = spec_index('navigation Navigation Base=wheels', 'wheels Base Motor', 'legs Base',
                           'electric Motor', 'diesel Motor')
        plan = plan_for_capabilities(index, ['p/Navigation'],
                                     {'p/Base': 'p/legs', 'p/Motor': 'p/diesel'})
        assert plan.order == ['p/diesel', 'p/wheels', 'p/navigation']
        assert plan.can_start

    def test_all_faults_are_found(self) -> None:
        index = spec_index('robot Robot Base Laser Camera Arm=hand Map', 'base Base Nothing',
                           'left Camera', 'right Camera', 'Laser', 'hand Hand', 'arm Arm')
        plan = plan_for_capabilities(index, ['p/Robot', 'p/Laser', 'p/Mop'])
        assert [str(fault) for fault in plan.faults] == [
            "provider 'p/base' depends on 'p/Nothing': no package exports this capability",
            "provider 'p/robot' depends on 'p/Laser': no provider implements it",
            "provider 'p/robot' depends on 'p/Camera': several providers implement it, and none "
            "is the default: 'p/left', 'p/right'",
            "provider 'p/robot' depends on 'p/Arm': the preferred provider 'p/hand' implements "
            "'p/Hand' instead",
            "provider 'p/robot' depends on 'p/Map': no package exports this capability",
            "capability 'p/Laser': no provider implements it",
            "capability 'p/Mop': no package exports this capability"]
        assert [fault.asked_for for fault in plan.faults] == ['p/Robot'] * 5 + ['p/Laser', 'p/Mop']
        assert [fault.required_by for fault in plan.faults] == [
            'p/base'] + ['p/robot'] * 4 + [None, None]
        assert not plan.can_start

    def test_two_providers_of_one_capability_at_once(self) -> None:
        index = spec_index('front View Camera=left', 'rear Mirror Camera=right', 'left Camera',
                           'right Camera')
        [fault] = plan_for_capabilities(index, ['p/View', 'p/Mirror']).faults
        assert (fault.kind, fault.capability, fault.asked_for, fault.candidates) == (
            FaultKind.CONFLICT, 'p/Camera', 'p/Mirror', ('p/left', 'p/right'))
        assert str(fault) == (
            "capability 'p/Camera': several of its providers would have to run at once: "
            "'p/left', 'p/right'")

    @pytest.mark.parametrize('lines, cycle', [
        (['a A B', 'b B A'], 'p/a -> p/b -> p/a'),
        (['a A A'], 'p/a -> p/a'),
        (['a A B', 'b B C', 'c C D', 'd D B'], 'p/b -> p/c -> p/d -> p/b'),
    ])
    def test_a_cycle_is_named(self, lines: List[str], cycle: str) -> None:
        plan = plan_for_capabilities(spec_index(*lines), ['p/A'])
        [fault] = plan.faults
        assert fault.kind is FaultKind.CYCLE
        assert fault.cycle == tuple(cycle.split(' -> '))
        assert fault.capability == spec_index(*lines).providers[fault.cycle[0]].implements
        assert fault.asked_for == 'p/A'
        assert str(fault) == 'providers depend on each other in a cycle: ' + cycle
        assert len(plan.order) == len(lines)

    def test_cycles_apart_from_each_other_are_all_named(self) -> None:
        index = spec_index('robot Robot A C', 'a A B', 'b B A', 'c C D', 'd D C')
        plan = plan_for_capabilities(index, ['p/Robot'])
        assert [fault.cycle for fault in plan.faults] == [
            ('p/a', 'p/b', 'p/a'), ('p/c', 'p/d', 'p/c')]

    def test_all_cycles_of_an_index(self) -> None:
        index = spec_index('a A B', 'b B A', 'c C C', 'd D A', 'left E', 'right E', 'e F E G')
        assert [fault.cycle for fault in find_cycles(index)] == [
            ('p/a', 'p/b', 'p/a'), ('p/c', 'p/c')]
        assert find_cycles(spec_index_of(WORKSPACE)) == []
        [fault] = find_cycles(spec_index('one A A=one', 'other A'))     # each provider is looked at
        assert fault.cycle == ('p/one', 'p/one')

    def test_a_chain_may_be_long(self) -> None:
        length = 5000
        lines = ['x%d X%d X%d' % (n, n, n + 1) for n in range(length)]
        plan = plan_for_capabilities(spec_index(*lines, 'x%d X%d' % (length, length)), ['p/X0'])
        assert plan.order == ['p/x%d' % n for n in range(length, -1, -1)]
        assert plan.can_start
        plan = plan_for_capabilities(spec_index(*lines, 'x%d X%d X0' % (length, length)), ['p/X0'])
        assert [len(fault.cycle) for fault in plan.faults] == [length + 2]


@st.composite
def graphs(draw: Any, acyclic: bool = False) -> Dict[int, List[int]]:
    """For each number, those that it depends on."""
    size = draw(st.integers(1, 8))
    return {node: draw(st.lists(st.integers(node + 1 if acyclic else 0, size - 1), unique=True)
                       if not acyclic or node + 1 < size else st.just([]))
            for node in range(size)}


def plan_of(graph: Dict[int, List[int]]) -> StartPlan:
    lines = ['x%d X%d %s' % (node, node, ' '.join('X%d' % below for below in graph[node]))
             for node in sorted(graph)]
    return plan_for_capabilities(spec_index(*lines), ['p/X0'])


def numbers(names: Sequence[str]) -> List[int]:
    return [int(name[len('p/x'):]) for name in names]


def reachable(graph: Dict[int, List[int]], node: int) -> Set[int]:
    """What a node leads to, by one step or more."""
    found: Set[int] = set()
    waiting = list(graph[node])
    while waiting:
        below = waiting.pop()
        if below not in found:
            found.add(below)
            waiting += graph[below]
    return found


@settings(deadline=None)
@given(graphs(acyclic=True))
def test_every_provider_starts_after_those_it_depends_on(graph: Dict[int, List[int]]) -> None:
    plan = plan_of(graph)
    order = numbers(plan.order)
    assert plan.can_start
    assert sorted(order) == sorted(reachable(graph, 0) | {0})
    for place, node in enumerate(order):
        assert set(graph[node]) <= set(order[:place])


@settings(deadline=None)
@given(graphs())
def test_cycles_are_found_where_there_are_any(graph: Dict[int, List[int]]) -> None:
    plan = plan_of(graph)
    cyclic = {node for node in reachable(graph, 0) | {0} if node in reachable(graph, node)}
    named: Set[int] = set()
    for fault in plan.faults:
        assert fault.kind is FaultKind.CYCLE
        cycle = numbers(fault.cycle)
        assert cycle[0] == cycle[-1]
        assert len(set(cycle)) == len(cycle) - 1
        assert all(below in graph[node] for node, below in zip(cycle, cycle[1:]))
        assert named.isdisjoint(cycle)
        named |= {below for node in cycle for below in reachable(graph, node)
                  if node in reachable(graph, below)}
    assert named == cyclic


def test_a_workspace() -> None:
    index = spec_index_of(WORKSPACE)
    [fault] = plan_for_capabilities(index, ['home_capabilities/Navigation']).faults
    assert (fault.kind, fault.required_by, fault.candidates) == (
        FaultKind.AMBIGUOUS, 'home_navigation/grid_navigation',
        ('dustbot_capabilities/dustbot_base', 'home_simulation/simulated_base'))
    plan = plan_for_capabilities(
        index, ['home_capabilities/Navigation', 'dustbot_capabilities/FrontCamera'],
        {'home_capabilities/MobileBase': 'dustbot_capabilities/dustbot_base'})
    assert plan.can_start
    assert plan.order == [
        'dustbot_capabilities/dustbot_bringup', 'dustbot_capabilities/dustbot_base',
        'dustbot_capabilities/dustbot_laser', 'home_navigation/grid_navigation',
        'dustbot_capabilities/dustbot_front_camera']


@pytest.mark.skipif(not CORPUS, reason='ROCON_URI_CORPUS is not set')
def test_the_corpus() -> None:
    index = spec_index_of(CORPUS)
    plan = plan_for_provider(index, 'turtlebot_capabilities/turtlebot2_bringup')
    assert plan.can_start
    assert plan.order == [
        'turtlebot_capabilities/diagnostics', 'kobuki_capabilities/kobuki_bringup',
        'kobuki_capabilities/kobuki_differential_mobile_base',
        'turtlebot_capabilities/robot_state_publisher',
        'turtlebot_capabilities/turtlebot2_bringup']
    [fault] = plan_for_provider(index, 'turtlebot_capabilities/depthimage_to_laserscan').faults
    assert fault.provider == 'turtlebot_capabilities/kinect_rgbd_sensor'
    assert fault.suggestions == ['turtlebot_capabilities/rgbd_sensor']
    assert plan_for_capabilities(index, ['kobuki_capabilities/KobukiLED1']).order == [
        'kobuki_capabilities/kobuki_bringup', 'kobuki_capabilities/kobuki_led1']
