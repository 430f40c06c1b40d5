"""Rapps: found, read, given what their parents have, and judged against a robot."""
from __future__ import annotations

import contextlib
import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from made_packages import make_package
from sources import ROOT

from capabilities.discovery import (
    package_index_from_package_path,
    spec_file_index_from_package_index,
    spec_index_from_spec_file_index,
)
from capabilities.planning.faults import FaultKind
from capabilities.spec_index import SpecIndex
from rocon_uri import RoconURIValueError, Vocabulary, parse
from rocon_uri.apps.rapps import (
    InvalidRapp, ReasonKind, rapp_from_string, rapps_from_package_index, runnable, with_inheritance)

EXAMPLES = ROOT / 'examples' / 'workspace'
CORPUS = os.environ.get('ROCON_URI_CORPUS')
needs_corpus = pytest.mark.skipif(not CORPUS, reason='ROCON_URI_CORPUS is not set')

ROBOT = 'rocon:/kobuki/bob/noetic/focal'


def read(text, name='ours/dance'):
    return rapp_from_string(text, name, 'ours/rapps/%s.rapp' % name.partition('/')[2])


def family(**texts):
    """Rapps of the package ours by their own names, with what they inherit."""
    rapps, errors = with_inheritance(
        [read(text, 'ours/' + name) for name, text in texts.items()])
    return {rapp.name.partition('/')[2]: rapp for rapp in rapps.values()}, errors


# Reading

def test_all_that_a_rapp_says_is_there():
    rapp = read('''
        display: Dance
        description: Dances
        icon: ../dance.png
        compatibility: rocon:/pr2
        launch: dance.launch
        parent_name: theirs/motion
        public_interface: dance.interface
        public_parameters: dance.parameters
        required_capabilities:
          - name: std_capabilities/DifferentialMobileBase
            interface:
              topics:
                requires: {/cmd_vel: dance/velocity}
                provides: []
              services: {requires: {reset: dance/reset}}
        cardinality: 3
        ''')
    assert rapp.name == 'ours/dance' and rapp.package == 'ours'
    assert (rapp.display, rapp.description, rapp.icon) == ('Dance', 'Dances', '../dance.png')
    assert (rapp.compatibility, rapp.launch) == ('rocon:/pr2', 'dance.launch')
    assert (rapp.public_interface, rapp.public_parameters) == ('dance.interface',
                                                               'dance.parameters')
    assert rapp.parent_name == 'theirs/motion'
    (capability,) = rapp.required_capabilities
    assert capability.name == 'std_capabilities/DifferentialMobileBase'
    assert capability.remappings == {'topics': {'/cmd_vel': 'dance/velocity'},
                                     'services': {'reset': 'dance/reset'}}
    assert rapp.others == {'cardinality': 3}
    assert rapp.files == {
        'icon': 'ours/dance.png', 'launch': 'ours/rapps/dance.launch',
        'public_interface': 'ours/rapps/dance.interface',
        'public_parameters': 'ours/rapps/dance.parameters'}
    assert rapp.position('launch') == (6, 17)


def test_what_a_rapp_does_not_say_it_has_not():
    rapp = read('{}')
    assert rapp.display is rapp.launch is rapp.parent_name is None
    assert rapp.required_capabilities == () and rapp.files == {}
    assert rapp.position('launch') == (None, None)


@pytest.mark.parametrize('text, is_implementation, is_ancestor', [
    ('{compatibility: "rocon:/", launch: dance.launch}', True, True),
    ('{compatibility: "rocon:/", launch: dance.launch, parent_name: motion}', True, False),
    ('compatibility: rocon:/', False, True),
    ('launch: dance.launch', False, True),
    ('{compatibility: "rocon:/", launch: }', False, True),
    ('parent_name: motion', False, False),
    ('display: Dance', False, True),
])
def test_an_implementation_has_compatibility_and_launch_an_ancestor_no_parent(
        text, is_implementation, is_ancestor):
    rapp = read(text)
    assert (rapp.is_implementation, rapp.is_ancestor) == (is_implementation, is_ancestor)


def test_a_parent_without_a_package_is_of_the_same_one():
    assert read('parent_name: motion').parent_name == 'ours/motion'


