"""Capability providers, as the reference describes them."""
from __future__ import annotations

from pathlib import Path

import pytest
from capabilities.specs.common import SpecName
from capabilities.specs.provider import (
    CapabilityProvider, DependsOnRelationship, capability_provider_from_file_path,
    capability_provider_from_string)
from capabilities.specs.remappings import RemapCollection

NAVIGATION = str(Path(__file__).parent / 'unit/specs/providers/navigation_nav_stack.yaml')
HEAD = 'name: a\nspec_version: 1\nspec_type: provider\nimplements: a_package/A\n'


@pytest.fixture
def navigation() -> CapabilityProvider:
    return capability_provider_from_file_path(NAVIGATION)


def test_the_example_of_the_reference(navigation):
    assert navigation.name == 'navigation_nav_stack'
    assert (navigation.spec_type, navigation.spec_version) == ('provider', 1)
    assert navigation.description == 'Implements the ability to navigate.'
    assert navigation.implements == 'navigation/Navigation'
    assert isinstance(navigation.implements, SpecName)
    assert navigation.launch_file == 'launch/navigation_nav_stack.launch'
    assert navigation.nodelet_manager == 'nav_manager'
    assert navigation.remappings == {'scan': 'nav_stack/scan'}
    dependencies = navigation.dependencies
    assert [type(name) for name in dependencies] == [SpecName]
    dependency = dependencies['laser_capability/LaserObservation']
    assert str(dependency) == (
        'laser_capability/LaserObservation:\n    preferred provider: hokuyo_capability/hokuyo_base')
    # As the reference prints it:
    assert repr(dependency).startswith(
        '<capabilities.specs.provider.DependsOnRelationship object at 0x')


def test_a_dependency_is_called_by_all_its_names():
    dependency = DependsOnRelationship('a/B', 'c/d')
    assert dependency.name == dependency.capability_name == 'a/B'
    assert dependency.provider == dependency.preferred_provider == 'c/d'
    assert dependency.provider_preference == 'c/d'
    assert DependsOnRelationship('a/B', None).preferred_provider is None


@pytest.mark.parametrize('form, expected', [
    ('', {}),
    ('null', {}),
    ('a/B', {'a/B': None}),
    ('[]', {}),
    ('[c/D, a/B]', {'c/D': None, 'a/B': None}),
    ('{}', {}),
    ('{c/D: , a/B: {}}', {'c/D': None, 'a/B': None}),
    ('{c/D: {provider: e/f}, a/B: {provider: }}', {'c/D': 'e/f', 'a/B': None}),
])
def test_all_forms_of_depends_on(form, expected):
    provider = capability_provider_from_string(HEAD + 'depends_on: ' + form)
    found = {name: one.preferred_provider for name, one in provider.dependencies.items()}
    assert found == expected and list(found) == list(expected)
    assert all(provider.depends_on(name) for name in expected)
    assert not provider.depends_on('a/C')


def test_adding_a_dependency():
    provider = CapabilityProvider('a', 1, 'a_package/A')
    assert provider.dependencies == {}
    provider.add_depends_on('b/C')
    provider.add_depends_on('b/A', 'c/d')
    assert list(provider.dependencies) == ['b/C', 'b/A']
    assert [one.preferred_provider for one in provider.dependencies.values()] == [None, 'c/d']
    with pytest.raises(RuntimeError, match="already depends on 'b/C'"):
        provider.add_depends_on('b/C', 'c/e')
    for names in (('C',), ('b/D', 'd'), (3,), ('b/D', '')):
        with pytest.raises(ValueError, match='expected package/name'):
            provider.add_depends_on(*names)
    assert list(provider.dependencies) == ['b/C', 'b/A']


def test_defaults_of_the_constructor():
    provider = CapabilityProvider('a', 1, 'a_package/A')
    assert provider.launch_file is None and provider.nodelet_manager is None
    assert provider.description == 'No description given.'
    assert provider.remappings == {}
    provider = CapabilityProvider(
        'a', 1, 'a_package/A', 'a.launch', 'text', {'topics': {'b': 'c'}}, 'manager')
    assert (provider.launch_file, provider.description, provider.remappings,
            provider.nodelet_manager) == ('a.launch', 'text', {'b': 'c'}, 'manager')


