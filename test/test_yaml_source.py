"""Untrusted YAML: read as yaml.safe_load reads it, with positions, and within bounds."""
from __future__ import annotations

import copy
import math
import os
import pickle
import re
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from sources import ROOT, SOURCE

from rocon_uri.sources.located import located
from rocon_uri.sources.yaml_data import MAX_DEPTH, MAX_SIZE, YamlError, YamlMapping, YamlSequence
from rocon_uri.sources.yaml_source import load, load_file, read_file

CAMERA = str(ROOT / 'test/unit/specs/interfaces/RGBCamera.yaml')


@pytest.fixture(params=['libyaml', 'the parser in Python'])
def parser(request, monkeypatch):
    """Both of PyYAML's parsers; a machine without libyaml has the slow one only."""
    if request.param != 'libyaml':
        monkeypatch.delattr(yaml, 'CSafeLoader', raising=False)


def error_of(content) -> str:
    with pytest.raises(YamlError) as raised:
        load(content, 'f')
    return str(raised.value)


# -- values ---------------------------------------------------------------------------------------

@pytest.mark.usefixtures('parser')
@pytest.mark.parametrize('text, value', [
    ('', None),
    ('# a comment', None),
    ('---', None),
    ('~', None),
    ('null', None),
    ('nULL', 'nULL'),
    ('yes', True),
    ('Off', False),
    ('yEs', 'yEs'),
    ('y', 'y'),
    ('"yes"', 'yes'),
    ("'1'", '1'),
    ('|\n 1\n', '1\n'),
    ('1_000', 1000),
    ('+1', 1),
    ('-0x1F', -31),
    ('0b101', 5),
    ('017', 15),
    ('018', '018'),
    ('0o17', '0o17'),
    ('1:30', 90),
    ('-1:30.5', -90.5),
    ('1.5e+3', 1500.0),
    ('1e3', '1e3'),
    ('-.INF', -math.inf),
    ('2014-01-01', '2014-01-01'),
    ('2014-01-01 12:30:00', '2014-01-01 12:30:00'),
    ('=', '='),
    ('<<', '<<'),
    ('!!str 12', '12'),
    ('!!str', ''),
    ('!!int "12"', 12),
    ('!!float 3', 3.0),
    ('!!bool "no"', False),
    ('!!null ""', None),
    ('!!seq [!!map {}]', [{}]),
    ('! 12', 12),
    ('!<tag:yaml.org,2002:str> 12', '12'),
    ('%TAG !y! tag:yaml.org,2002:\n--- !y!str 12', '12'),
    pytest.param('"%s"' % ('%TAG ' * 101), '%TAG ' * 101, id='no directives'),
    ('%YAML 1.1\n---\na: b\n...\n', {'a': 'b'}),
    ('{"a": [1, 2.5, null, true]}', {'a': [1, 2.5, None, True]}),
    ('{1: a, 2.5: b, ~: c, no: d}', {1: 'a', 2.5: 'b', None: 'c', False: 'd'}),
    ('- &a [1]\n- *a', [[1], [1]]),
    ('&a x: *a', {'x': 'x'}),
    ('- &a x\n- *a : y', ['x', {'x': 'y'}]),
    ('\ufeffa: b', {'a': 'b'}),
    (b'\xef\xbb\xbfa: b', {'a': 'b'}),
    ('a: ü'.encode('utf-16'), {'a': 'ü'}),
    ('a: ü'.encode(), {'a': 'ü'}),
])
def test_values(text, value):
    data = load(text)
    assert data == value
    assert type(data) in (str, int, float, bool, type(None), YamlMapping, YamlSequence)


@pytest.mark.usefixtures('parser')
def test_not_a_number_is_one():
    assert math.isnan(load('.nan'))


@pytest.mark.usefixtures('parser')
@pytest.mark.parametrize('text, merged', [
    ('{y: 2, <<: *a, z: 2}', {'x': 1, 'y': 2, 'z': 2}),
    ('{<<: [*a, *b]}', {'y': 1, 'x': 1}),           # of a list, the first that has a key
    ('{<<: [*b, *a], x: 3}', {'x': 3, 'y': 2}),
    ('{<<: {<<: *a, y: 2}}', {'x': 1, 'y': 2}),
    ('{<<: *a, <<: {x: 5}}', {'x': 5, 'y': 1}),     # of two merge keys, the last that has a key
    ('{"<<": *b}', {'<<': {'y': 2}}),
])
def test_merge_keys(text, merged):
    # as PyYAML had them until 6.0.4, which goes by whether two keys are one object
    data = load('- &a {x: 1, y: 1}\n- &b {y: 2}\n- ' + text)[2]
    assert data == merged
    assert list(data) == list(merged)