@pytest.mark.parametrize('text, error', [
    ('', '1:1: the rapp is empty, expected a mapping'),
    ('- display', '1:1: the rapp is a list, expected a mapping'),
    ('display: [', '2:1: did not find expected node content while parsing a flow node'),
    ('display: 2048', '1:10: display is 2048, expected text'),
    ('launch: [dance.launch]', '1:9: launch is a list, expected text'),
    ('launch: ""', '1:9: launch is empty, expected text'),
    ('icon: {a: b}', '1:7: icon is a mapping, expected text'),
    ('display: a\ndisplay: b', "2:1: duplicate key 'display'"),
    ('required_capabilities: base', "1:24: required_capabilities is 'base', expected a list"),
    ('required_capabilities:\n- base',
     "2:3: a required capability is 'base', expected a mapping with a name"),
    ('required_capabilities:\n- interface: {}', '2:3: a required capability has no name'),
    ('required_capabilities: [{name: 7}]', '1:32: name is 7, expected text'),
    ('required_capabilities: [{name: a/b, interface: 7}]',
     '1:48: interface is 7, expected a mapping'),
    ('required_capabilities: [{name: a/b, interface: {topics: [scan]}}]',
     '1:57: topics is a list, expected a mapping'),
    ('required_capabilities: [{name: a/b, interface: {topics: {requires: {scan: 7}}}}]',
     "1:75: the new name of 'scan' is 7, expected text"),
    ('required_capabilities: [{name: a/b, interface: {topics: {requires: {scan: }}}}]',
     "1:75: the new name of 'scan' is empty, expected text"),
    ('required_capabilities: [{name: a/b, interface: {topics: {requires: {7: scan}}}}]',
     '1:69: the name of a remapping is 7, expected text'),
])
def test_what_is_no_rapp_is_refused_with_the_place(text, error):
    with pytest.raises(InvalidRapp) as caught:
        read(text)
    assert str(caught.value) == 'ours/rapps/dance.rapp:' + error


yaml_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=8),
    lambda below: st.lists(below, max_size=3) | st.dictionaries(
        st.sampled_from(['name', 'interface', 'topics', 'requires', 'provides', 'x']), below,
        max_size=3), max_leaves=8)


@given(st.dictionaries(st.sampled_from([
    'display', 'icon', 'launch', 'compatibility', 'parent_name', 'required_capabilities', 'more']),
    yaml_values, max_size=4))
def test_any_mapping_is_a_rapp_or_is_refused(data):
    import json
    try:
        rapp = read(json.dumps(data))
    except InvalidRapp as error:
        assert error.line is not None
    else:
        assert all(isinstance(capability.name, str) for capability in rapp.required_capabilities)


@given(st.binary(max_size=40))
def test_any_bytes_are_a_rapp_or_are_refused(content):
    with contextlib.suppress(InvalidRapp):
        read(content)


# Inheritance

def test_a_child_inherits_what_it_does_not_say():
    rapps, errors = family(
        motion='{display: Motion, description: Moves, icon: i/motion.png, '
               'public_interface: motion.interface, public_parameters: motion.parameters, '
               'compatibility: "rocon:/", launch: motion.launch, cardinality: 1}',
        dance='{parent_name: motion, display: Dance, public_parameters: }')
    assert errors == []
    dance = rapps['dance']
    assert (dance.display, dance.description) == ('Dance', 'Moves')
    assert (dance.public_interface, dance.public_parameters) == ('motion.interface',
                                                                 'motion.parameters')
    assert dance.compatibility is dance.launch is None and dance.others == {}


def test_an_empty_description_is_one():
    rapps, _ = family(motion='description: Moves', dance='{parent_name: motion, description: ""}')
    assert rapps['dance'].description == ''


def test_what_is_inherited_comes_through_all_generations():
    rapps, _ = family(waltz='{parent_name: dance, icon: waltz.png}', dance='parent_name: motion',
                      motion='{display: Motion, icon: motion.png}')
    assert (rapps['waltz'].display, rapps['waltz'].icon) == ('Motion', 'waltz.png')


