"""An instance of a capability: its states, and the old class that it is."""
import copy
from types import SimpleNamespace

import pytest

from capabilities.instances import CapabilityInstance, State, get_reverse_depends


@pytest.fixture
def instance():
    spec = SimpleNamespace(name='nav/amcl', implements='nav/Nav', dependencies={'base/Base': None})
    return CapabilityInstance(spec, '/nav.yaml')


def test_it_has_the_attributes_of_old(instance):
    assert (instance.name, instance.provider, instance.interface) == (
        'nav/amcl', 'nav/amcl', 'nav/Nav')
    assert (instance.pid, instance.depends_on, instance.canceled, instance.started_by) == (
        None, ['base/Base'], False, 'unknown')
    assert (instance.bonds, instance.reference_count, instance.state) == ({}, 0, 'waiting')
    assert not instance.uses_nodelet_manager


def test_the_states_follow_each_other(instance):
    assert instance.launch() and instance.state == 'launching'
    assert instance.launched(42) and instance.state == 'running' and instance.pid == 42
    assert instance.degraded() and instance.state == 'degraded'
    assert instance.stopped() and instance.state == 'stopping'
    assert instance.terminated() and instance.state == 'terminated'


@pytest.mark.parametrize('state, allowed', [
    ('waiting', ['launch', 'cancel']),
    ('launching', ['launched', 'degraded', 'stopped']),
    ('running', ['degraded', 'stopped']),
    ('degraded', ['degraded', 'stopped']),
    ('stopping', ['terminated']),
    ('terminated', []),
])
def test_a_wrong_transition_is_refused_and_logged(instance, caplog, state, allowed):
    for name in 'launch', 'cancel', 'launched', 'degraded', 'stopped', 'terminated':
        instance._CapabilityInstance__state = state
        caplog.clear()
        transition = getattr(instance, name)
        assert transition(*([42] if name == 'launched' else [])) == (name in allowed)
        assert bool(caplog.records) == (name not in allowed)


def test_terminated_is_accepted_from_any_state(instance):
    instance.launch()
    assert not instance.terminated()
    assert instance.state is State.TERMINATED


def test_a_cancelled_one_says_so(instance):
    assert instance.cancel() and instance.canceled


def test_uses_are_counted_by_bond(instance):
    for bond, asked_as in ('a', 'nav/Nav'), ('a', 'nav/Plain'), ('b', 'nav/Nav'):
        instance.add_use(bond, asked_as)
    assert instance.bonds == {'a': 2, 'b': 1} and instance.reference_count == 3
    assert instance.asked_as == {('a', 'nav/Plain'): 1}
    instance.remove_use('a', 'nav/Nav')
    assert instance.asked_as == {('a', 'nav/Plain'): 1}
    instance.remove_use('a', 'nav/Nav')
    assert instance.asked_as == {} and instance.bonds == {'b': 1}
    instance.add_use('a', 'nav/Plain')
    instance.drop_wants('a')
    assert instance.bonds == {'b': 1} and instance.asked_as == {}
    instance.drop_wants()
    assert instance.bonds == {}


def test_the_names_that_uses_were_asked_for_by_are_those_of_their_bond(instance):
    def bond(letter):
        return 'bond_' + letter     # each time another str, as from a message

    for letter, name in ('c', 'Plain'), ('b', 'Plain'), ('a', 'Nav'):
        instance.add_use(bond(letter), 'nav/' + name)
    plain = {('bond_c', 'nav/Plain'): 1, ('bond_b', 'nav/Plain'): 1}
    assert instance.asked_as == plain
    instance.remove_use(bond('a'), 'nav/Nav')
    assert instance.asked_as == plain
    instance.remove_use(bond('b'), 'nav/Nav')
    assert instance.asked_as == {('bond_c', 'nav/Plain'): 1} and instance.bonds == {'bond_c': 1}
    for letter in 'cbb':
        instance.add_use(bond(letter), 'nav/Plain')
    instance.remove_use(bond('c'), 'nav/Plain')
    instance.drop_wants(bond('b'))
    assert instance.asked_as == {('bond_c', 'nav/Plain'): 1} and instance.bonds == {'bond_c': 1}


def test_an_instance_that_nobody_wants_was_neither_started_nor_asked_for(instance):
    instance.started = True
    instance.add_use('a', 'nav/Plain')
    instance.drop_wants()
    assert (instance.started, instance.bonds, instance.asked_as) == (False, {}, {})


def test_a_successor_waits_to_run_the_same_for_the_same_wants(instance):
    one = CapabilityInstance(instance.spec, '/nav.yaml', 'nav/app', 'nav/Plain', '/nav.launch',
                             ['base/Arm'], True)
    one.launch()
    one.launched(42)
    one.started = True
    one.dependencies = [instance]
    one.add_use('a', 'nav/Plain')
    kept = ('spec', 'provider_path', 'started_by', 'redefines', 'launch_file', 'depends_on',
            'uses_nodelet_manager', 'started', 'bonds', 'asked_as', 'dependencies')
    before = [copy.copy(getattr(one, name)) for name in kept]
    successor = one.successor()
    one.drop_wants()
    one.dependencies.clear()
    assert [getattr(successor, name) for name in kept] == before
    assert (successor.state, successor.pid, successor.depends_on) == (
        'waiting', None, ['base/Arm'])


def test_reverse_dependencies_are_found_by_name(instance):
    assert get_reverse_depends('base/Base', [instance]) == [instance]
    assert get_reverse_depends('nav/Nav', [instance]) == []