NUMBERLIKE = st.text(alphabet='0123456789+-._:eExXbBafAFnNiIoOyYsStTrRuUlL~<=T Z', max_size=12)


@settings(max_examples=1500)
@given(NUMBERLIKE)
def test_plain_scalars_have_the_types_of_safe_load(text):
    try:
        expected = yaml.safe_load(text)
    except (ValueError, yaml.YAMLError) as error:       # ValueError: '0b_' and '2014-99-99'
        expected = error
    try:
        value = load(text)
    except YamlError as error:
        value = error
    if value == text.strip() and not isinstance(expected, str):     # what stays text here
        # up to PyYAML 5.3 '._' was to be a number
        assert value in ('=', '<<') or re.match(r'[0-9]{4}-|\._', value)
    elif isinstance(expected, Exception):
        assert isinstance(value, (YamlError, YamlMapping, YamlSequence))
    else:
        assert repr(value) == repr(expected) or 'datetime' in repr(expected)


SCALARS = st.one_of(
    st.none(), st.booleans(), st.integers(-10**30, 10**30), st.floats(allow_nan=False),
    st.text(st.characters(blacklist_categories=['Cs']), max_size=20))
DATA = st.recursive(
    SCALARS, lambda children: st.one_of(
        st.lists(children, max_size=4), st.dictionaries(SCALARS, children, max_size=4)))


@settings(max_examples=300)
@given(DATA, st.booleans())
def test_what_yaml_dumps_is_read_as_safe_load_reads_it(data, flow):
    text = yaml.safe_dump(data, default_flow_style=flow, sort_keys=False)
    expected = yaml.safe_load(text)
    assert load(text) == expected


# -- positions ------------------------------------------------------------------------------------

@pytest.mark.usefixtures('parser')
def test_positions():
    source = load('# first\na: 1\n"b" :\n  - c\n  - {d: &x e, f: *x}\n', 'f')
    assert source.position == (2, 1)
    assert (source.key_position('a'), source.value_position('a')) == ((2, 1), (2, 4))
    assert (source.key_position('b'), source.value_position('b')) == ((3, 1), (4, 3))
    assert source['b'].position == (4, 3)
    assert [source['b'].item_position(index) for index in (0, 1)] == [(4, 5), (5, 5)]
    inner = source['b'][1]
    assert inner.position == (5, 5)
    assert (inner.key_position('d'), inner.value_position('d')) == ((5, 6), (5, 9))
    assert inner.value_position('f') == (5, 18)
    for unread in (lambda: source.key_position('z'), lambda: source.value_position('z'),
                   lambda: inner.key_position('a'), lambda: source['b'].item_position(2)):
        with pytest.raises(LookupError):
            unread()


@pytest.mark.usefixtures('parser')
def test_positions_count_characters_also_after_a_byte_order_mark():
    assert load('\ufeffü: ü', 'f').value_position('ü') == (1, 4)


@pytest.mark.usefixtures('parser')
def test_what_is_merged_is_where_it_was_written():
    source = load('a: &a {x: 1, y: 1}\nb:\n  <<: *a\n  y: 2\n', 'f')
    assert source['b'].key_position('x') == (1, 8)
    assert source['b'].key_position('y') == (4, 3)
    assert not source['b'].repeated


@pytest.mark.usefixtures('parser')
def test_a_repeated_key_is_visible_and_the_last_one_wins():
    source = load('a: 1\nb: 1\na: 2\na: 3\n', 'f')
    assert source == {'a': 3, 'b': 1}
    assert list(source) == ['a', 'b']
    assert source.repeated == [('a', 1, (3, 1)), ('a', 2, (4, 1))]
    assert source.key_position('a') == (4, 1)
    assert load('1: a\ntrue: b', 'f').repeated == [(1, 'a', (2, 1))]


@given(DATA)
def test_every_key_is_where_it_says(data):
    text = yaml.safe_dump({'top': data}, default_flow_style=False)
    lines = text.split('\n')

    def check(node):
        if isinstance(node, YamlMapping):
            for key, value in node.items():
                line, column = node.key_position(key)
                if isinstance(key, str) and key.isalnum() and key.isascii():
                    assert lines[line - 1][column - 1:].lstrip('\'"? ').startswith(key)
                assert node.position <= (line, column) < node.value_position(key)
                check(value)
        elif isinstance(node, YamlSequence):
            positions = [node.item_position(index) for index in range(len(node))]
            assert positions == sorted(positions)
            for item in node:
                check(item)

    check(load(text))


