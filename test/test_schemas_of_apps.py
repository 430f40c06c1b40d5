"""The JSON Schemas of apps, interactions and rules agree with those who read such files."""
from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_packages import make_package
from sources import ROOT, SOURCE

from rocon_uri import Vocabulary
from rocon_uri.apps.app_file import InvalidApp, app_from_string
from rocon_uri.apps.rapp import InvalidRapp, rapp_from_string
from rocon_uri.field_vocabulary import RulesError
from rocon_uri.lint import ERROR, check_packages
from rocon_uri.sources.yaml_source import load

jsonschema = pytest.importorskip('jsonschema')

KINDS = 'rapp', 'app', 'interactions', 'rules'
VALIDATORS = {kind: jsonschema.Draft7Validator(json.loads(
    (SOURCE / 'rocon_uri' / 'schemas' / (kind + '.json')).read_text())) for kind in KINDS}


def is_read(kind, data):
    """Does the reader of such files accept this?"""
    try:
        if kind == 'rapp':
            rapp_from_string(json.dumps(data), 'ours/x')
        elif kind == 'app':
            app_from_string(json.dumps(data), 'ours/x')
        else:
            Vocabulary.bundled().extended(data)
    except (InvalidRapp, InvalidApp, RulesError):
        return False
    return True


RAPP = {'compatibility': 'rocon:/pr2', 'launch': 'a.launch'}
APP = {'platform': 'pr2', 'interface': 'ours/a.interface', 'launch': 'ours/a.launch'}
GOOD = {
    'rapp': [
        {}, RAPP, {**RAPP, 'description': ''}, {**RAPP, 'colour': 'red'}, {'launch': None},
        {'required_capabilities': [{'name': 'a/B'}]}, {'required_capabilities': {}},
        {'required_capabilities': [{'name': 'a/B', 'interface': {
            'topics': {'requires': {'/a': 'b'}, 'provides': []}, 'services': None}}]}],
    'app': [
        APP, {**APP, 'launch': None, 'run': 'ours/x'}, {**APP, 'run': ''}, {**APP, 'icon': ''},
        {**APP, 'clients': [{'type': 'android', 'manager': {'a': 1}, 'app': {}}]},
        {**APP, 'clients': {}}, {**APP, 'clients': [{'type': 'a', 'manager': []}]}],
    'interactions': [
        [], [{'name': 'A', 'compatibility': 'rocon:/pc'}],
        {'interactions': [{'name': 'A', 'command': 'a', 'compatibility': 'rocon:/pc', 'max': -1}]},
        {'interactions': [{'name': 'A', 'compatibility': 'rocon:/pc', 'required_pairings': ['T']}],
         'pairings': [{'name': 'T', 'rapp': 'ours/a'}]},
        [{'name': '', 'display_name': 'A', 'role': 'B', 'compatibility': 'rocon:/pc',
          'pairing': {'rapp': 'ours/a', 'remappings': [{'remap_from': 'a', 'remap_to': 'b'}]}}],
        [{'group': 'A', 'interactions': [{'name': 'A', 'compatibility': 'rocon:/pc'}]}],
        [{'Web': [{'name': 'A', 'compatibility': 'rocon:/pc'}]}]],
    'rules': [
        None, {}, {'hardware_platform': None}, {'hardware_platform': 'ours'},
        {'hardware_platform': {'robot': ['ours', {'theirs': ['a', 'b']}]}},
        [{'hardware_platform': ['ours']}, {'operating_system': [{'linux': 'x'}]}]],
}
BAD = {
    'rapp': [
        [], 'a', {'launch': ''}, {'launch': 7}, {'display': ['a']}, {'required_capabilities': 'a'},
        {'required_capabilities': ['a/B']}, {'required_capabilities': [{}]},
        {'required_capabilities': [{'name': 'a/B', 'interface': 'x'}]},
        {'required_capabilities': [{'name': 'a/B', 'interface': {'topics': {'requires': ['a']}}}]},
        {'required_capabilities': [{'name': 'a/B', 'interface': {'topics': {
            'requires': {'a': 7}}}}]}],
    'app': [
        {}, [], {**APP, 'platform': ''}, {**APP, 'interface': None}, {**APP, 'launch': None},
        {**APP, 'run': 'ours/x'}, {**APP, 'icon': 7}, {**APP, 'clients': 'a'},
        {**APP, 'clients': [{'type': 'android'}]}, {**APP, 'clients': [{'manager': {}}]},
        {**APP, 'clients': [{'type': 'a', 'manager': 'b'}]}],
    'interactions': [
        None, 'a', [7], {'interactions': 'a'}, [{'name': 'A', 'display_name': 'B'}],
        [{'compatibility': 'rocon:/pc'}], [{'name': 'A', 'compatibility': ''}],
        [{'name': 'A', 'compatibility': 'rocon:/pc', 'max': 1.5}],
        [{'name': 'A', 'compatibility': 'rocon:/pc', 'max': -2}],
        [{'name': 'A', 'compatibility': 'rocon:/pc', 'display_name': 'B'}],
        [{'name': 'A', 'compatibility': 'rocon:/pc', 'pairing': {}}],
        [{'name': 'A', 'compatibility': 'rocon:/pc', 'required_pairings': 'T'}],
        [{'name': 'A', 'compatibility': 'rocon:/pc', 'remappings': [{'remap_from': 'a'}]}],
        {'pairings': [{'name': 'T'}]}, {'pairings': [{'rapp': 'ours/a'}]}],
    'rules': [
        'a', 7, {'name': ['a']}, {'hardware_platform': [['a']]}, {'hardware_platform': 7},
        {'hardware_platform': ['a b']}, {'hardware_platform': {'7up': None}},
        {'operating_system': ['x' * 256]}],
}


