"""Which capabilities run: a state machine against a model of a page, and each rule by example."""
import os
from collections import Counter
from types import SimpleNamespace

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from capabilities.graph import Do, Graph, RefusedRequest, StartResult
from capabilities.instances import CapabilityInstance, State

STEPS = int(os.environ.get('CAPABILITIES_GRAPH_STEPS', '1000'))

NAMES = ['p/%s' % letter for letter in 'ABCDEF']
BONDS = ['one', 'two']


def new_instance(name, depends_on=(), redefines=None, provider=None):
    spec = SimpleNamespace(name=provider or name.lower(), implements=name, dependencies=depends_on)
    return CapabilityInstance(spec, '/somewhere.yaml', redefines=redefines)


class World:
    """A graph and the processes that it is told of."""

    def __init__(self, dependencies, keep=False):
        self.dependencies = dependencies
        self.graph = Graph(lambda: 0.0, keep)
        self.processes = {}     # instances by pid
        self.told_to_stop = []
        self.refuse_launch = False
        self.told = []
        self.pids = 0
        for bond in BONDS:
            self.graph.bond_formed(bond)

    def needed(self, name):
        """The capability and all below it, dependencies first."""
        found = {}
        for below in self.dependencies[name]:
            found.update(self.needed(below))
        found[name] = None
        return found

    def planned(self, name):
        return [new_instance(each, self.dependencies[each]) for each in self.needed(name)]

    def start(self, name):
        result = self.graph.start(name, self.planned(name))
        self.carry_out()
        return result

    def use(self, name, bond='one'):
        self.graph.use(name, self.planned(name), bond, name)
        self.carry_out()

    def free(self, name, bond='one'):
        stopped = self.graph.free(name, bond)
        self.carry_out()
        return stopped

    def stop(self, name):
        self.graph.stop(name)
        self.carry_out()

    def end(self, instance, exit_code=1):
        del self.processes[instance.pid]
        if instance in self.told_to_stop:
            self.told_to_stop.remove(instance)
        self.graph.ended(instance, exit_code, 'exit %d' % exit_code)
        self.carry_out()

    def end_stopped(self):
        while self.told_to_stop:
            self.end(self.told_to_stop[0])

    def carry_out(self):
        actions = self.graph.take_actions()
        while actions:
            for do, instance in actions:
                self.told.append((do.value, instance.interface))
                if do is Do.LAUNCH and not instance.canceled:
                    if self.refuse_launch:
                        self.refuse_launch = False
                        self.graph.launch_failed(instance, 'no memory')
                    else:
                        self.pids += 1
                        self.processes[self.pids] = instance
                        self.graph.launched(instance, self.pids)
                elif do is Do.STOP:
                    assert instance.pid in self.processes
                    self.told_to_stop.append(instance)
                elif do is Do.GONE:
                    assert instance.pid not in self.processes
            actions = self.graph.take_actions()

    def states(self):
        return {instance.interface: instance.state.value for instance in self.graph.instances}

    def since(self, mark):
        """What was told since then, but for what is not sent."""
        return [told for told in self.told[mark:]
                if told[0] in ('launched', 'stopped', 'terminated')]


