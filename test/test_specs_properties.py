"""What holds for any spec, and for anything that is not one."""
from __future__ import annotations

import copy
import os
from pathlib import Path

import pytest
import yaml
from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import (
    CapabilityInterface, InterfaceElement, InvalidInterface, capability_interface_from_dict,
    capability_interface_from_file_path, capability_interface_from_string)
from capabilities.specs.provider import (
    CapabilityProvider, InvalidProvider, capability_provider_from_dict,
    capability_provider_from_file_path, capability_provider_from_string)
from capabilities.specs.semantic_interface import (
    InvalidSemanticInterface, SemanticCapabilityInterface, semantic_capability_interface_from_dict,
    semantic_capability_interface_from_file_path, semantic_capability_interface_from_string)
from hypothesis import example, given, settings
from hypothesis import strategies as st
from specs.examples import GOOD

TEST = Path(__file__).parent
FULL = [(kind, (TEST / path).read_text()) for kind, path in (
    ('interface', 'unit/specs/interfaces/RGBCamera.yaml'),
    ('provider', 'unit/specs/providers/navigation_nav_stack.yaml'),
    ('semantic_interface', 'specs/semantic_interfaces/FrontRGBCamera.yaml'))]
LOADERS = {
    'interface': (capability_interface_from_string, capability_interface_from_dict,
                  InvalidInterface),
    'provider': (capability_provider_from_string, capability_provider_from_dict, InvalidProvider),
    'semantic_interface': (semantic_capability_interface_from_string,
                           semantic_capability_interface_from_dict, InvalidSemanticInterface)}
SPECS = st.sampled_from(FULL * 5 + GOOD)


# -- mutations ------------------------------------------------------------------------------------

class Text(str):
    """A str that is not quite one."""


WORDS = st.sampled_from([
    'name', 'type', 'description', 'topics', 'provides', 'requires', 'services', 'interface',
    'provider', 'a/B', 'c/d', 'spec_type', 'camera/image_raw', '', ' ', '\ud800', 'a' * 300,
    Text('interface')])
KEYS = st.one_of(
    WORDS, st.text(max_size=5), st.none(), st.booleans(), st.integers(), st.floats(),
    st.just(float('nan')), st.binary(max_size=3), st.tuples(st.integers()), st.dates())
VALUES = st.recursive(
    st.one_of(KEYS, st.just(10 ** 4000), st.just(object())),
    lambda children: st.one_of(
        st.lists(children, max_size=3), st.dictionaries(KEYS, children, max_size=3),
        st.tuples(children), st.sets(st.integers(), max_size=2)), max_leaves=6)


def places(node, path=()):
    """The paths of everything in it."""
    yield path
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(
        node, list) else ()
    for key, value in items:
        yield from places(value, path + (key,))


def mutate(draw, data, values=VALUES, keys=KEYS):
    """The data with something dropped, renamed, added or replaced."""
    data = copy.deepcopy(data)
    *path, key = draw(st.sampled_from([path for path in places(data) if path] or [(None,)]))
    node = data
    for step in path:
        node = node[step]
    if not isinstance(node, (dict, list)) or key is None:
        return data
    change = draw(st.sampled_from(['drop', 'replace', 'rename', 'add', 'move']))
    if change == 'drop':
        del node[key]
    elif change == 'replace':
        node[key] = draw(values)
    elif isinstance(node, dict) and change == 'rename':
        node[draw(keys)] = node.pop(key)
    elif isinstance(node, dict) and change == 'add':
        node[draw(keys)] = draw(values)
    elif change == 'move':
        moved = data
        for step in draw(st.sampled_from(list(places(data)))):
            moved = moved[step]
        node[key] = copy.deepcopy(moved)
    return data


@st.composite
def mutants(draw, values=VALUES, keys=KEYS):
    """(kind of spec, data that were one)"""
    kind, text = draw(SPECS)
    data = yaml.safe_load(text)
    for _ in range(draw(st.integers(1, 3))):
        data = mutate(draw, data, values, keys)
    return kind, data


@settings(max_examples=500, deadline=None)
@given(mutants())
def test_no_data_raise_anything_undocumented(mutant):
    kind, data = mutant
    from_string, from_dict, invalid = LOADERS[kind]
    try:
        spec = from_dict(data, 'f')
    except invalid as error:
        assert str(error).startswith('f: ') and str(error).isprintable()
    else:
        assert from_dict(spec.to_dict()) == spec == from_string(spec.to_yaml())