def test_an_inherited_file_is_relative_to_the_parent():
    motion = rapp_from_string('icon: i/motion.png', 'theirs/motion', '/theirs/motion.rapp')
    dance = rapp_from_string('parent_name: theirs/motion', 'ours/dance', '/ours/dance.rapp')
    rapps, _ = with_inheritance([dance, motion])
    assert rapps['ours/dance'].files == {'icon': '/theirs/i/motion.png'}


def test_near_misses_of_many_missing_parents_are_looked_for_as_long_as_it_does_not_take_long():
    texts = {'dance_%d' % number: 'parent_name: moton_%d' % number for number in range(100)}
    texts.update(('motion_%d' % number, '{}') for number in range(300))
    _, errors = family(**texts)
    assert len(errors) == 100
    assert "(did you mean 'ours/motion_7' or" in str(errors[7])
    assert ['did you mean' in str(error) for error in errors] == [True] * 50 + [False] * 50


def test_a_missing_parent_is_an_error_of_that_rapp_alone():
    rapps, errors = family(dance='\nparent_name: ours/motoin', motion='{}',
                           waltz='parent_name: dance')
    assert set(rapps) == {'motion', 'waltz'}
    assert list(map(str, errors)) == [
        "ours/rapps/dance.rapp:2:14: parent_name 'ours/motoin' does not exist or cannot be read "
        "(did you mean 'ours/motion'?)"]


def test_a_cycle_is_an_error_of_the_rapps_on_it_alone():
    rapps, errors = family(a='parent_name: b', b='parent_name: c', c='{parent_name: a, display: C}',
                           child='parent_name: c', other='{}', own='parent_name: own')
    assert set(rapps) == {'child', 'other'}
    assert rapps['child'].display == 'C'
    assert [error.msg for error in errors] == [
        "rapp 'ours/a' is its own ancestor: ours/a -> ours/b -> ours/c -> ours/a",
        "rapp 'ours/b' is its own ancestor: ours/b -> ours/c -> ours/a -> ours/b",
        "rapp 'ours/c' is its own ancestor: ours/c -> ours/a -> ours/b -> ours/c",
        "rapp 'ours/own' is its own ancestor: ours/own -> ours/own"]


@given(st.permutations(range(8)), st.lists(st.integers(-1, 8), min_size=8, max_size=8))
def test_what_is_inherited_does_not_depend_on_the_order(order, parents):
    """Parent -1 is none, 8 one that is not there; an icon tells who said it."""
    texts = {'r%d' % i: '{%s %s}' % ('parent_name: r%d,' % parent if parent >= 0 else '',
                                     'icon: %d.png' % i if i % 3 == 0 else '')
             for i, parent in enumerate(parents)}
    in_order, errors = family(**texts)
    shuffled, more_errors = family(**{'r%d' % i: texts['r%d' % i] for i in order})
    assert shuffled == in_order
    assert sorted(map(str, more_errors)) == sorted(map(str, errors))
    assert len(in_order) + len(errors) == 8


# Finding

def test_exported_rapps_are_found_and_a_bad_one_hides_no_other(tmp_path):
    make_package(tmp_path, 'ours', [('rocon_app', '\n  rapps/dance.rapp\n'),
                                    ('rocon_app', 'rapps/broken.rapp'),
                                    ('rocon_app', 'rapps/missing.rapp'),
                                    ('rocon_app', 'more/dance.rapp'),
                                    ('capability_interface', 'rapps/dance.rapp')],
                 rapps__dance_rapp='parent_name: theirs/motion', rapps__broken_rapp='display: [',
                 more__dance_rapp='{}')
    make_package(tmp_path, 'theirs', [('rocon_app', 'motion.rapp')], motion_rapp='display: Motion')
    rapps, errors = rapps_from_package_index(package_index_from_package_path([str(tmp_path)]))
    assert list(rapps) == ['ours/dance', 'theirs/motion']
    assert rapps['ours/dance'].display == 'Motion'
    assert [(os.path.relpath(error.file_name, str(tmp_path)), error.msg.partition(',')[0])
            for error in errors] == [
        ('ours/rapps/broken.rapp', 'did not find expected node content while parsing a flow node'),
        ('ours/rapps/missing.rapp', 'cannot be read: No such file or directory'),
        ('ours/more/dance.rapp', "duplicate rapp 'ours/dance'")]


