"""The JSON Schemas, which editors check specs with, agree with the loader."""
from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
import yaml
from capabilities.specs.common import InvalidSpec
from hypothesis import given, settings
from hypothesis import strategies as st
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load
from sources import SOURCE
from specs.examples import BAD, BEYOND_SCHEMAS, GOOD, ODD
from test_specs_properties import FULL, LOADERS, mutants

jsonschema = pytest.importorskip('jsonschema')

SCHEMAS = SOURCE / 'rocon_uri' / 'schemas'
FILES = {'interface': 'capability_interface.json', 'provider': 'capability_provider.json',
         'semantic_interface': 'semantic_capability_interface.json'}
VALIDATORS = {kind: jsonschema.Draft7Validator(json.loads((SCHEMAS / name).read_text()))
              for kind, name in FILES.items()}


@pytest.mark.parametrize('kind', FILES)
def test_the_schemas_are_schemas(kind):
    schema = VALIDATORS[kind].schema
    assert schema['$schema'] == 'http://json-schema.org/draft-07/schema#'
    jsonschema.Draft7Validator.check_schema(schema)
    for name, part in schema['properties'].items():
        assert part.get('description'), 'an editor has nothing to show for %s' % name


@pytest.mark.parametrize('kind, text', [*FULL, *GOOD, *[row[:2] for row in ODD]])
def test_good_specs_are_valid(kind, text):
    VALIDATORS[kind].validate(load(text))


@pytest.mark.parametrize('kind, text', [row[:2] for row in BAD])
def test_bad_specs_are_not(kind, text):
    assert not VALIDATORS[kind].is_valid(load(text))


@pytest.mark.parametrize('reason, kind, text', [
    (reason, row[0], row[1]) for reason, rows in BEYOND_SCHEMAS.items() for row in rows])
def test_what_is_beyond_a_schema_is_valid_there(reason, kind, text):
    """If this fails, the example belongs to the others, which the schema refuses."""
    try:
        data = load(text)
    except YamlError:
        return      # no data, nothing to validate
    assert VALIDATORS[kind].is_valid(data), reason


JSON_KEYS = st.sampled_from([
    'name', 'type', 'description', 'topics', 'services', 'provides', 'requires', 'a', 'provider',
    'interface', 'remappings', 'depends_on', 'a/B', 'c/d', '', 'launch_file', 'implements'])
JSON_VALUES = st.recursive(
    st.one_of(JSON_KEYS, st.none(), st.booleans(), st.integers(), st.just(1.5)),
    lambda children: st.one_of(
        st.lists(children, max_size=2), st.dictionaries(JSON_KEYS, children, max_size=2)),
    max_leaves=5)


@settings(max_examples=300, deadline=None)
@given(mutants(JSON_VALUES, JSON_KEYS))
def test_schema_and_loader_agree_on_mutants(mutant):
    kind, data = mutant
    try:
        LOADERS[kind][1](data)
        refused = None
    except InvalidSpec as error:
        refused = str(error)
    if VALIDATORS[kind].is_valid(data):
        assert refused is None or beyond_a_schema(refused)
    else:
        assert refused is not None


def beyond_a_schema(refused: str) -> bool:
    """Is it about the keys of two objects?"""
    return 'duplicate ' in refused or 'is remapped to' in refused


@pytest.mark.skipif(not os.environ.get('ROCON_URI_CORPUS'), reason='ROCON_URI_CORPUS is not set')
def test_published_specs_are_valid():
    corpus = Path(os.environ['ROCON_URI_CORPUS'])
    for path in [*corpus.glob('*/interfaces/*.yaml'), *corpus.glob('*/providers/*.yaml')]:
        data = yaml.safe_load(path.read_text())
        VALIDATORS[data['spec_type']].validate(data)