PLAIN_KEYS = st.one_of(WORDS.filter(lambda word: type(word) is str and word != '\ud800'),
                       st.none(), st.booleans(), st.integers(), st.floats(), st.dates())
PLAIN_VALUES = st.recursive(
    PLAIN_KEYS, lambda children: st.one_of(
        st.lists(children, max_size=3), st.dictionaries(PLAIN_KEYS, children, max_size=3)),
    max_leaves=6)


@settings(max_examples=250, deadline=None)
@given(mutants(PLAIN_VALUES, PLAIN_KEYS))
def test_no_mutant_in_a_file_raises_anything_undocumented(mutant):
    kind, data = mutant
    from_string, _, invalid = LOADERS[kind]
    try:
        spec = from_string(yaml.safe_dump(data), 'f')
    except invalid as error:
        assert str(error).startswith('f:%d:%d: ' % (error.line, error.column))
    else:
        assert from_string(spec.to_yaml()) == spec


@settings(max_examples=400, deadline=None)
@given(SPECS, st.data())
def test_no_damaged_text_raises_anything_undocumented(spec, data):
    kind, text = spec
    from_string, _, invalid = LOADERS[kind]
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(text)))
        end = data.draw(st.integers(start, min(len(text), start + 10)))
        text = text[:start] + data.draw(st.one_of(
            st.text(alphabet='{}[]:-?&*!|>\'"%@#, \n\tab/1\0\ud800', max_size=4),
            st.just(text[end:end + 30]))) + text[end:]
    try:
        from_string(text, 'f')
    except invalid as error:
        assert str(error).startswith('f:%d:%d: ' % (error.line, error.column))


@settings(max_examples=100)
@given(st.one_of(VALUES, st.binary(max_size=30)))
def test_whatever_is_no_spec_is_refused(data):
    for _, from_dict, invalid in LOADERS.values():
        with pytest.raises(invalid):
            from_dict(data)


def test_a_number_that_cannot_be_shown():
    with pytest.raises(InvalidInterface, match='name is a large number, expected text'):
        capability_interface_from_dict(
            {'name': 10 ** 5000, 'spec_version': 1, 'spec_type': 'interface'})


def test_text_that_no_file_can_hold():
    with pytest.raises(InvalidInterface) as raised:
        capability_interface_from_dict({'name': 'A', 'spec_version': 1, 'spec_type': 'interface',
                                        'description': '\ud800'})
    assert str(raised.value) == r"<dict>: description is '\ud800', expected text"


def test_data_in_one_another_without_end():
    cycle = {'name': 'A', 'spec_version': 1, 'spec_type': 'interface'}
    cycle['interface'] = cycle['topics'] = cycle['description'] = cycle
    deep: list = []
    for _ in range(100000):
        deep = [deep]
    for data in (cycle, {**cycle, 'description': None, 'interface': {'topics': {'a': deep}}}):
        with pytest.raises(InvalidSpec):
            capability_interface_from_dict(data)


# -- there and back -------------------------------------------------------------------------------

TEXT = st.text(st.characters(blacklist_categories=['Cs']), min_size=1, max_size=30)
DESCRIPTION = st.one_of(
    st.none(), st.just(''), TEXT, st.text('a b\n\t\'":#-\x85\u2028é', max_size=99))
NAME = st.from_regex('[A-Za-z][A-Za-z0-9_]{0,5}(/[A-Za-z][A-Za-z0-9_]{0,5})?', fullmatch=True)
SPEC_NAME = st.from_regex('[A-Za-z][A-Za-z0-9_]{0,5}/[A-Za-z][A-Za-z0-9_]{0,5}', fullmatch=True)
NEW_NAMES = st.dictionaries(
    st.sampled_from(['topics', 'services', 'actions', 'parameters']),
    st.dictionaries(TEXT, st.just('a'), max_size=2))


ELEMENTS = st.dictionaries(TEXT, st.tuples(
    st.sampled_from(['topic', 'service', 'action', 'parameter']), TEXT, DESCRIPTION,
    st.sampled_from(['provides', 'requires', None])), max_size=5)