class GraphAgainstModel(RuleBasedStateMachine):
    """
    The model: who wants what, and which dependencies were lost with ``keep``.

    Everything else follows: what has to run is what is wanted, what that depends on, and what
    stopping processes depend on.
    """

    def __init__(self):
        super().__init__()
        self.set_up(False, {name: [] for name in NAMES})    # older hypotheses ask before `begin`

    @initialize(keep=st.booleans(), data=st.data())
    def begin(self, keep, data):
        dependencies = {}
        for index, name in enumerate(NAMES):
            dependencies[name] = data.draw(
                st.lists(st.sampled_from(NAMES[:index]), unique=True, max_size=3)) if index else []
        self.set_up(keep, dependencies)

    def set_up(self, keep, dependencies):
        self.keep = keep
        self.world = World(dependencies, keep)
        self.started = set()
        self.uses = {bond: Counter() for bond in BONDS}
        self.lost = set()   # pairs of what goes on, and the dependency that it has no more

    # the model

    def below(self, name):
        return [each for each in self.world.dependencies[name] if (name, each) not in self.lost]

    def closure(self, names):
        found, waiting = set(), list(names)
        while waiting:
            name = waiting.pop()
            if name not in found:
                found.add(name)
                waiting += self.below(name)
        return found

    def above(self, name):
        found = {name}
        for each in NAMES:      # in this order dependencies come first
            if each in self.current() and found.intersection(self.below(each)):
                found.add(each)
        return found

    def current(self):
        return {instance.interface: instance for instance in self.world.graph.instances
                if instance.state is not State.STOPPING}

    def stopping(self):
        return {instance.interface: instance for instance in self.world.graph.instances
                if instance.state is State.STOPPING}

    def forget(self, names):
        self.started -= set(names)
        for name in names:
            for uses in self.uses.values():
                uses.pop(name, None)

    def wanted(self):
        return self.started.union(*self.uses.values())

    # what is asked for, and what happens

    @rule(name=st.sampled_from(NAMES))
    def start(self, name):
        before = self.current().get(name)
        stops = name in self.stopping()
        result = self.world.start(name)
        if stops:
            assert result is StartResult.STOPPING
        else:
            self.started.add(name)
            expected = StartResult.SUCCESS
            if before is not None:
                expected = StartResult.RUNNING if before.pid else StartResult.STARTING
            assert result is expected

    @rule(name=st.sampled_from(NAMES), bond=st.sampled_from(BONDS))
    def use(self, name, bond):
        self.world.use(name, bond)
        self.uses[bond][name] += 1

    @rule(name=st.sampled_from(NAMES), bond=st.sampled_from(BONDS))
    def free(self, name, bond):
        if not self.uses[bond][name]:
            with pytest.raises(RefusedRequest, match='Cannot free' if name not in self.current()
                               else 'not associated'):
                self.world.free(name, bond)
            self.uses[bond].pop(name, None)
            return
        self.uses[bond][name] -= 1
        self.uses[bond] += Counter()    # without what is 0
        self.world.free(name, bond)

    @rule(name=st.sampled_from(NAMES))
    def stop(self, name):
        if name not in self.current() and name not in self.stopping():
            with pytest.raises(RefusedRequest, match='running'):
                self.world.stop(name)
            return
        if name in self.current():
            self.forget(self.above(name))
        self.world.stop(name)

    @rule(bond=st.sampled_from(BONDS))
    def break_bond(self, bond):
        self.uses[bond].clear()
        self.world.graph.bond_broken(bond)
        self.world.carry_out()
        self.world.graph.bond_formed(bond)

    @precondition(lambda self: self.world.told_to_stop)
    @rule(data=st.data())
    def a_stopped_process_ends(self, data):
        self.world.end(data.draw(st.sampled_from(self.world.told_to_stop)))

    @precondition(lambda self: self.world.processes)
    @rule(data=st.data())
    def a_process_ends(self, data):
        instance = data.draw(st.sampled_from(list(self.world.processes.values())))
        name = instance.interface
        if instance.state is not State.STOPPING:
            if self.keep:
                running = {each for each in self.above(name)
                           if self.current()[each].pid and name in self.below(each)}
                self.lost |= {(each, name) for each in running}
            self.forget(self.above(name))
        self.world.end(instance)

    @rule(name=st.sampled_from(NAMES))
    def restart(self, name):
        self.world.graph.restart([name])
        self.world.carry_out()

    @precondition(lambda self: self.world.graph.instances)
    @rule(data=st.data())
    def nodes_are_started(self, data):
        self.world.graph.nodes_started(data.draw(st.sampled_from(self.world.graph.instances)))

    # what always holds

    @invariant()
    def what_runs_is_what_is_wanted(self):
        current = self.current()
        self.lost = {pair for pair in self.lost if pair[0] in current}
        stopping = [dependency.interface for instance in self.stopping().values()
                    for dependency in instance.dependencies
                    if dependency.state not in (State.STOPPING, State.TERMINATED)]
        assert set(current) == self.closure([*self.wanted(), *stopping])

    @invariant()
    def what_is_on_its_way_waits_for_something(self):
        for name, instance in self.current().items():
            if instance.pid:
                assert all(self.current()[each].pid for each in self.below(name))
                assert name not in self.stopping()
            else:
                assert name in self.stopping() or any(
                    not self.current()[each].pid for each in self.below(name))

    @invariant()
    def dependents_end_first(self):
        for instance in self.stopping().values():
            users = [user for user in self.world.processes.values()
                     if instance in user.dependencies]
            assert (instance in self.world.told_to_stop) == (not users)
            assert all(user.state is State.STOPPING for user in users)

    @invariant()
    def nobody_is_forgotten(self):
        for name, instance in self.current().items():
            assert instance.started == (name in self.started)
            assert instance.bonds == {bond: uses[name] for bond, uses in self.uses.items()
                                      if uses[name]}
            assert name not in self.world.graph.failures
        assert sorted(map(id, self.world.processes.values())) == sorted(
            id(instance) for instance in self.world.graph.instances if instance.pid)


