"""What the three kinds of capability specs share, and that every example is loaded or refused."""
from __future__ import annotations

import copy
import doctest
import io
import logging
import os
import pickle

import pytest
from capabilities.specs import interface, provider, semantic_interface
from capabilities.specs.common import (
    InvalidSpec, SpecName, SpecWarning, split_spec_name, validate_spec_name)
from rocon_uri.sources.yaml_data import YamlMapping
from rocon_uri.sources.yaml_source import load
from sources import ROOT
from specs.examples import BAD, BEYOND_SCHEMAS, GOOD, INTERFACE, ODD

# By kind of spec: a file, the class, the error, and the functions that read one.
KINDS = {
    'interface': (
        'unit/specs/interfaces/RGBCamera.yaml',
        interface.CapabilityInterface, interface.InvalidInterface,
        interface.capability_interface_from_file_path, interface.capability_interface_from_file,
        interface.capability_interface_from_string, interface.capability_interface_from_dict),
    'provider': (
        'unit/specs/providers/navigation_nav_stack.yaml',
        provider.CapabilityProvider, provider.InvalidProvider,
        provider.capability_provider_from_file_path, provider.capability_provider_from_file,
        provider.capability_provider_from_string, provider.capability_provider_from_dict),
    'semantic_interface': (
        'specs/semantic_interfaces/FrontRGBCamera.yaml',
        semantic_interface.SemanticCapabilityInterface,
        semantic_interface.InvalidSemanticInterface,
        semantic_interface.semantic_capability_interface_from_file_path,
        semantic_interface.semantic_capability_interface_from_file,
        semantic_interface.semantic_capability_interface_from_string,
        semantic_interface.semantic_capability_interface_from_dict),
}
FROM_STRING = {kind: row[5] for kind, row in KINDS.items()}
FROM_DICT = {kind: row[6] for kind, row in KINDS.items()}
REFUSED = BAD + [example for examples in BEYOND_SCHEMAS.values() for example in examples]


def plain(data):
    """The data without what they know of the text."""
    if isinstance(data, dict):
        return {key: plain(value) for key, value in data.items()}
    return [plain(item) for item in data] if isinstance(data, list) else data


def test_the_examples_of_the_reference_run(monkeypatch):
    monkeypatch.chdir(ROOT)
    failed, run = doctest.testfile(
        str(ROOT / 'test' / 'specs' / 'reference.txt'), module_relative=False,
        optionflags=doctest.ELLIPSIS)
    assert run > 20 and not failed


# -- the four ways to load a spec -----------------------------------------------------------------

@pytest.mark.parametrize('kind', KINDS)
def test_every_way_to_load_a_spec_gives_the_same(kind):
    file_name, spec_class, _, from_file_path, from_file, from_string, from_dict = KINDS[kind]
    path = ROOT / 'test' / file_name
    text = path.read_text()
    with open(path) as text_file, open(path, 'rb') as binary_file:
        specs = {
            str(path): from_file_path(str(path)), '': from_file(text_file),
            ' ': from_file(binary_file), '<string>': from_string(text),
            'a.yaml': from_string(text, 'a.yaml'), '<file>': from_file(io.StringIO(text)),
            '<dict>': from_dict(plain(load(text))), 'b': from_dict(load(text), 'b')}
    for name, spec in specs.items():
        assert type(spec) is spec_class
        assert spec == specs['<string>']
        assert spec.file_name == (name.strip() or str(path))
        assert spec.spec_type == kind
        assert spec.source == load(text)
        assert spec.warnings == ()
    assert isinstance(specs['<string>'].source, YamlMapping)
    assert from_file_path(path) == specs['<string>']        # a path object will do


@pytest.mark.parametrize('kind', KINDS)
@pytest.mark.parametrize('string', [None, 3, b'name: a', ['name: a'], {}])
def test_a_string_is_a_str(kind, string):
    with pytest.raises(AttributeError, match='from a str, found %s$' % type(string).__name__):
        FROM_STRING[kind](string)