def test_remappings_flat_and_by_type():
    provider = capability_provider_from_string(
        HEAD + 'remappings: {services: {z: y}, topics: {b: c, a: d}}')
    assert list(provider.remappings.items()) == [('z', 'y'), ('b', 'c'), ('a', 'd')]
    assert provider.remappings_by_type == {
        'topics': {'b': 'c', 'a': 'd'}, 'services': {'z': 'y'}, 'actions': {}, 'parameters': {}}
    assert list(CapabilityProvider('a', 1, 'b/C').remappings_by_type) == [
        'topics', 'services', 'actions', 'parameters']


def test_a_name_has_one_new_name():
    provider = CapabilityProvider('a', 1, 'b/C', remappings={'topics': {'a': 'b'}})
    provider.add_remapping('services', 'a', 'b')        # to the same
    provider.add_remapping('topics', 'a', 'b')
    for kind in ('topics', 'actions'):
        with pytest.raises(RuntimeError, match="'a' is remapped to 'b' and to 'c'"):
            provider.add_remapping(kind, 'a', 'c')
    with pytest.raises(ValueError, match='expected topics, services, actions, parameters'):
        provider.add_remapping('topic', 'd', 'e')
    for remappings in ({'names': {'a': 'b'}}, {'names': {}}, {'a': 'b'}):
        with pytest.raises(ValueError, match='expected topics, services, actions, parameters'):
            CapabilityProvider('a', 1, 'b/C', remappings=remappings)
    assert provider.remappings == {'a': 'b'}
    assert provider.remappings_by_type == {
        'topics': {'a': 'b'}, 'services': {'a': 'b'}, 'actions': {}, 'parameters': {}}


def test_a_collection_of_remappings_of_its_own():
    collection = RemapCollection()
    collection.add_remappings_by_dict({'topics': {'a': 'b'}, 'services': {}, 'actions': {'c': 'd'}})
    collection.add_remapping('topics', 'e', 'f')
    assert collection.remappings == {'a': 'b', 'c': 'd', 'e': 'f'}
    assert collection.remappings_by_type == {
        'topics': {'a': 'b', 'e': 'f'}, 'services': {}, 'actions': {'c': 'd'}, 'parameters': {}}
    with pytest.raises(ValueError, match="'topic' is not a kind of remapping"):
        collection.add_remappings_by_dict({'topic': {}})
    with pytest.raises(RuntimeError, match="'a' is remapped to 'b' and to 'c'"):
        collection.add_remappings_by_dict({'services': {'a': 'c'}})
    provider = CapabilityProvider('a', 1, 'b/C')
    assert isinstance(provider, RemapCollection)
    provider.add_remappings_by_dict({'topics': {'a': 'b'}})
    assert provider.remappings == {'a': 'b'}


def test_what_is_returned_is_a_copy(navigation):
    navigation.dependencies.clear()
    navigation.remappings.clear()
    navigation.remappings_by_type.clear()
    navigation.remappings_by_type['topics'].clear()
    assert navigation == capability_provider_from_file_path(NAVIGATION)


@pytest.mark.parametrize('line', [
    'launch_file: a', 'nodelet_manager: a', 'depends_on: a/B', 'depends_on: {a/B: {provider: c/d}}',
    'remappings: {topics: {a: b}}', 'remappings: {services: {a: b}}'])
def test_equality_looks_at_everything(line):
    assert capability_provider_from_string(HEAD) != capability_provider_from_string(HEAD + line)


def test_to_yaml_writes_what_people_write(navigation):
    assert navigation.to_yaml() == '''\
name: navigation_nav_stack
spec_version: 1
spec_type: provider
description: Implements the ability to navigate.
implements: navigation/Navigation
launch_file: launch/navigation_nav_stack.launch
depends_on:
  laser_capability/LaserObservation:
    provider: hokuyo_capability/hokuyo_base
remappings:
  topics:
    scan: nav_stack/scan
nodelet_manager: nav_manager
'''