TestGraphAgainstModel = GraphAgainstModel.TestCase
TestGraphAgainstModel.settings = settings(
    stateful_step_count=50, max_examples=max(1, STEPS // 50), deadline=None, derandomize=True,
    database=None, suppress_health_check=list(HealthCheck))


@pytest.fixture
def robot():
    return World({'Base': [], 'Camera': [], 'Nav': ['Base'], 'Patrol': ['Nav', 'Camera']})


def test_dependencies_are_launched_first(robot):
    assert robot.start('Patrol') is StartResult.SUCCESS
    launched = [name for told, name in robot.told if told == 'launched']
    assert launched == ['Base', 'Camera', 'Nav', 'Patrol']


def test_a_launch_that_fails_takes_what_waits_for_it_along(robot):
    robot.refuse_launch = True
    robot.start('Nav')
    assert robot.states() == {}
    assert robot.graph.failures['Base'].text == 'no memory'
    assert robot.graph.failures['Nav'].text == 'Base, which it depends on, ended'
    assert robot.graph.failures['Nav'].exit_code == -1
    assert robot.graph.failures['Nav'].started
    assert robot.since(0) == []


def test_f11_a_base_that_is_used_by_two_outlives_the_free_of_one(robot):
    robot.use('Nav', 'one')
    robot.use('Base', 'two')
    assert robot.free('Base', 'two') == []
    assert robot.states() == {'Base': 'launching', 'Nav': 'launching'}


def test_f12_a_dependency_that_is_used_outlives_its_dependent(robot):
    robot.use('Nav', 'one')
    robot.use('Base', 'two')
    assert [instance.interface for instance in robot.free('Nav', 'one')] == ['Nav']
    robot.end_stopped()
    assert robot.states() == {'Base': 'launching'}


def test_f13_an_explicit_start_outlives_the_last_free(robot):
    robot.start('Base')
    robot.use('Base')
    assert robot.free('Base') == []
    assert robot.states() == {'Base': 'launching'}


def test_a_start_of_a_dependency_makes_it_wanted(robot):
    robot.use('Nav')
    assert robot.start('Base') is StartResult.RUNNING
    robot.free('Nav')
    robot.end_stopped()
    assert robot.states() == {'Base': 'launching'}


def test_a_stop_is_forceful_and_in_order(robot):
    robot.start('Patrol')
    mark = len(robot.told)
    robot.stop('Base')
    robot.end_stopped()
    assert robot.since(mark) == [
        ('stopped', 'Patrol'), ('stopped', 'Nav'), ('stopped', 'Base'),
        ('terminated', 'Patrol'), ('stopped', 'Camera'), ('terminated', 'Nav'),
        ('terminated', 'Camera'), ('terminated', 'Base')]
    assert robot.states() == {} and robot.graph.failures == {}


def test_independent_ones_are_stopped_at_the_same_time(robot):
    robot.use('Base')
    robot.use('Camera')
    robot.graph.bond_broken('one')
    robot.carry_out()
    assert [instance.interface for instance in robot.told_to_stop] == ['Base', 'Camera']


def test_what_dies_ends_every_want_and_stops_its_dependents(robot):
    robot.start('Patrol')
    robot.use('Nav', 'two')
    mark = len(robot.told)
    robot.end(robot.graph.current('Base'), exit_code=5)
    assert robot.states() == {'Nav': 'stopping', 'Patrol': 'stopping', 'Camera': 'launching'}
    robot.end_stopped()
    assert robot.since(mark)[0] == ('terminated', 'Base')
    failure = robot.graph.failures['Base']
    assert (failure.exit_code, failure.text, failure.dependents) == (5, 'exit 5', ('Nav',))
    assert robot.graph.failures['Nav'].uses == 1
    assert robot.graph.failures['Patrol'].text == 'Base, which it depends on, ended'
    with pytest.raises(RefusedRequest, match="Cannot free Capability 'Nav', because it is not run"):
        robot.free('Nav', 'two')
    robot.use('Nav', 'two')
    assert set(robot.graph.failures) == {'Patrol'}
    assert robot.graph.current('Nav').bonds == {'two': 1}


def test_dependents_can_be_kept():
    robot = World({'Base': [], 'Nav': ['Base'], 'Patrol': ['Nav']}, keep=True)
    robot.start('Patrol')
    robot.end(robot.graph.current('Base'))
    assert robot.states() == {'Nav': 'degraded', 'Patrol': 'launching'}
    assert robot.graph.current('Nav').notes == {'Base': 'Base, which it depends on, ended'}
    robot.graph.restart(['Nav'])
    robot.carry_out()
    robot.end_stopped()
    assert robot.states() == {'Nav': 'launching', 'Patrol': 'launching'}


def test_a_use_of_what_stops_waits_for_its_end(robot):
    robot.start('Base')
    robot.stop('Base')
    robot.use('Base')
    assert [(each.interface, each.state.value) for each in robot.graph.instances] == [
        ('Base', 'stopping'), ('Base', 'waiting')]
    assert robot.start('Base') is StartResult.STOPPING
    assert not robot.graph.current('Base').started
    mark = len(robot.told)
    robot.end_stopped()
    assert robot.since(mark) == [('terminated', 'Base'), ('launched', 'Base')]


def test_a_dependent_of_what_stops_waits_too(robot):
    robot.start('Base')
    robot.stop('Base')
    assert robot.start('Nav') is StartResult.SUCCESS
    assert robot.graph.current('Nav').state is State.WAITING
    robot.end_stopped()
    assert robot.states() == {'Base': 'launching', 'Nav': 'launching'}


def test_a_stop_drops_what_waits_and_waits_for_what_stops(robot):
    robot.start('Base')
    robot.stop('Base')
    robot.use('Base')
    assert robot.graph.stop('Base') == [robot.graph.stopping('Base')]
    robot.carry_out()
    robot.end_stopped()
    assert robot.states() == {}
    assert [name for told, name in robot.told if told == 'gone'] == ['Base', 'Base']
    with pytest.raises(RefusedRequest, match="^No Capability 'Base' running$"):
        robot.stop('Base')


def test_a_stop_ends_all_wants_and_waits_for_what_depends_on_it(robot):
    robot.start('Patrol')
    robot.use('Nav')
    waited_for = robot.graph.stop('Base')
    robot.carry_out()
    assert {instance.interface for instance in waited_for} == {'Base', 'Nav', 'Patrol'}
    assert not any(instance.started or instance.bonds for instance in waited_for)


def test_the_end_of_what_has_gone_already_changes_nothing(robot):
    robot.start('Base')
    gone = robot.graph.current('Base')
    robot.end(gone)
    robot.start('Base')
    robot.graph.ended(gone, 1, 'exit 1')
    assert robot.states() == {'Base': 'launching'} and robot.graph.failures == {}


def test_free_of_what_waits_leaves_what_stops_alone(robot):
    robot.start('Base')
    robot.stop('Base')
    robot.use('Base')
    robot.free('Base')
    assert robot.states() == {'Base': 'stopping'}
    with pytest.raises(RefusedRequest, match='because it is not running'):
        robot.free('Base')


def test_a_use_of_a_semantic_interface_is_freed_by_either_name(robot):
    robot.graph.use('Sem', [new_instance('Sem', redefines='Good')], 'one', 'Good')
    robot.graph.use('Sem', [], 'one', 'Sem')
    robot.graph.free('Good', 'one')
    assert robot.graph.current('Sem').asked_as == {}
    with pytest.raises(RefusedRequest, match="bond_id 'two' not associated"):
        robot.graph.free('Good', 'two')
    robot.graph.free('Good', 'one')
    assert robot.graph.current('Sem') is None


def test_of_several_semantic_interfaces_the_one_asked_for_by_that_name_is_freed(robot):
    robot.graph.use('Left', [new_instance('Left', redefines='Good')], 'one', 'Left')
    robot.graph.use('Right', [new_instance('Right', redefines='Good')], 'one', 'Good')
    robot.graph.free('Good', 'one')
    assert robot.graph.current('Right') is None
    assert robot.graph.current('Left') is not None


@pytest.mark.parametrize('semantic', ['Front', 'Sem'])
def test_the_interface_itself_is_freed_before_a_semantic_one(robot, semantic):
    robot.graph.use(semantic, [new_instance(semantic, redefines='Good')], 'one', 'Good')
    robot.graph.use('Good', [new_instance('Good')], 'one', 'Good')
    robot.graph.free(''.join('Good'), 'one')    # another str, as from a message
    assert robot.graph.current('Good') is None
    assert robot.graph.current(semantic) is not None


def test_a_restart_keeps_all_wants_and_the_order(robot):
    robot.start('Patrol')
    robot.use('Nav', 'two')
    robot.graph.restart(['Base'])
    robot.carry_out()
    assert [instance.interface for instance in robot.told_to_stop] == ['Patrol']
    robot.end_stopped()
    assert robot.states() == dict.fromkeys(['Base', 'Camera', 'Nav', 'Patrol'], 'launching')
    assert robot.graph.current('Patrol').started
    assert robot.graph.current('Nav').bonds == {'two': 1}


def test_a_restart_leaves_alone_what_does_not_depend_on_it(robot):
    robot.start('Patrol')
    robot.graph.restart(['Camera'])
    robot.carry_out()
    robot.end_stopped()
    assert [name for told, name in robot.told if told == 'terminated'] == ['Patrol', 'Camera']
    assert robot.states() == dict.fromkeys(['Base', 'Nav', 'Camera', 'Patrol'], 'launching')


def test_a_restart_keeps_the_names_that_uses_were_asked_for_by(robot):
    robot.graph.use('Left', [new_instance('Left', redefines='Good')], 'one', 'Left')
    robot.graph.use('Right', [new_instance('Right', redefines='Good')], 'one', 'Good')
    robot.graph.restart(['Right'])
    robot.graph.free('Good', 'one')
    assert [instance.interface for instance in robot.graph.instances] == ['Left']


def test_an_instance_says_since_when_it_is_in_its_state():
    now = [0.0]
    graph = Graph(lambda: now[0])
    base = new_instance('Base')

    def since_after(second, told, *arguments):
        now[0] = second
        told(*arguments)
        return base.state.value, base.since
    assert since_after(1, graph.start, 'Base', [base]) == ('launching', 1)
    assert since_after(2, graph.nodes_started, base) == ('launching', 1)    # it has no process yet
    assert since_after(3, graph.launched, base, 42) == ('launching', 3)
    assert since_after(4, graph.nodes_started, base) == ('running', 4)
    assert since_after(5, graph.nodes_started, base) == ('running', 4)
    assert since_after(6, graph.noted, base, '/node', 'ended', False) == ('running', 4)
    assert since_after(7, graph.noted, base, '/node', 'died', True) == ('degraded', 7)
    assert since_after(8, graph.noted, base, '/other', 'died', True) == ('degraded', 7)
    assert since_after(8, graph.nodes_started, base) == ('degraded', 7)
    assert base.notes == {'/node': 'died', '/other': 'died'}
    assert since_after(9, graph.restart, ['Base']) == ('stopping', 9)
    assert (graph.current('Base').state.value, graph.current('Base').since) == ('waiting', 9)
    assert since_after(10, graph.noted, base, '/node', 'died again', True) == ('stopping', 9)


def test_a_failure_says_when_the_instance_had_gone():
    now = [0.0]
    graph = Graph(lambda: now[0])
    base, nav = new_instance('Base'), new_instance('Nav', ['Base'])
    graph.start('Nav', [base, nav])
    graph.launched(base, 1)
    graph.launched(nav, 2)
    for now[0], instance in (5.0, base), (8.0, nav):
        graph.ended(instance, 1, 'exit 1')
    assert {name: failure.since for name, failure in graph.failures.items()} == {
        'Base': 5.0, 'Nav': 8.0}
    assert graph.failures['Nav'].text == 'Base, which it depends on, ended'


def test_when_the_server_ends_nothing_more_is_started_or_stopped_one_by_one(robot):
    robot.start('Nav')
    mark = len(robot.told)
    assert not robot.graph.ends
    robot.graph.end()
    assert robot.graph.ends
    robot.carry_out()
    assert robot.since(mark) == [('stopped', 'Nav'), ('stopped', 'Base')]
    assert robot.told_to_stop == []
    with pytest.raises(RefusedRequest, match='the capability server ends'):
        robot.start('Base')
    with pytest.raises(RefusedRequest, match='the capability server ends'):
        robot.use('Base')
    for instance in list(robot.processes.values()):
        robot.end(instance)
    assert robot.graph.failures == {} and robot.states() == {}


def test_a_use_needs_a_bond(robot):
    with pytest.raises(RefusedRequest, match="Invalid bond_id given to ~use_capability: 'x'"):
        robot.use('Base', 'x')
    robot.graph.bond_broken('one')
    with pytest.raises(RefusedRequest, match="Invalid bond_id given to ~use_capability: 'one'"):
        robot.use('Base', 'one')
    assert robot.states() == {}


def test_failures_are_forgotten_with_their_interfaces(robot):
    robot.graph.could_not_start('Gone', '', 'no package exports this capability')
    robot.graph.could_not_start('Base', 'base', 'ambiguous')
    robot.graph.forget_failures(['Base'])
    assert set(robot.graph.failures) == {'Base'}
