"""Capability specs: damaged as data and as text, of the three kinds."""
from __future__ import annotations

import math
import os
import tempfile

import yaml
from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import (
    InvalidInterface, capability_interface_from_dict, capability_interface_from_file_path,
    capability_interface_from_string)
from capabilities.specs.provider import (
    InvalidProvider, capability_provider_from_dict, capability_provider_from_file_path,
    capability_provider_from_string)
from capabilities.specs.semantic_interface import (
    InvalidSemanticInterface, semantic_capability_interface_from_dict,
    semantic_capability_interface_from_file_path, semantic_capability_interface_from_string)
from fuzz.damage import damaged, damaged_tree, files
from specs.examples import GOOD as EXAMPLES

from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load


KINDS = {
    'interface': (capability_interface_from_string, capability_interface_from_file_path,
                  capability_interface_from_dict, InvalidInterface),
    'provider': (capability_provider_from_string, capability_provider_from_file_path,
                 capability_provider_from_dict, InvalidProvider),
    'semantic_interface': (semantic_capability_interface_from_string,
                           semantic_capability_interface_from_file_path,
                           semantic_capability_interface_from_dict, InvalidSemanticInterface)}

GOOD = [text for _, text in EXAMPLES] + [
    path.read_text() for path in files('*.yaml') if 'spec_type' in path.read_text()]
TREES = [yaml.safe_load(text) for text in GOOD]
SCALARS = ['name', 'spec_version', 'spec_type', 'interface', 'provider', 'semantic_interface',
           'description', 'topics', 'services', 'actions', 'parameters', 'dynamic_parameters',
           'provides', 'requires', 'type', 'implements', 'launch_file', 'depends_on', 'remappings',
           'nodelet_manager', 'redefines', 'global_namespace', 'a/B', 'std_msgs/String', 'image',
           'left/', '/scan', '~rate', '', ' ', '\xe9', '\U0001f916', 'a' * 300, None, True, 0, 1,
           -1, 10 ** 300, 1.5, math.inf, math.nan]
TOKENS = ['{', '}', '[', ']', ': ', '? ', '- ', ', ', '&a ', '*a', '*a : ', '<<: ', '<<: *a',
          '!!str ', '!!binary ', '!!python/object:a ', '!a ', '|\n', '>-\n', '"', "'", '#', ' #',
          '%', '%YAML 1.1\n', '%TAG ! tag:a,2000:\n', '@', '`', '---\n', '...\n', '\n', '\r',
          '\n  ', '\t', ' ', '\0', '\x85', '\ufeff', '\u2028', '\ud800', '\U0001f916', '\xe9',
          '\\', '\\x', '\\ud800', '~', 'null', 'yes', '0x1F', '1:30', '1e9999', '.nan',
          '2014-01-01', '=', '1_000', '0b1', '0o7', '9' * 300, 'a' * 2000]
TOKENS += [scalar for scalar in SCALARS if isinstance(scalar, str)]


def make(rng):
    """(kind, text)"""
    number = rng.randrange(len(GOOD))
    kind = TREES[number]['spec_type'] if rng.random() < 0.95 else rng.choice(list(KINDS))
    if rng.random() < 0.5:
        tree = damaged_tree(rng, TREES[number], SCALARS)
        text = yaml.safe_dump(tree, default_flow_style=rng.choice((None, True, False)),
                              allow_unicode=rng.random() < 0.5)
    else:
        text = damaged(rng, GOOD[number], TOKENS)
    return kind, text


def check(given):
    kind, text = given
    from_string, from_file_path, from_dict, invalid = KINDS[kind]
    spec = answer(from_string, text, invalid)
    check_file(text, spec, from_file_path, invalid)
    check_data(text)
    if isinstance(spec, str):
        return
    assert from_string(spec.to_yaml()) == spec == from_dict(spec.to_dict())
    assert from_string(spec.to_yaml()).to_yaml() == spec.to_yaml()
    assert all(str(warning).isprintable() for warning in spec.warnings)
    if kind == 'semantic_interface':
        check_resolved(spec)


def answer(read, source, invalid):
    """The spec, or the text of the error without the file."""
    try:
        return read(source)
    except invalid as error:
        assert isinstance(error, InvalidSpec) and str(error).isprintable()
        assert error.line >= 1 and error.column >= 1
        return '%d:%d: %s' % (error.line, error.column, error.msg)


def check_file(text, expected, from_file_path, invalid):
    """A file with the text reads as the text does."""
    try:
        content = text.encode()
    except UnicodeEncodeError:
        assert isinstance(expected, str)
        return
    with tempfile.NamedTemporaryFile(delete=False) as file:
        file.write(content)
    try:
        found = answer(from_file_path, file.name, invalid)
    finally:
        os.unlink(file.name)
    assert found == expected


class Loader(getattr(yaml, 'CSafeLoader', yaml.SafeLoader)):
    """As PyYAML reads what has no dates; of what can be read, libyaml's composer takes any."""


Loader.yaml_implicit_resolvers = {
    first: [(tag, regexp) for tag, regexp in resolvers
            if tag not in ('tag:yaml.org,2002:timestamp', 'tag:yaml.org,2002:value')]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()}


def check_data(text):
    """What can be read is what PyYAML reads."""
    try:
        data = load(text)
    except YamlError:
        return
    try:
        expected = yaml.load(text, Loader)
    except yaml.YAMLError as error:
        raise AssertionError('only PyYAML refuses it') from error
    assert repr(data) == repr(expected)


def check_resolved(spec):
    names = {kind: list(names) for kind, names in spec.remappings_by_type.items()}
    sections = {kind: {name: {'type': 'a/B'} for name in names[kind] + ['image', '/scan', '~rate']}
                for kind in names}
    try:
        interface = capability_interface_from_dict({
            'name': 'a/B', 'spec_version': 1, 'spec_type': 'interface', 'interface': sections})
        resolved = spec.resolve(interface)
    except InvalidSpec as error:
        assert str(error).isprintable()
        return
    assert resolved.name == spec.name
    assert capability_interface_from_string(resolved.to_yaml()) == resolved
    for kind, section in sections.items():
        assert len(getattr(resolved, kind)) == len(section)