def rows(table):
    return [pytest.param(kind, data, id='%s %s' % (kind, json.dumps(data)[:60]))
            for kind in KINDS for data in table[kind]]


@pytest.mark.parametrize('kind', KINDS)
def test_the_schemas_are_schemas(kind):
    schema = VALIDATORS[kind].schema
    assert schema['title'] and schema['description']
    jsonschema.Draft7Validator.check_schema(schema)

    def parts(schema):
        for name, part in schema.get('properties', {}).items():
            yield name, part
        for below in schema.get('definitions', {}).values():
            yield from parts(below)
    for name, part in parts(schema):
        if '$ref' in part:
            part = schema['definitions'][part['$ref'].rpartition('/')[2]]
        assert part.get('description'), 'an editor has nothing to show for %s' % name


@pytest.mark.parametrize('kind, data', rows(GOOD))
def test_good_files_are_valid(kind, data):
    VALIDATORS[kind].validate(data)
    assert kind == 'interactions' or is_read(kind, data)


@pytest.mark.parametrize('kind, data', rows(BAD))
def test_bad_files_are_not(kind, data):
    assert not VALIDATORS[kind].is_valid(data)
    assert kind == 'interactions' or not is_read(kind, data)


@pytest.mark.parametrize('data, is_good', [
    *((data, True) for data in GOOD['interactions'] if data),
    *((data, False) for data in BAD['interactions'])])
def test_the_linter_says_the_same_of_interactions(tmp_path, data, is_good):
    make_package(tmp_path, 'ours', [('rocon_app', 'a.rapp')], a_rapp='display: A\ndescription: B\n',
                 x_interactions=json.dumps(data))
    errors = [finding for finding in check_packages([str(tmp_path)]) if finding.severity == ERROR]
    assert bool(errors) != is_good, errors


keys = st.sampled_from([
    'launch', 'run', 'icon', 'display', 'description', 'platform', 'interface', 'clients', 'type',
    'manager', 'app', 'required_capabilities', 'name', 'topics', 'requires', 'hardware_platform',
    'operating_system', 'robot', 'a', 'a-b', ''])
values = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 9) | keys,
    lambda below: st.lists(below, max_size=2) | st.dictionaries(keys, below, max_size=3),
    max_leaves=8)


@settings(max_examples=300)
@given(st.sampled_from(['rapp', 'app', 'rules']), st.data())
def test_schema_and_reader_agree_on_whatever_a_file_says(kind, data):
    head = {'rapp': {}, 'app': APP, 'rules': {}}[kind]
    names = {'rapp': ['launch', 'required_capabilities', 'description'],
             'app': ['launch', 'run', 'clients', 'platform', 'icon'],
             'rules': ['hardware_platform', 'operating_system']}[kind]
    file = {**head, **data.draw(st.dictionaries(st.sampled_from(names), values, max_size=3))}
    if kind == 'rules' and not is_read(kind, file) and VALIDATORS[kind].is_valid(file):
        with pytest.raises(RulesError, match='cannot be in'):       # which no schema can say
            Vocabulary.bundled().extended(file)
    else:
        assert VALIDATORS[kind].is_valid(file) == is_read(kind, file)


def files(*folders):
    for folder in folders:
        for path in sorted(Path(folder).rglob('*')):
            kind = path.suffix[1:]
            if kind in ('rapp', 'app', 'interactions'):
                yield pytest.param(kind, path, id=path.name)


@pytest.mark.parametrize('kind, path', files(
    ROOT / 'examples', ROOT / 'test' / 'workspace', *filter(None, [
        os.environ.get('ROCON_URI_CORPUS')])))
def test_files_that_somebody_wrote_are_valid(kind, path):
    VALIDATORS[kind].validate(load(path.read_bytes()))


@pytest.mark.parametrize('kind', ['hardware_platform', 'application_framework',
                                  'operating_system'])
def test_the_bundled_rules_are_valid(kind):
    bundled = json.loads((SOURCE / 'rocon_uri' / 'rules' / (kind + '.json')).read_text())
    VALIDATORS['rules'].validate(bundled if kind in bundled else {kind: bundled})