@pytest.mark.parametrize('kind', KINDS)
def test_a_file_that_cannot_be_read(kind, tmp_path):
    from_file_path, from_file = KINDS[kind][3:5]
    fifo = tmp_path / 'fifo'
    os.mkfifo(fifo)
    for path in (tmp_path / 'missing.yaml', tmp_path, fifo):
        with pytest.raises(OSError):
            from_file_path(str(path))
    with open(os.devnull, 'w') as file, pytest.raises(OSError):
        from_file(file)


@pytest.mark.parametrize('kind', KINDS)
def test_errors_of_a_file_name_it(kind, tmp_path):
    _, _, invalid, from_file_path, from_file, _, from_dict = KINDS[kind]
    path = tmp_path / 'bad.yaml'
    path.write_bytes(b'name: \xff')
    with pytest.raises(invalid) as raised:
        from_file_path(path)
    assert str(raised.value) == '%s:1:7: not UTF-8 (Latin-1?): byte 0xff at offset 6' % path
    with open(path, encoding='utf-8') as file, pytest.raises(invalid) as raised:
        from_file(file)
    assert str(raised.value) == '%s: not utf-8 text: invalid start byte' % path
    with pytest.raises(invalid) as raised:
        from_dict({'spec_type': 3})
    assert str(raised.value) == '<dict>: spec_type is 3, expected text'
    assert (raised.value.line, raised.value.column) == (None, None)


def test_a_file_of_more_than_1_mib_is_refused_however_it_is_read(tmp_path):
    path = tmp_path / 'large.yaml'
    path.write_text(INTERFACE + '#' * 2 ** 20)
    with open(path) as file, pytest.raises(interface.InvalidInterface, match='1 MiB'):
        interface.capability_interface_from_file(file)
    with pytest.raises(interface.InvalidInterface, match='1 MiB'):
        interface.capability_interface_from_file_path(path)


# -- good, odd and bad specs ----------------------------------------------------------------------

@pytest.mark.parametrize('kind, text', GOOD)
def test_good_specs(kind, text):
    spec = FROM_STRING[kind](text)
    assert spec == FROM_DICT[kind](plain(load(text)))
    assert FROM_STRING[kind](spec.to_yaml()) == spec == FROM_DICT[kind](spec.to_dict())


@pytest.mark.parametrize('kind, text, error', REFUSED)
def test_bad_specs(kind, text, error):
    with pytest.raises(KINDS[kind][2]) as raised:
        FROM_STRING[kind](text, 'path/file.yaml')
    assert str(raised.value) == 'path/file.yaml:' + error
    line, column, msg = error.split(':', 2)
    assert (raised.value.line, raised.value.column) == (int(line), int(column))
    assert (raised.value.msg, raised.value.file_name) == (msg.strip(), 'path/file.yaml')


@pytest.mark.parametrize('kind, text, error', BAD)
def test_bad_data_give_the_same_error_without_a_place(kind, text, error):
    with pytest.raises(KINDS[kind][2]) as raised:
        FROM_DICT[kind](plain(load(text)), 'path/file.yaml')
    assert str(raised.value) == 'path/file.yaml: ' + error.split(': ', 1)[1]


@pytest.mark.parametrize('kind, text, warning', ODD)
def test_odd_specs_are_loaded_with_a_warning(kind, text, warning, caplog):
    with caplog.at_level(logging.WARNING, 'capabilities.specs'):
        spec = FROM_STRING[kind](text, 'f.yaml')
    assert [str(one) for one in spec.warnings] == ['f.yaml:' + warning]
    assert [(record.name, record.getMessage()) for record in caplog.records] == [
        ('capabilities.specs', 'f.yaml:' + warning)]
    assert spec.warnings[0].file_name == 'f.yaml'
    assert '%d:%d' % spec.warnings[0].place == warning.split(': ')[0]


def test_a_text_full_of_unknown_keys_gives_a_bounded_number_of_warnings():
    spec = FROM_STRING['interface'](INTERFACE + ''.join('key%d: 1\n' % i for i in range(5000)))
    assert len(spec.warnings) == 100


def test_the_last_description_counts():
    spec = FROM_STRING['interface'](
        INTERFACE + 'interface: {topics: {a: {description: x, type: b/C, description: y}}}')
    assert spec.topics['a'].description == 'y'


# -- what every spec has --------------------------------------------------------------------------