@needs_corpus
def test_all_rapps_of_the_corpus_are_read():
    rapps, errors = rapps_from_package_index(package_index_from_package_path([CORPUS]))
    assert errors == [] and len(rapps) == 15
    moo = rapps['rocon_apps/moo_chirp']
    assert moo.is_implementation and moo.files['icon'].endswith('rocon_apps/icons/cow.png')
    assert [rapp.name for rapp in rapps.values() if not rapp.is_implementation] == [
        'rocon_apps/' + name for name in ('chirp', 'teleop', 'text_to_speech', 'video_teleop',
                                          'make_a_map', 'waypoint_nav', 'image_stream')]


# The verdict

def spec_index(*texts):
    """An index of the package caps with interfaces A to E and the providers of these texts."""
    from capabilities.discovery import SpecIndex
    from capabilities.specs.interface import capability_interface_from_string
    from capabilities.specs.provider import capability_provider_from_string
    index = SpecIndex()
    for name in 'ABCDE':
        index.add_interface(capability_interface_from_string(
            '{name: %s, spec_version: 1, spec_type: interface, interface: }' % name),
            name + '.yaml', 'caps')
    for text in texts:
        name, rest = text.split(' ', 1)
        index.add_provider(capability_provider_from_string(
            '{name: %s, spec_version: 1, spec_type: provider, implements: caps/%s}' % (name, rest)),
            name + '.yaml', 'caps')
    return index


def judged(text):
    """A rapp beside whose file is a launch file, radio.launch."""
    return rapp_from_string(text, 'ours/dance', str(EXAMPLES / 'cafe_rapps/rapps/radio/dance.rapp'))


def rapp_that_requires(*names, compatibility='rocon:/kobuki'):
    return judged('{compatibility: "%s", launch: radio.launch, required_capabilities: [%s]}' % (
        compatibility, ', '.join('{name: caps/%s}' % name for name in names)))


def test_a_rapp_runs_where_platform_and_capabilities_are_there():
    index = spec_index('a_provider A, depends_on: caps/B', 'b_provider B')
    verdict = runnable(rapp_that_requires('A'), ROBOT, index)
    assert verdict and verdict.reasons == ()
    assert verdict.providers == ('caps/b_provider', 'caps/a_provider')
    assert str(verdict) == 'ours/dance runs'


@pytest.mark.parametrize('providers, required, kind, fault, text', [
    ([], 'F', ReasonKind.CAPABILITY, FaultKind.NO_INTERFACE,
     "capability 'caps/F': no package exports this capability"),
    ([], 'A', ReasonKind.CAPABILITY, FaultKind.NO_PROVIDER,
     "capability 'caps/A': no provider implements it"),
    (['x A', 'y A'], 'A', ReasonKind.CAPABILITY, FaultKind.AMBIGUOUS,
     "capability 'caps/A': several providers implement it, and none is the default: "
     "'caps/x', 'caps/y'"),
    (['x A, depends_on: caps/B'], 'A', ReasonKind.DEPENDENCY, FaultKind.NO_PROVIDER,
     "capability 'caps/A' cannot be started: provider 'caps/x' depends on 'caps/B': "
     'no provider implements it'),
    (['x A, depends_on: {caps/B: {provider: caps/z}}', 'y B'], 'A', ReasonKind.DEPENDENCY,
     FaultKind.UNKNOWN_PROVIDER,
     "capability 'caps/A' cannot be started: provider 'caps/x' depends on 'caps/B': "
     "no package exports the preferred provider 'caps/z'"),
    (['x A, depends_on: caps/B', 'y B, depends_on: caps/A'], 'A', ReasonKind.DEPENDENCY,
     FaultKind.CYCLE,
     "capability 'caps/A' cannot be started: providers depend on each other in a cycle: "
     'caps/x -> caps/y -> caps/x'),
])
def test_a_capability_that_cannot_be_had_is_a_reason(providers, required, kind, fault, text):
    verdict = runnable(rapp_that_requires(required), ROBOT, spec_index(*providers))
    assert not verdict
    (reason,) = verdict.reasons
    assert (reason.kind, reason.fault.kind, reason.explanation) == (kind, fault, None)
    assert str(reason).partition(' (did you mean')[0] == text