def test_data_can_be_pickled_and_copied_with_their_positions():
    source = load('a: [b, {c: d}]\na: [b, {c: d}]', 'f')
    for again in (pickle.loads(pickle.dumps(source)), copy.deepcopy(source)):
        assert again == source
        assert again['a'][1].value_position('c') == (2, 12)
        assert again['a'].item_position(0) == (2, 5)
        assert again.repeated == source.repeated


# -- what is refused ------------------------------------------------------------------------------

@pytest.mark.parametrize('content, expected', [
    ('a: [b\n}', "f:2:1: did not find expected ',' or ']' while parsing a flow sequence"),
    ('a: b: c', 'f:1:5: mapping values are not allowed in this context'),
    ('\ta', 'f:1:1: found character that cannot start any token while scanning for the next token'),
    ('%YAML 2.0\n--- a', 'f:1:1: found incompatible YAML document'),
    ('--- a\n--- b', 'f:2:1: a second document starts here, where one is expected'),
    ('a: b\n--- [', 'f:2:1: a second document starts here, where one is expected'),
    ('&a [*a]', "f:1:5: alias '*a' is inside the node that it refers to"),
    ('- &a {b: {c: *a}}', "f:1:14: alias '*a' is inside the node that it refers to"),
    ('[*a]', "f:1:2: alias '*a' has no anchor before it"),
    ('[*a, &a b]', "f:1:2: alias '*a' has no anchor before it"),
    ('[&a b, &a c]', "f:1:8: anchor '&a' is defined twice"),
    ('a: !!python/object/apply:os.system [ls]',
     "f:1:4: tag '!!python/object/apply:os.system' is not one of the core types, and no other is "
     'read'),
    ('!robot a', "f:1:1: tag '!robot' is not one of the core types, and no other is read"),
    ('!!binary aa==', "f:1:1: tag '!!binary' is not one of the core types, and no other is read"),
    ('!!timestamp 2014-01-01',
     "f:1:1: tag '!!timestamp' is not one of the core types, and no other is read"),
    ('!!set {a}', "f:1:1: tag '!!set' is not one of the core types, and no other is read"),
    ('!!map []', "f:1:1: tag '!!map' is not one of the core types, and no other is read"),
    ('!!str []', "f:1:1: tag '!!str' is not one of the core types, and no other is read"),
    ('!!seq a', "f:1:1: tag '!!seq' is not one of the core types, and no other is read"),
    ('!!int a', "f:1:1: 'a' cannot be read as !!int"),
    ('!!float a', "f:1:1: 'a' cannot be read as !!float"),
    ('!!bool 1', "f:1:1: '1' cannot be read as !!bool"),
    ('!!null 1', "f:1:1: '1' cannot be read as !!null"),
    ('a: 0b_', "f:1:4: '0b_' cannot be read as a number"),
    ('a: ' + '9' * 257, "f:1:4: '%s...' cannot be read as a number" % ('9' * 77)),
    ('a: ' + '9' * 257 + '.0', "f:1:4: '%s...' cannot be read as a number" % ('9' * 77)),
    ('? [a]\n: b', 'f:1:3: a collection cannot be a key, text is expected'),
    ('{a: &x {}, *x : b}', 'f:1:12: a collection cannot be a key, text is expected'),
    ('<<: 1', "f:1:5: '<<' merges a mapping or a list of mappings, nothing else"),
    ('<<: [{}, 1]', "f:1:5: '<<' merges a mapping or a list of mappings, nothing else"),
    ('a\nb\0', 'f:2:2: character U+0000 is not allowed'),
    ('a: \x07', 'f:1:4: character U+0007 is not allowed'),
    ('a: \ud800', 'f:1:4: character U+D800 is not allowed'),
    ('"\\ud800"', 'f:1:4: found invalid Unicode character escape code while parsing a quoted '
                  'scalar'),
    (b'a:\r\n  \xff', 'f:2:3: not UTF-8 (Latin-1?): byte 0xff at offset 6'),
    (b'a:\n - \xc3\xbc\xff', 'f:2:5: not UTF-8 (Latin-1?): byte 0xff at offset 8'),
    (b'\xff\xfea', 'f:1:1: not UTF-16 text: truncated data'),
    ('a: 1'.encode('utf-16-le'), 'f:1:1: UTF-16, not UTF-8: byte 0x00 at offset 1'),
    ('a: 1'.encode('utf-16-be'), 'f:1:1: UTF-16, not UTF-8: byte 0x00 at offset 0'),
    ('x' * (MAX_SIZE + 1), 'f:1:1: larger than 1 MiB, which is all that is read'),
    (b'x' * (MAX_SIZE + 1), 'f:1:1: larger than 1 MiB, which is all that is read'),
    ('%TAG !a! x\n' * 101 + '--- a', 'f:1:1: more than 100 %TAG directives'),
    ('%TAG !a! x\u2028' * 101 + '--- a', 'f:1:1: more than 100 %TAG directives'),
])
def test_errors(content, expected):
    assert error_of(content) == expected