@st.composite
def interfaces(draw):
    interface = CapabilityInterface(draw(NAME), 1, draw(DESCRIPTION))
    elements = draw(ELEMENTS)
    # A file has each grouping once, so what is in one stands together.
    for name, (kind, element_type, description, grouping) in sorted(
            elements.items(), key=lambda item: str(item[1][3])):
        if grouping or name not in ('provides', 'requires'):
            getattr(interface, 'add_' + kind)(
                name, InterfaceElement(name, kind, element_type, description), grouping)
    for name in draw(st.lists(TEXT, max_size=2, unique=True)):
        interface.add_dynamic_parameter(name)
    return interface


@settings(deadline=None)
@given(interfaces())
def test_an_interface_is_what_to_yaml_wrote(interface):
    again = capability_interface_from_string(interface.to_yaml())
    assert again == interface == capability_interface_from_dict(interface.to_dict())
    assert again.warnings == ()
    for section in ('topics', 'services', 'actions', 'parameters', 'dynamic_parameters'):
        assert list(getattr(again, section)) == list(getattr(interface, section))


@settings(deadline=None)
@given(NAME, DESCRIPTION, SPEC_NAME, st.none() | TEXT, NEW_NAMES, st.none() | TEXT,
       st.dictionaries(SPEC_NAME, st.none() | SPEC_NAME, max_size=3))
@example('a', None, 'b/c', None, {}, None, {'d/e': None})
def test_a_provider_is_what_to_yaml_wrote(name, description, implements, launch_file, new_names,
                                          nodelet_manager, dependencies):
    provider = CapabilityProvider(
        name, 1, implements, launch_file, description, new_names, nodelet_manager)
    for dependency in dependencies.items():
        provider.add_depends_on(*dependency)
    again = capability_provider_from_string(provider.to_yaml())
    assert again == provider == capability_provider_from_dict(provider.to_dict())
    assert list(again.dependencies) == list(provider.dependencies)
    assert (again.launch_file, again.nodelet_manager, again.remappings_by_type) == (
        launch_file, nodelet_manager, provider.remappings_by_type)


@settings(deadline=None)
@given(NAME, DESCRIPTION, SPEC_NAME, st.none() | TEXT, NEW_NAMES)
def test_a_semantic_interface_is_what_to_yaml_wrote(name, description, redefines, namespace,
                                                    new_names):
    semantic = SemanticCapabilityInterface(name, redefines, 1, description, namespace, new_names)
    again = semantic_capability_interface_from_string(semantic.to_yaml())
    assert again == semantic == semantic_capability_interface_from_dict(semantic.to_dict())
    assert again.global_namespace == namespace


@settings(deadline=None)
@given(interfaces(), st.sampled_from([None, 'left', '/left', 'a/b']))
def test_resolving_renames_and_changes_nothing_else(interface, namespace):
    semantic = SemanticCapabilityInterface('Left', 'a/B', 1, None, namespace)
    try:
        resolved = semantic.resolve(interface)
    except InvalidSemanticInterface as error:
        assert 'both come out as' in str(error)
        return
    before, after = list(interface.elements()), list(resolved.elements())
    assert [(section, element.type, element.description, grouping)
            for section, _, element, grouping in before] == [
                (section, element.type, element.description, grouping)
                for section, _, element, grouping in after]
    for (_, old, _, _), (_, new, element, _) in zip(before, after):
        assert new.endswith(old) and element.name == new
        assert old[0] not in '/~' or new[0] == old[0]


# -- real files -----------------------------------------------------------------------------------

CORPUS = os.environ.get('ROCON_URI_CORPUS')


@pytest.mark.skipif(not CORPUS, reason='ROCON_URI_CORPUS is not set')
def test_all_published_specs_load():
    from_file_path = {'interface': capability_interface_from_file_path,
                      'provider': capability_provider_from_file_path,
                      'semantic_interface': semantic_capability_interface_from_file_path}
    found = {kind: 0 for kind in from_file_path}
    warnings = []
    for path in sorted([*Path(CORPUS).glob('*/interfaces/*.yaml'),
                        *Path(CORPUS).glob('*/providers/*.yaml')]):
        kind = yaml.safe_load(path.read_text())['spec_type']
        spec = from_file_path[kind](path)
        assert LOADERS[kind][0](spec.to_yaml()) == spec
        assert spec == LOADERS[kind][1](yaml.safe_load(path.read_text()))
        found[kind] += 1
        warnings += spec.warnings
    assert found == {'interface': 13, 'provider': 15, 'semantic_interface': 2}
    assert [(Path(warning.file_name).name, warning.line) for warning in warnings] == [
        ('RGBDSensor.yaml', 18)]
