"""What a start would do beside what runs already, and the error that refuses it."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Dict, List, Optional, Set, Tuple

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_packages import make_package

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.providers import (
    PlannedProvider, RunningProvider, StartPlan, error_text, plan_for_capabilities, plan_start)
from capabilities.spec_index import SpecIndex
from capabilities.specs.interface import CapabilityInterface
from capabilities.specs.provider import CapabilityProvider
from capabilities.specs.semantic_interface import SemanticCapabilityInterface
from rocon_uri.sources.launch_file import LaunchFiles

GOOD = '<launch/>'


def spec_index(*lines: str, folder: str = '') -> SpecIndex:
    """
    The index of the package p, of one line each:

    - 'Interface', or 'Semantic>Interface' for a semantic interface that redefines one
    - 'name Interface need ...' for a provider; a need is an interface, Interface=provider where one
      is preferred, @file for its launch file, or ! where it has a nodelet manager

    Interfaces that a provider implements are added by themselves.
    """
    index = SpecIndex()
    semantic = {line.partition('>')[0]: line.partition('>')[2] for line in lines if '>' in line}
    for line in lines:
        name = line.split()[:2][-1]
        if '>' not in name and name not in semantic and 'p/' + name not in index.names:
            index.add_interface(CapabilityInterface(name, 1), 'f', 'p')
    for name, redefined in semantic.items():
        index.add_semantic_interface(
            SemanticCapabilityInterface(name, 'p/' + redefined, 1), 'f', 'p')
    for line in lines:
        words = line.split()
        if len(words) > 1:
            provider = CapabilityProvider(words[0], 1, 'p/' + words[1])
            for word in words[2:]:
                if word.startswith('@'):
                    provider.launch_file = word[1:]
                elif word == '!':
                    provider.nodelet_manager = 'manager'
                else:
                    interface, _, preferred = word.partition('=')
                    provider.add_depends_on('p/' + interface,
                                            'p/' + preferred if preferred else None)
            index.add_provider(provider, os.path.join(folder, words[0] + '.yaml'), 'p')
    return index


def running(*texts: str) -> List[RunningProvider]:
    """Of 'Interface provider', with @file for the launch file and - where it stops."""
    found = []
    for text in texts:
        capability, provider, *rest = text.split()
        launch_file = next((word[1:] for word in rest if word.startswith('@')), None)
        found.append(RunningProvider('p/' + capability, 'p/' + provider, launch_file, '-' in rest))
    return found


def steps(plan: StartPlan) -> List[str]:
    """Each as 'Interface provider', with a + behind it where it runs already."""
    return ['%s %s%s' % (step.capability[2:], step.provider[2:], ' +' if step.running else '')
            for step in plan.steps]


def reasons(plan: StartPlan) -> List[str]:
    return [fault.reason for fault in plan.faults]


ROBOT = spec_index('nav Nav Base Laser', 'base Base Motor', 'laser Laser Motor', 'motor Motor')


# The steps

def test_each_step_says_what_it_depends_on_and_who_needs_it_first() -> None:
    plan = plan_start(ROBOT, 'p/Nav')
    assert plan.can_start
    assert plan.steps == (
        PlannedProvider('p/Motor', 'p/motor', False, required_by='p/base'),
        PlannedProvider('p/Base', 'p/base', False, None, ('p/Motor',), 'p/nav'),
        PlannedProvider('p/Laser', 'p/laser', False, None, ('p/Motor',), 'p/nav'),
        PlannedProvider('p/Nav', 'p/nav', False, None, ('p/Base', 'p/Laser')))
    assert plan.order == ['p/motor', 'p/base', 'p/laser', 'p/nav']


@pytest.mark.parametrize('runs, expected', [
    ([], ['Motor motor', 'Base base', 'Laser laser', 'Nav nav']),
    (['Base base'], ['Base base +', 'Motor motor', 'Laser laser', 'Nav nav']),
    (['Base other'], ['Base other +', 'Motor motor', 'Laser laser', 'Nav nav']),
    (['Base base', 'Laser laser'], ['Base base +', 'Laser laser +', 'Nav nav']),
    (['Nav nav'], ['Nav nav +']),
    (['Nav gone'], ['Nav gone +']),
    (['Base base -'], ['Motor motor', 'Base base', 'Laser laser', 'Nav nav']),
])
def test_what_runs_is_shared_whatever_its_provider(runs: List[str], expected: List[str]) -> None:
    plan = plan_start(ROBOT, 'p/Nav', running=running(*runs))
    assert plan.can_start
    assert steps(plan) == expected
    assert plan.order == ['p/' + line.split()[1] for line in expected if not line.endswith('+')]


@pytest.mark.parametrize('lines', [
    ['nav Nav Base', 'Base'],                       # no provider
    ['nav Nav Base', 'a Base', 'b Base'],           # ambiguous
    ['nav Nav Base=none', 'a Base'],                # no such provider
    ['nav Nav Base=nav', 'a Base'],                 # one of something else
    ['nav Nav Base', 'a Base Nothing'],             # something is missing below
    ['nav Nav Base', 'a Base Nav'],                 # a cycle
    ['nav Nav Base'],                               # the interface left the index
])
def test_no_fault_is_looked_for_at_or_below_what_runs(lines: List[str]) -> None:
    index = spec_index(*lines)
    assert not plan_start(index, 'p/Nav').can_start
    plan = plan_start(index, 'p/Nav', running=running('Base a'))
    assert (reasons(plan), steps(plan)) == ([], ['Base a +', 'Nav nav'])


@pytest.mark.parametrize('lines', [['a Nav', 'b Nav'], ['Nav'], ['Base']])
def test_what_runs_is_shared_where_nothing_could_be_chosen(lines: List[str]) -> None:
    index = spec_index(*lines)
    assert not plan_start(index, 'p/Nav').can_start
    plan = plan_start(index, 'p/Nav', running=running('Nav a'))
    assert (reasons(plan), steps(plan)) == ([], ['Nav a +'])


def test_without_a_preference_what_runs_is_shared_before_the_default() -> None:
    index = spec_index(*CAMERAS, 'camera Camera')
    plan = plan_start(index, 'p/Camera', None, {'p/Camera': 'p/front'},
                      running('Camera camera', 'Front front'))
    assert steps(plan) == ['Camera camera +']


def test_a_provider_that_is_asked_for_has_to_be_there_even_where_another_runs() -> None:
    for preferred in 'p/none', 'p/base':
        plan = plan_start(ROBOT, 'p/Nav', preferred, running=running('Nav nav'))
        assert error_text(plan).startswith(
            "Capability Provider '%s' not found for Capability 'p/Nav' " % preferred)
    assert steps(plan_start(ROBOT, 'p/Nav', 'p/nav', running=running('Nav other'))) == [
        'Nav other +']


def test_an_empty_preference_is_none() -> None:
    assert plan_start(ROBOT, 'p/Nav', '') == plan_start(ROBOT, 'p/Nav', None)


def test_layers_of_diamonds_are_walked_once() -> None:
    """Each of 300 layers depends on both of the next: 2^300 ways lead down."""
    lines = ['%s%d %s%d %s' % (side, n, side.upper(), n, 'L%d R%d' % (n + 1, n + 1) * (n < 299))
             for n in range(300) for side in 'lr']
    plan = plan_start(spec_index(*lines), 'p/L0')
    assert plan.can_start and len(plan.order) == 599


@settings(deadline=None)
@given(st.lists(st.lists(st.integers(1, 6), max_size=3), min_size=8, max_size=8),
       st.sets(st.integers(0, 7)))
def test_what_starts_is_what_is_needed_and_does_not_run(
        offsets: List[List[int]], runs: Set[int]) -> None:
    """Against a model: capability n depends on some with greater numbers, and some run."""
    below = [sorted({n + offset for offset in found if n + offset < 8})
             for n, found in enumerate(offsets)]

    def needed(n: int) -> Set[int]:
        return {n}.union(*(needed(other) for other in below[n] if n not in runs))
    index = spec_index(*('x%d X%d %s' % (n, n, ' '.join('X%d' % other for other in found))
                         for n, found in enumerate(below)))
    plan = plan_start(index, 'p/X0', running=running(*('X%d y%d' % (n, n) for n in sorted(runs))))
    assert plan.can_start
    found = [int(step.capability[-1]) for step in plan.steps]
    assert len(found) == len(set(found)) and found[-1] == 0 and set(found) == needed(0)
    for place, step in enumerate(plan.steps):
        number = found[place]
        assert step.running == (number in runs)
        assert step.provider == 'p/%s%d' % ('y' if step.running else 'x', number)
        depends_on = [int(name[-1]) for name in step.depends_on]
        assert depends_on == ([] if step.running else below[number])
        assert set(depends_on) <= set(found[:place])
        assert (step.required_by is None) == (number == 0)
        assert step.required_by is None or number in below[int(step.required_by[-1])]


# Semantic interfaces

CAMERAS = ('Front>Camera', 'front Front', 'View')


@pytest.mark.parametrize('lines, capability, preferred, defaults, runs, expected', [
    (['camera Camera'], 'Camera', 'front', None, [], ['Front front']),
    (['camera Camera'], 'Camera', None, 'front', [], ['Front front']),
    (['camera Camera'], 'Camera', None, None, [], ['Camera camera']),
    (['view View Camera=front', 'Camera'], 'View', None, None, [], ['Front front', 'View view']),
    (['camera Camera'], 'Front', None, None, [], ['Front front']),
    # What runs is shared under the semantic name, else under that of the interface.
    (['camera Camera'], 'Camera', 'front', None, ['Front front'], ['Front front +']),
    (['camera Camera'], 'Camera', 'front', None, ['Camera camera'], ['Camera camera +']),
    (['camera Camera'], 'Camera', 'front', None, ['Camera camera', 'Front front'],
     ['Front front +']),
    (['camera Camera'], 'Camera', None, 'front', ['Front front'], ['Front front +']),
    # The other way round both run.
    (['camera Camera'], 'Camera', 'camera', None, ['Front front'], ['Camera camera']),
    (['camera Camera'], 'Camera', None, None, ['Front front'], ['Camera camera']),
    (['camera Camera'], 'Front', None, None, ['Camera camera'], ['Front front']),
])
def test_a_provider_of_a_semantic_interface_is_one_where_it_is_named(
        lines: List[str], capability: str, preferred: Optional[str], defaults: Optional[str],
        runs: List[str], expected: List[str]) -> None:
    index = spec_index(*CAMERAS, *lines)
    plan = plan_start(index, 'p/' + capability, preferred and 'p/' + preferred,
                      {'p/Camera': 'p/' + defaults} if defaults else None, running(*runs))
    assert (reasons(plan), steps(plan)) == ([], expected)


def test_the_dependent_depends_on_the_semantic_instance() -> None:
    index = spec_index(*CAMERAS, 'Camera', 'view View Camera=front')
    assert plan_start(index, 'p/View').steps[-1].depends_on == ('p/Front',)


def test_the_plan_names_both_capabilities_and_for_each_the_provider_that_was_chosen_first() -> None:
    index = spec_index(*CAMERAS, 'camera Camera', 'view View Camera=front', 'nav Nav View Camera')
    plan = plan_start(index, 'p/Nav')
    assert plan.can_start and plan.order == ['p/front', 'p/view', 'p/camera', 'p/nav']
    assert plan.providers == {'p/Nav': 'p/nav', 'p/View': 'p/view', 'p/Camera': 'p/front',
                              'p/Front': 'p/front'}
    assert set(plan.dependencies) == {'p/nav', 'p/view', 'p/front', 'p/camera'}


def test_it_is_never_picked_unnamed_but_mentioned() -> None:
    index = spec_index(*CAMERAS, 'Camera', 'rear Front')
    [fault] = plan_start(index, 'p/Camera').faults
    assert fault.kind is FaultKind.NO_PROVIDER
    assert fault.semantic_candidates == ('p/front', 'p/rear')
    assert str(fault) == (
        "capability 'p/Camera': no provider implements it (those of semantic interfaces that "
        "redefine it have to be named: 'p/front', 'p/rear')")


def test_a_provider_of_the_interface_is_none_of_the_semantic_one() -> None:
    index = spec_index(*CAMERAS, 'camera Camera')
    [fault] = plan_start(index, 'p/Front', 'p/camera').faults
    assert fault.kind is FaultKind.WRONG_PROVIDER and fault.implements == 'p/Camera'


# Conflicts

@pytest.mark.parametrize('lines, conflict', [
    (['nav Nav A B', 'a A Camera=left', 'b B Camera=right', 'left Camera', 'right Camera'],
     ('p/left', 'p/right')),
    (['nav Nav A B', 'a A Camera=left', 'b B Camera', 'left Camera'], None),
    (['nav Nav A B', 'a A Camera=front', 'b B Camera', 'camera Camera', 'Front>Camera',
      'front Front'], None),        # both run: one as Front, one as Camera
    (['nav Nav A B', 'a A Camera=front', 'b B Camera=camera', 'camera Camera', 'Front>Camera',
      'front Front'], ('p/camera', 'p/front')),     # two preferences for one capability
    (['nav Nav A B', 'a A Camera=front', 'b B Camera=rear', 'Camera', 'Front>Camera',
      'front Front', 'rear Front'], ('p/front', 'p/rear')),
    (['nav Nav A B C', 'a A Camera=left', 'b B Camera=front', 'c C Camera=right', 'left Camera',
      'right Camera', 'Front>Camera', 'front Front'], ('p/left', 'p/right', 'p/front')),
])
def test_two_preferences_for_one_capability_are_a_conflict(
        lines: List[str], conflict: Optional[Tuple[str, ...]]) -> None:
    faults = plan_start(spec_index(*lines), 'p/Nav').faults
    assert [fault.kind for fault in faults][:1] == [FaultKind.CONFLICT][:conflict is not None]
    assert faults == [] or faults[0].candidates == conflict


def test_a_preference_beside_a_default_is_a_conflict() -> None:
    index = spec_index('nav Nav A B', 'a A Camera=left', 'b B Camera', 'left Camera',
                       'right Camera')
    [fault] = plan_start(index, 'p/Nav', defaults={'p/Camera': 'p/right'}).faults
    assert (fault.kind, fault.candidates) == (FaultKind.CONFLICT, ('p/left', 'p/right'))


def test_what_runs_conflicts_with_no_preference() -> None:
    index = spec_index('nav Nav A B', 'a A Camera=left', 'b B Camera=right', 'left Camera',
                       'right Camera')
    assert plan_start(index, 'p/Nav', running=running('Camera other')).can_start


# Launching

@pytest.fixture
def ours(tmp_path: Path) -> Path:
    """A package with some launch files."""
    return make_package(tmp_path, 'p', good_launch=GOOD, other_launch=GOOD, text_launch='<launch>',
                        robot_launch='<robot/>')


@pytest.mark.parametrize('launch_file, kind, text', [
    ('godo.launch', 'launch-missing',
     "launch file 'godo.launch' does not exist (did you mean 'good.launch'?)"),
    ('../other.launch', 'launch-outside', "launch file '../other.launch' is outside the package"),
    ('.', 'launch-unreadable', "launch file '.' is not a file"),
    ('text.launch', 'launch-not-xml',
     "launch file 'text.launch' is not XML: no element found (line 1, column 9)"),
    ('robot.launch', 'launch-no-launch',
     "launch file 'robot.launch' has '<robot>' at its top, expected <launch> (line 1, column 1)"),
])
def test_a_launch_file_that_cannot_be_started_is_a_fault(
        ours: Path, launch_file: str, kind: str, text: str) -> None:
    index = spec_index('nav Nav Base @good.launch', 'base Base @' + launch_file, folder=str(ours))
    plan = plan_start(index, 'p/Nav', launch_files=LaunchFiles())
    [fault] = plan.faults
    assert fault.kind.value == kind
    assert (fault.capability, fault.provider, fault.asked_for) == ('p/Base', 'p/base', 'p/Nav')
    assert str(fault) == "provider 'p/base': " + text
    assert error_text(plan) == (
        "capability 'p/Nav' cannot be started: provider 'p/base': " + text)
    data = fault.to_dict()
    assert data['launch_file'] == os.path.join(str(ours), launch_file)
    assert text.endswith('(line %s, column %s)' % (data['line'], data['column'])) \
        or (data['line'], data['column']) == (None, None) and 'column' not in text
    assert plan_start(index, 'p/Nav').can_start
    assert plan_start(index, 'p/Nav', running=running('Base base'),
                      launch_files=LaunchFiles()).can_start


def test_each_step_has_its_launch_file(ours: Path) -> None:
    (ours / 'link.launch').symlink_to('good.launch')
    index = spec_index('nav Nav Base @link.launch', 'base Base', folder=str(ours))
    plan = plan_start(index, 'p/Nav', launch_files=LaunchFiles())
    assert [step.launch_file for step in plan.steps] == [
        None, os.path.realpath(str(ours / 'good.launch'))]


@pytest.mark.parametrize('lines, runs, text', [
    (['nav Nav Base @good.launch', 'base Base @good.launch'], [],
     "providers 'p/base' and 'p/nav' have one launch file, which cannot run twice: "),
    (['nav Nav Base @good.launch', 'base Base @./link.launch'], [],
     "providers 'p/base' and 'p/nav' have one launch file, which cannot run twice: "),
    (['nav Nav @good.launch'], ['Base base @'],
     "provider 'p/nav' has the launch file of 'p/base', which runs already: "),
    (['arm Nav @good.launch'], ['Base base @'],
     "provider 'p/arm' has the launch file of 'p/base', which runs already: "),
    (['nav Nav Arm @good.launch', 'arm Arm @good.launch'], ['Base base @'],
     "providers 'p/arm' and 'p/nav' have the launch file of 'p/base', which runs already: "),
    (['nav Nav @good.launch'], ['Base base @ -'],
     "provider 'p/nav' has the launch file of 'p/base', which runs already: "),
    (['nav Nav @good.launch'], ['Base base @ -', 'Base legs @'],
     "provider 'p/nav' has the launch file of 'p/base', which runs already: "),
    (['nav Nav @good.launch'], ['Nav nav @ -'], None),      # an earlier instance of the same
    (['nav Nav Base @good.launch', 'base Base'], [], None),
    (['nav Nav Base', 'base Base'], ['Other other'], None),     # none of them has one
    (['nav Nav Base @good.launch', 'base Base @good.launch'], ['Base base'], None),
    (['nav Nav Base @none', 'base Base @none'], [], None),      # missing, which is fault enough
])
def test_one_launch_file_cannot_run_twice(
        ours: Path, lines: List[str], runs: List[str], text: Optional[str]) -> None:
    (ours / 'link.launch').symlink_to('good.launch')
    path = os.path.realpath(str(ours / 'good.launch'))
    plan = plan_start(spec_index(*lines, folder=str(ours)), 'p/Nav', None, None,
                      running(*(one.replace('@', '@' + path) for one in runs)), LaunchFiles())
    shared = [fault for fault in plan.faults if fault.kind is FaultKind.LAUNCH_SHARED]
    assert [str(fault) for fault in shared] == ([] if text is None else [text + repr(path)])


def test_what_runs_may_be_any_iterable(ours: Path) -> None:
    index = spec_index('nav Nav Base @good.launch', 'base Base', folder=str(ours))
    runs = running('Base base @' + os.path.realpath(str(ours / 'good.launch')))
    plan = plan_start(index, 'p/Nav', running=iter(runs), launch_files=LaunchFiles())
    assert steps(plan) == ['Base base +', 'Nav nav']
    [fault] = plan.faults
    assert (fault.running, fault.sharers) == ('p/base', ('p/base', 'p/nav'))


def test_a_provider_that_needs_a_nodelet_manager_is_refused_without_one() -> None:
    index = spec_index('nav Nav Base', 'base Base !')
    assert plan_start(index, 'p/Nav').can_start
    plan = plan_start(index, 'p/Nav', nodelet_manager=False)
    assert error_text(plan) == (
        "capability 'p/Nav' cannot be started: provider 'p/base': it needs a nodelet manager, and "
        'the capability server has none')
    assert plan.faults[0].kind.value == 'no-nodelet-manager'
    assert plan_start(index, 'p/Nav', running=running('Base base'),
                      nodelet_manager=False).can_start


def test_a_plan_is_made_again_without_reading(ours: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    index = spec_index('nav Nav Base @good.launch', 'base Base @text.launch', folder=str(ours))
    files = LaunchFiles()
    assert plan_start(index, 'p/Nav', launch_files=files.remembered()).unread == (
        str(ours / 'text.launch'), str(ours / 'good.launch'))
    plan = plan_start(index, 'p/Nav', launch_files=files)
    assert plan.unread == () and len(plan.faults) == 1

    def no_disk(*_: Any, **__: Any) -> Any:
        raise AssertionError('the disk is touched')
    for name in 'stat', 'lstat', 'open', 'listdir', 'readlink':
        monkeypatch.setattr(os, name, no_disk)
    again = plan_start(index, 'p/Nav', launch_files=files.remembered())
    assert again == plan and error_text(again) == error_text(plan)


def test_all_faults_stand_in_an_order_that_does_not_change(ours: Path) -> None:
    index = spec_index(
        'nav Nav A B C D E @good.launch', 'a A Camera=left Nothing', 'b B Camera=right',
        'left Camera @none.launch', 'right Camera @text.launch', 'c C D', 'd D C',
        'e E @other.launch !', 'B2', folder=str(ours))
    plan = plan_start(index, 'p/Nav', None, None,
                      running('Z z @' + os.path.realpath(str(ours / 'other.launch'))),
                      LaunchFiles(), nodelet_manager=False)
    assert [fault.kind.value for fault in plan.faults] == [
        'no-interface', 'conflict', 'cycle', 'launch-missing', 'launch-not-xml',
        'no-nodelet-manager', 'launch-shared']
    assert error_text(plan) == '; '.join(reasons(plan))
    assert plan == plan_start(index, 'p/Nav', None, None,
                              running('Z z @' + os.path.realpath(str(ours / 'other.launch'))),
                              LaunchFiles(), nodelet_manager=False)


def test_a_fault_of_what_is_needed_twice_is_one() -> None:
    plan = plan_for_capabilities(spec_index('a A', 'b A'), ['p/A', 'p/B', 'p/A', 'p/B'])
    assert [fault.kind.value for fault in plan.faults] == ['ambiguous', 'no-interface']


def test_an_app_may_need_what_shares_a_launch_file(ours: Path) -> None:
    index = spec_index('a A @good.launch', 'b B @good.launch', folder=str(ours))
    [fault] = plan_for_capabilities(index, ['p/A', 'p/B'], None, LaunchFiles()).faults
    assert fault.kind is FaultKind.LAUNCH_SHARED and fault.sharers == ('p/a', 'p/b')
    assert (fault.capability, fault.provider, fault.asked_for) == ('p/B', 'p/b', 'p/B')


# The texts by which clients recognise errors

@pytest.mark.parametrize('lines, capability, preferred, defaults, text', [
    (['nav Nav'], 'Nov', None, {}, "Capability 'p/Nov' not found. capability 'p/Nov': no package "
     "exports this capability (did you mean 'p/Nav'?)"),
    (['nav Nav'], '', None, {}, "Capability 'p/' not found. capability 'p/': no package exports "
     'this capability'),
    (['nav Nav'], 'Nov', 'nav', {}, "Capability 'p/Nov' not found. capability 'p/Nov': no package "
     "exports this capability (did you mean 'p/Nav'?)"),
    (['navi Nav'], 'Nav', 'nawi', {}, "Capability Provider 'p/nawi' not found for Capability "
     "'p/Nav' capability 'p/Nav': no package exports the preferred provider 'p/nawi' (did you "
     "mean 'p/navi'?)"),
    (['nav Nav', 'base Base'], 'Nav', 'base', {}, "Capability Provider 'p/base' not found for "
     "Capability 'p/Nav' capability 'p/Nav': the preferred provider 'p/base' implements 'p/Base' "
     'instead'),
    (['nav Nav Base=zzz', 'base Base'], 'Nav', None, {}, "Capability Provider 'p/zzz' not found "
     "capability 'p/Nav' cannot be started: provider 'p/nav' depends on 'p/Base': no package "
     "exports the preferred provider 'p/zzz'"),
    (['nav Nav Base=nav', 'base Base'], 'Nav', None, {}, "capability 'p/Nav' cannot be started: "
     "provider 'p/nav' depends on 'p/Base': the preferred provider 'p/nav' implements 'p/Nav' "
     'instead'),
    (['a Nav', 'b Nav'], 'Nav', None, {}, "capability 'p/Nav': several providers implement it, "
     "and none is the default: 'p/a', 'p/b'"),
    (['a Nav', 'b Nav'], 'Nav', None, {'p/Nav': 'p/zzz'}, "capability 'p/Nav': no package exports "
     "the default provider 'p/zzz'"),
    (['nav Nav Base', 'base Base Nav'], 'Nav', None, {}, "capability 'p/Nav' cannot be started: "
     'providers depend on each other in a cycle: p/nav -> p/base -> p/nav'),
    (['nav Nav Mep Map', 'Map'], 'Nav', None, {}, "capability 'p/Nav' cannot be started: provider "
     "'p/nav' depends on 'p/Mep': no package exports this capability (did you mean 'p/Map'?); "
     "capability 'p/Nav' cannot be started: provider 'p/nav' depends on 'p/Map': no provider "
     'implements it'),
])
def test_the_error_of_a_plan(lines: List[str], capability: str, preferred: Optional[str],
                             defaults: Dict[str, str], text: str) -> None:
    plan = plan_start(spec_index(*lines), 'p/' + capability, preferred and 'p/' + preferred,
                      defaults)
    assert error_text(plan) == text


@pytest.mark.parametrize('text', ['', 'x' * 1000000, 'a\nb\0c', '\ud800', "'; p/Nav", '../..'])
def test_any_text_may_be_asked_for(text: str) -> None:
    for plan in plan_start(ROBOT, text), plan_start(ROBOT, 'p/Nav', text or 'x'):
        error = error_text(plan)
        assert error.isprintable() and 0 < len(error) < 1000


def test_near_misses_are_looked_for_as_long_as_it_does_not_take_long() -> None:
    many = ['X%d' % n for n in range(1500)]
    index = spec_index(*many, 'nav Nav Y1 Y2 Y3 Y4 Y5')
    faults = plan_start(index, 'p/Nav').faults
    assert [bool(fault.suggestions) for fault in faults] == [True] * 3 + [False] * 2


def test_a_plan_makes_no_dict_or_list_of_all_specs(monkeypatch: pytest.MonkeyPatch) -> None:
    index = spec_index('Camera', 'Front>Camera', 'base Base Map', 'nav Nav Base Camera=front No',
                       'front Front', 'map Map')

    def fail(index: SpecIndex) -> None:
        raise AssertionError('this grows with all that there is')

    for name in ('names', 'specs', *(kind + view for kind in ('interface', 'semantic_interface',
                                                              'provider')
                                     for view in ('s', '_names', '_paths'))):
        monkeypatch.setattr(SpecIndex, name, property(fail))
    plan = plan_start(index, 'p/Nav')
    assert [fault.kind for fault in plan.faults] == [FaultKind.NO_INTERFACE]
    assert plan.order == ['p/map', 'p/base', 'p/front', 'p/nav']


def test_kinds_are_ids_in_kebab_case() -> None:
    for kind in FaultKind:
        assert all(word.isalpha() and word.islower() for word in kind.value.split('-'))


def test_a_fault_is_a_value() -> None:
    one = Fault(FaultKind.NO_PROVIDER, 'p/A', 'p/A', known=['p/B'])
    assert one == Fault(FaultKind.NO_PROVIDER, 'p/A', 'p/A') and len({one, one}) == 1
    assert repr(one) == "<Fault capability 'p/A': no provider implements it>"