@pytest.mark.parametrize('kind', KINDS)
def test_a_description_is_given_if_there_is_none(kind):
    text = next(text for of, text in GOOD if of == kind)
    assert FROM_STRING[kind](text).description == 'No description given.'
    assert FROM_STRING[kind](text + 'description:').description == 'No description given.'
    assert FROM_STRING[kind](text + 'description: a').description == 'a'


@pytest.mark.parametrize('kind', KINDS)
def test_attributes_can_be_set(kind):
    spec = FROM_STRING[kind](next(text for of, text in GOOD if of == kind))
    other = copy.deepcopy(spec)
    for name, value in [('name', 'a_package/name'), ('description', 'another')]:
        setattr(spec, name, value)
        assert getattr(spec, name) == value
        assert spec != other
        assert FROM_STRING[kind](spec.to_yaml()) == spec
        other = copy.deepcopy(spec)


@pytest.mark.parametrize('kind', KINDS)
def test_specs_are_equal_by_what_they_say(kind):
    text = next(text for of, text in GOOD if of == kind)
    spec = FROM_STRING[kind](text)
    assert spec == FROM_STRING[kind]('# a comment\n' + text, 'elsewhere.yaml')
    assert spec != FROM_STRING[kind](text + 'description: a')
    assert spec != text and spec != spec.to_dict()
    assert pickle.loads(pickle.dumps(spec)) == spec == copy.deepcopy(spec)
    with pytest.raises(TypeError):
        hash(spec)
    assert repr(spec) == "<%s '%s'>" % (type(spec).__name__, spec.name)


@pytest.mark.parametrize('kind', KINDS)
def test_to_dict_gives_plain_new_data_in_the_order_of_the_file(kind):
    spec = KINDS[kind][3](ROOT / 'test' / KINDS[kind][0])
    data = spec.to_dict()
    assert list(data)[:4] == ['name', 'spec_version', 'spec_type', 'description']

    def check(node):
        assert type(node) in (dict, list, str, int)
        for item in node.values() if isinstance(node, dict) else ():
            check(item)

    check(data)
    data.clear()
    assert spec.to_dict()


def test_the_source_tells_where_things_are():
    path = ROOT / 'test' / KINDS['provider'][0]
    source = KINDS['provider'][3](path).source
    assert source.value_position('implements') == (7, 13)
    assert source['depends_on']['laser_capability/LaserObservation'].value_position(
        'provider') == (11, 19)


# -- names and errors -----------------------------------------------------------------------------

def test_spec_names():
    name = SpecName('a_package/RGBCamera')
    assert isinstance(name, str) and name == 'a_package/RGBCamera'
    assert (name.package, name.name) == ('a_package', 'RGBCamera')
    assert {name: 1}['a_package/RGBCamera'] == 1
    assert pickle.loads(pickle.dumps(name)).package == 'a_package'
    assert validate_spec_name('a/b') == 'a/b' and validate_spec_name('a/b').name == 'b'
    assert split_spec_name('a/b') == ('a', 'b')


@pytest.mark.parametrize('name', [
    '', '/', 'a', 'a/', '/a', 'a/b/c', 'a//b', '3/b', 'a/3', 'a b/c', 'a/b\n', 'ä/b', None, 3, [],
    ['a', 'b']])
@pytest.mark.parametrize('check', [SpecName, validate_spec_name, split_spec_name])
def test_illegal_spec_names(check, name):
    with pytest.raises(ValueError, match='expected package/name'):
        check(name)


@pytest.mark.parametrize('kind', KINDS)
def test_errors_share_a_base(kind):
    invalid = KINDS[kind][2]
    assert issubclass(invalid, InvalidSpec)
    error = invalid('no good', 'f.yaml')
    assert (str(error), error.line, error.column) == ('f.yaml: no good', None, None)
    error = pickle.loads(pickle.dumps(invalid('no\ngood', 'f.yaml', 3, 4)))
    assert (str(error), error.line, error.column) == ('f.yaml:3:4: no\\ngood', 3, 4)


def test_a_warning_has_its_parts():
    warning = SpecWarning('odd', 'f.yaml', 3, 4)
    assert (warning.problem, warning.file_name, warning.place) == ('odd', 'f.yaml', (3, 4))
    assert str(warning) == 'f.yaml:3:4: odd'