def test_a_default_decides_between_providers():
    index = spec_index('x A', 'y A')
    verdict = runnable(rapp_that_requires('A'), ROBOT, index, {'caps/A': 'caps/y'})
    assert verdict and verdict.providers == ('caps/y',)


def test_two_providers_of_one_capability_at_once_are_a_reason():
    index = spec_index('x A', 'y A', 'z B, depends_on: {caps/A: {provider: caps/y}}')
    (reason,) = runnable(rapp_that_requires('A', 'B'), ROBOT, index, {'caps/A': 'caps/x'}).reasons
    assert (reason.kind, reason.fault.kind) == (ReasonKind.DEPENDENCY, FaultKind.CONFLICT)


def test_the_platform_is_explained_field_by_field():
    rapp = rapp_that_requires(compatibility='rocon:/kobuki|pr2/*/noetic')
    (reason,) = runnable(rapp, 'rocon:/turtlebot2/bob/indigo/trusty', spec_index()).reasons
    assert reason.kind is ReasonKind.PLATFORM and reason.fault is None
    assert str(reason) == ("'rocon:/kobuki|pr2/*/noetic' does not include this robot: "
                           'hardware_platform is turtlebot2, application_framework is indigo')
    failed = [field for field, _, _, meets, _ in reason.explanation.fields if not meets]
    assert failed == ['hardware_platform', 'application_framework']


@pytest.mark.parametrize('text, lacks', [
    ('compatibility: rocon:/', 'launch'), ('launch: radio.launch', 'compatibility'),
    ('{}', 'compatibility and no launch')])
def test_a_virtual_rapp_never_runs(text, lacks):
    (reason,) = runnable(judged(text), ROBOT, spec_index()).reasons
    assert reason.kind is ReasonKind.VIRTUAL and str(reason) == 'it is virtual: it has no ' + lacks


def test_every_reason_is_there():
    verdict = runnable(rapp_that_requires('A', 'F', compatibility='rocon:/pr2'), ROBOT,
                       spec_index())
    assert [reason.kind for reason in verdict.reasons] == [
        ReasonKind.PLATFORM, ReasonKind.CAPABILITY, ReasonKind.CAPABILITY]
    assert str(verdict).startswith('ours/dance does not run: ') and str(verdict).count('; ') == 2


def test_a_compatibility_string_that_cannot_be_read_is_a_reason():
    (reason,) = runnable(rapp_that_requires(compatibility='rocon:/kobukki'), ROBOT,
                         spec_index()).reasons
    assert reason.kind is ReasonKind.PLATFORM and reason.explanation is None
    assert "hardware_platform 'kobukki' is not registered (did you mean 'kobuki'?)" in str(reason)


def test_on_a_robot_that_nobody_registered_runs_what_runs_anywhere():
    robot = 'rocon:/our_robot/bob/noetic/focal'
    assert runnable(rapp_that_requires(compatibility='rocon:/'), robot, spec_index())
    assert not runnable(rapp_that_requires(), robot, spec_index())


def test_the_rapp_is_read_with_the_vocabulary_of_the_robot():
    ours = Vocabulary.bundled().extended({'hardware_platform': {'robot': ['our_robot']}})
    robot = parse('rocon:/our_robot/bob', ours)
    assert runnable(rapp_that_requires(compatibility='rocon:/our_robot'), robot, spec_index())
    assert runnable(rapp_that_requires(compatibility='rocon:/robot'), robot, spec_index())
    assert not runnable(rapp_that_requires(), robot, spec_index())


@pytest.mark.parametrize('robot', ['', 'kobuki', 'rocon:/kobuki/3bob', 'rocon:/a b'])
def test_a_robot_that_is_none_is_an_error(robot):
    with pytest.raises(RoconURIValueError):
        runnable(rapp_that_requires(), robot, spec_index())