@pytest.mark.parametrize('content', [
    '"\\ud800"', '"\\uffff', '"\\Uffffffff"', '%YAML 1.' + '1' * 5000 + '\n--- a', '\ta', 'a: [',
    '@', 'a\0', 'a: \ud800', '!<', '&', '*', '%TAG\n---', '"%', '\x7f', '- - -\n -', '? :\n:'])
def test_the_parser_in_python_raises_nothing_else(content, monkeypatch):
    monkeypatch.delattr(yaml, 'CSafeLoader', raising=False)
    try:
        load(content, 'f')
    except YamlError as error:
        assert str(error).startswith('f:') and '\n' not in str(error)


@pytest.mark.usefixtures('parser')
@pytest.mark.parametrize('opening, column', [('[', 101), ('{a: ', 401), ('- ', 201)])
def test_nesting_is_limited_before_it_costs(opening, column):
    assert error_of(opening * 50000) == 'f:1:%d: nested deeper than 100' % column


def test_nesting_is_refused_where_it_starts_also_if_the_parser_gives_up_first(monkeypatch):
    # as that of libyaml 0.2.6 does, 1,000 deep in what it reads ahead
    class Loader(yaml.SafeLoader):
        def get_event(self):
            if len(given) <= 1000:
                return super().get_event()
            mark = yaml.Mark('', 1000, 0, 1000, None, None)
            raise yaml.scanner.ScannerError(None, mark, 'exceeded maximum nesting depth', mark)

    def loader(text):
        nonlocal given
        given = text
        return Loader(text)
    given = ''
    monkeypatch.setattr(yaml, 'CSafeLoader', loader, raising=False)
    assert error_of('[' * 50000) == 'f:1:101: nested deeper than 100'


@pytest.mark.usefixtures('parser')
def test_the_limits_are_where_they_are_said_to_be():
    assert load('[' * MAX_DEPTH + ']' * MAX_DEPTH)
    assert error_of('[' * (MAX_DEPTH + 1) + ']' * (MAX_DEPTH + 1))
    assert load('9' * 256) == int('9' * 256)
    assert load('#' * MAX_SIZE) is None


def test_aliases_count_with_what_they_stand_for():
    chain = 'a0: &a0 [x]\n' + ''.join('a%d: &a%d [*a%d]\n' % (i, i, i - 1) for i in range(1, 120))
    assert error_of(chain) == 'f:100:12: nested deeper than 100'
    laughs = 'a0: &a0 [lol, lol]\n' + ''.join(
        'a%d: &a%d [%s]\n' % (i, i, ', '.join(['*a%d' % (i - 1)] * 9)) for i in range(1, 12))
    assert 'aliases add more than 1 MiB' in error_of(laughs)
    long_text = 'a: &a %s\nb: [%s]\n'
    assert load(long_text % ('x' * 1000, '*a, ' * 1000))
    assert 'aliases add more than 1 MiB' in error_of(long_text % ('x' * 1000, '*a, ' * 1050))


def test_merges_count_too():
    keys = ', '.join('k%d: 1' % i for i in range(20000))
    assert len(load('{<<: {%s}}' % keys)) == 20000
    nested = '{<<: ' * 60 + '{%s}' % keys + '}' * 60
    assert 'aliases add more than 1 MiB' in error_of(nested)


def test_keys_that_are_no_text_are_few_since_their_hashes_can_be_chosen():
    def colliding(first, count):    # all of them have the hash 0
        return ', '.join('%d: 1' % (i * (2 ** 61 - 1)) for i in range(first, first + count))

    assert len(load('{%s}' % colliding(0, 100))) == 100
    assert error_of('\n{%s}' % colliding(0, 10000)).endswith(
        ': more than 100 keys that are not text')
    assert error_of('[{a: 1, <<: [{%s}, {%s}]}]' % (colliding(0, 60), colliding(60, 60))) == (
        'f:1:2: more than 100 keys that are not text')
    assert error_of('[&a 1, {%s}]' % ('*a : 1, ' * 101)) == (
        'f:1:809: more than 100 keys that are not text')
    assert len(load('{%s}' % ', '.join('k%d: 1' % i for i in range(1000)))) == 1000


def test_an_alias_gives_the_same_object():
    data = load('- &a [x]\n- *a')
    assert data[0] is data[1]


@settings(max_examples=500)
@given(st.one_of(st.binary(max_size=60), st.text(max_size=60),
                 st.text(alphabet='[]{},:-?&*!|>\'"%@` \n\tab1<~.', max_size=60)))
def test_any_content_is_read_or_refused(content):
    try:
        load(content, 'f')
    except YamlError as error:
        assert str(error).startswith('f:%d:%d: ' % (error.line, error.column))
        assert str(error).isprintable()


# -- files ----------------------------------------------------------------------------------------

def test_a_file():
    assert load_file(CAMERA)['name'] == load_file(Path(CAMERA))['name'] == 'RGBCamera'


def test_an_error_names_the_file(tmp_path):
    path = tmp_path / 'bad.yaml'
    path.write_text('a: [')
    with pytest.raises(YamlError) as raised:
        load_file(path)
    error = raised.value
    assert (error.file_name, error.line, error.column) == (str(path), 2, 1)
    assert str(error) == '%s:2:1: %s' % (path, error.problem)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.line) == (str(error), 2)


def test_a_large_file_is_refused_without_reading_it_all(tmp_path):
    path = tmp_path / 'large.yaml'
    with open(path, 'wb') as file:
        file.truncate(2 ** 40)      # a hole: it takes no room
    with pytest.raises(YamlError, match='larger than 1 MiB'):
        load_file(path)


def make_fifo(path):
    os.mkfifo(path)


def make_loop(path):
    path.symlink_to(path)


def make_unreadable(path):
    path.write_text('a: b')
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip('this user may read everything')


@pytest.mark.parametrize('make', [
    lambda path: None, Path.mkdir, make_fifo, make_loop, make_unreadable,
    lambda path: path.symlink_to('/dev/zero'), lambda path: path.symlink_to('nowhere')])
def test_what_is_not_a_file_that_can_be_read(make, tmp_path):
    path = tmp_path / 'spec.yaml'
    make(path)
    with pytest.raises(OSError) as raised:
        load_file(path)
    assert str(path) in str(raised.value)


@pytest.mark.skipif(not os.path.exists('/proc/self/limits'), reason='there is no /proc')
def test_a_file_may_hold_more_than_its_size_says():
    with open('/proc/self/limits', 'rb') as file:
        content = file.read()
    assert os.stat('/proc/self/limits').st_size == 0
    assert read_file('/proc/self/limits') == content


@pytest.mark.parametrize('size', [0, 1, MAX_SIZE - 1, MAX_SIZE])
def test_a_file_is_read_whole_if_it_is_not_too_large(size, tmp_path):
    (tmp_path / 'file').write_bytes(b'x' * size)
    assert read_file(tmp_path / 'file') == b'x' * size
    (tmp_path / 'file').write_bytes(b'x' * (size + MAX_SIZE))
    assert len(read_file(tmp_path / 'file')) == (MAX_SIZE + 1 if size else MAX_SIZE)


@pytest.mark.parametrize('path', ['a\0b', 'a\udbffb', ''])
def test_a_path_that_cannot_be_one(path):
    with pytest.raises(OSError):
        load_file(path)


def test_a_file_that_changes_while_it_is_read(tmp_path):
    path = tmp_path / 'spec.yaml'
    path.write_text('a: b')
    done = threading.Event()

    def change():
        while not done.is_set():
            path.write_text('a: [' * 10000)
            path.write_text('a: b')

    with ThreadPoolExecutor(1) as pool:
        writer = pool.submit(change)
        try:
            for _ in range(200):
                try:
                    # the text, or what of it had been written
                    assert load_file(path) in ({'a': 'b'}, {'a': None}, 'a', None)
                except YamlError:
                    pass
        finally:
            done.set()
        writer.result()     # raises what it raised


def test_a_place_is_one_line_whatever_the_file_is_called():
    assert located('p', 'a\nb', 1, 2) == 'a\\nb:1:2: p'
    assert located('p', 'f', None, None) == 'f: p'


def test_yaml_is_imported_only_when_something_is_read():
    code = ('import sys, rocon_uri.yaml_source, capabilities.specs.provider, '
            'capabilities.specs.semantic_interface\n'
            "assert not {'yaml', 'logging', 'json', 'rospkg'} & set(sys.modules)")
    subprocess.run([sys.executable, '-S', '-c', code], check=True,
                   env={**os.environ, 'PYTHONPATH': str(SOURCE)})