@needs_corpus
def test_the_random_walker_of_the_corpus_needs_a_default():
    packages = package_index_from_package_path([CORPUS])
    rapps, _ = rapps_from_package_index(packages)
    index, _ = spec_index_from_spec_file_index(spec_file_index_from_package_index(packages))
    walker = rapps['kobuki_rapps/random_walker']
    elsewhere = ['launch-missing']      # there are no launch files in it
    (reason,) = runnable(walker, ROBOT, index, ignore=elsewhere).reasons
    assert reason.fault.kind is FaultKind.AMBIGUOUS
    base = 'kobuki_capabilities/kobuki_differential_mobile_base'
    verdict = runnable(walker, ROBOT, index, {'std_capabilities/DifferentialMobileBase': base},
                       ignore=elsewhere)
    assert verdict and verdict.providers[:2] == ('kobuki_capabilities/kobuki_bringup', base)
    assert not runnable(walker, 'rocon:/pr2/bob/noetic/focal', index,
                        {'std_capabilities/DifferentialMobileBase': base})


@needs_corpus
def test_without_one_package_of_the_corpus_the_rest_is_still_judged():
    packages = package_index_from_package_path(
        [str(Path(CORPUS) / name) for name in ('kobuki_rapps', 'kobuki_capabilities')])
    rapps, _ = rapps_from_package_index(packages)
    index, errors = spec_index_from_spec_file_index(spec_file_index_from_package_index(packages))
    assert errors
    elsewhere = ['launch-missing']
    verdict = runnable(rapps['kobuki_rapps/random_walker'], ROBOT, index, ignore=elsewhere)
    assert [(reason.fault.kind, reason.fault.capability) for reason in verdict.reasons] == [
        (FaultKind.NO_INTERFACE, 'std_capabilities/DifferentialMobileBase')]
    assert runnable(rapps['kobuki_rapps/auto_docking'], ROBOT, index, ignore=elsewhere)


def test_a_verdict_has_the_providers_that_can_be_had_beside_its_reasons():
    index = spec_index('x A', 'y B, depends_on: caps/C')
    rapp = rapp_from_string('required_capabilities: [{name: caps/A}, {name: caps/B}]', 'ours/dance')
    verdict = runnable(rapp, ROBOT, index)
    assert [reason.id for reason in verdict.reasons] == ['virtual', 'no-provider']
    assert verdict.providers == ('caps/x', 'caps/y')


# Names of files that are not paths

@pytest.mark.parametrize('launch, what, meant', [
    ('ours/dance.launch', 'is a resource name', 'dance.launch'),
    ('ours/walk.launch', 'is a resource name', '../../launch/walk.launch'),
    ('$(find ours)/launch/walk.launch', 'is written with $(find)', '../../launch/walk.launch'),
    ('$(find  ours )/walk.launch', 'is written with $(find)', '../../launch/walk.launch'),
    ('package://ours/rapps/dance/dance.launch', 'is a package:// URL', 'dance.launch'),
    ('ours/gone.launch', 'is a resource name', None),
    ('theirs/walk.launch', 'is a resource name', None),
    ('$(find theirs)/walk.launch', 'is written with $(find)', None),
    ('gone/walk.launch', None, None),
    ('gone/launch/walk.launch', None, None),
    ('ours/launch/walk.launch', 'begins with the name of a package', '../../launch/walk.launch'),
    ('theirs/launch/walk.launch', 'begins with the name of a package', None),
])
def test_what_was_meant_by_a_name_that_is_no_path(tmp_path, launch, what, meant):
    make_package(tmp_path, 'theirs')
    folder = make_package(tmp_path, 'ours', rapps__dance__dance_launch='<launch/>',
                          launch__walk_launch='<launch/>')
    rapp = rapp_from_string('{compatibility: "rocon:/", launch: "%s"}' % launch, 'ours/dance',
                            str(folder / 'rapps' / 'dance' / 'dance.rapp'))
    [reason] = runnable(rapp, 'rocon:/pr2', SpecIndex()).reasons
    problem = ('does not exist' if what is None else
               what + ', expected a path relative to the file that names it'
               + ', in the same package' * ('theirs' in launch))
    assert (reason.id, str(reason)) == ('launch-missing', "launch file '%s' %s%s" % (
        launch, problem, " (did you mean '%s'?)" % meant if meant else ''))
