"""Rules from the packages on the machine and from ROCON_URI_RULES."""
from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest
from capabilities.discovery import package_index_from_package_path
from sources import SOURCE

from rocon_uri import Vocabulary, is_compatible, parse
from rocon_uri.field_vocabulary import FieldVocabulary
from rocon_uri.sources.packages import find_packages
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.vocabulary import read_rules, with_exported_rules

PACKAGE = '''\
<package format="2">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>Robots of ours</description>
  <maintainer email="fry@planetexpress.org">Fry</maintainer>
  <license>BSD</license>
  <exec_depend>rocon_uri</exec_depend>
  <export>{exports}</export>
</package>
'''
RULES = 'hardware_platform:\n  robot: [bender]\n'


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A package path of its own; what is not on it is not found."""
    path = tmp_path / 'src'
    path.mkdir()
    monkeypatch.setenv('ROS_PACKAGE_PATH', str(path))
    monkeypatch.delenv('ROS_ROOT', raising=False)
    monkeypatch.delenv('ROCON_URI_RULES', raising=False)
    return path


def make_package(path, name='ours', exports='<rocon_uri rules="${prefix}/rules/robots.yaml"/>',
                 **rules):
    (path / 'rules').mkdir(parents=True)
    (path / 'package.xml').write_text(PACKAGE.format(name=name, exports=exports))
    for file_name, content in rules.items():
        (path / 'rules' / (file_name + '.yaml')).write_text(content)
    return path


def exported():
    return with_exported_rules(Vocabulary.bundled())


def robots(vocabulary):
    bundled = Vocabulary.bundled().field('hardware_platform')
    return [value for value in vocabulary.field('hardware_platform') if value not in bundled]


def warnings(caplog):
    for record in caplog.records:
        assert record.name == 'rocon_uri'
        assert '\n' not in record.getMessage()
    return [record.getMessage() for record in caplog.records]


# Files

def test_a_file_of_rules_is_yaml_or_json(tmp_path):
    rules = {'hardware_platform': {'robot': ['bender', {'crushinator': ['big', 'small']}]}}
    as_yaml = ('hardware_platform:            # a comment\n'
               '  robot:\n    - bender\n    - crushinator: [big, small]\n')
    as_old_yaml = ('- hardware_platform:\n  - robot:\n    - bender\n    - crushinator:\n'
                   '      - big\n      - small\n')
    for number, text in enumerate([json.dumps(rules), as_yaml, as_old_yaml]):
        path = tmp_path / str(number)
        path.write_text(text)
        vocabulary = read_rules(Vocabulary.bundled(), str(path))
        assert robots(vocabulary) == ['bender', 'crushinator', 'big', 'small']
        assert vocabulary.field('hardware_platform').leaves('crushinator') == ['big', 'small']
        assert vocabulary.field('hardware_platform').children('crushinator') == ['big', 'small']


def test_an_empty_file_adds_nothing(tmp_path):
    path = tmp_path / 'rules.yaml'
    for text in ('', '# nothing yet\n', 'hardware_platform:\n', '[]', '{}'):
        path.write_text(text)
        assert robots(read_rules(Vocabulary.bundled(), str(path))) == []


@pytest.mark.parametrize('text, line, column, problem', [
    ('hardware_platform:\n  robot: [bender\n', 3, 1, ''),
    ('hardware_platform:\n\trobot: [bender]\n', 2, 1, ''),
    ('a_field:\n', 1, 1, "unknown field 'a_field' in the rules"),
    ('hardware_platform:\n- robot:\n  - ok\n  - "*"\n', 4, 5, "'*' is not a ROS base name"),
    ('hardware_platform:\n  robot:\n    - a/b\n', 3, 7, "'a/b' is not a ROS base name"),
    ('hardware_platform:\n  robot:\n    a b: [c]\n', 3, 5, "'a b' is not a ROS base name"),
    ('operating_system: [ubuntu: [22.04]]\n', 1, 29,
     'a value of operating_system is 22.04, expected text (in quotes)'),
    ('operating_system: [ubuntu: [on]]\n', 1, 29,
     'a value of operating_system is true, expected text'),
    ('hardware_platform:\n  phone:\n  - pr2\n', 3, 5, "'pr2' cannot be in 'phone', since it"),
    ('hardware_platform:\n  robot:\n  - [a]\n', 3, 5, 'a list stands where a value'),
    ('hardware_platform: {a: }\npc: [a]\n', 2, 1, "unknown field 'pc'"),
    ('hardware_platform:\n  a: [b]\n  a: [c]\n', 3, 3, "duplicate key 'a'"),
    ('hardware_platform: [a: {b: }, c: {d: , d: }]\n', 1, 40, "duplicate key 'd'"),
    ('bender\n', 1, 1, "unknown field 'bender'"),
    ('3\n', 1, 1, 'unknown field 3 in the rules (expected '),
    ('"%s": 3\n' % ('x' * 1000), 1, 1, "unknown field 'xxx"),
    ('"x\\n%s": 3\n' % ('x' * 1000), 1, 1, "'x\\n"),
])
def test_a_fault_says_where_it_is(tmp_path, text, line, column, problem):
    path = tmp_path / 'rules.yaml'
    path.write_text(text)
    with pytest.raises(YamlError) as caught:
        read_rules(Vocabulary.bundled(), str(path))
    assert str(caught.value).startswith('%s:%d:%d: ' % (path, line, column))
    assert problem in str(caught.value)
    assert len(str(caught.value)) < 400
    assert str(caught.value).isprintable()


# Packages

def test_what_a_package_exports_is_found(workspace):
    make_package(workspace / 'stack' / 'ours', robots=RULES)
    assert robots(exported()) == ['bender']


@pytest.mark.parametrize('rules', ['${prefix}/rules/robots.yaml', 'rules/robots.yaml'])
def test_the_path_is_relative_to_the_package(workspace, rules):
    make_package(workspace / 'ours', exports='<rocon_uri rules="%s"/>' % rules, robots=RULES)
    assert robots(exported()) == ['bender']


def test_a_package_exports_as_many_files_as_it_likes(workspace):
    exports = ''.join('<rocon_uri rules="${prefix}/rules/%s.yaml"/>' % name for name in 'ab')
    make_package(workspace / 'ours', exports=exports + '<rocon_uri/><other rules="x"/>',
                 a=RULES, b='hardware_platform:\n  robot: [{bender: [bender_a]}, flexo]\n')
    assert robots(exported()) == ['bender', 'bender_a', 'flexo']


def test_a_package_hides_those_of_its_name_further_on(workspace, tmp_path, monkeypatch, caplog):
    make_package(workspace / 'ours', robots=RULES)
    make_package(tmp_path / 'underlay' / 'ours', robots=RULES.replace('bender', 'flexo'))
    make_package(tmp_path / 'underlay' / 'theirs', name='theirs', exports='')
    paths = [str(workspace), str(tmp_path / 'underlay'), str(tmp_path / 'not_there')]
    monkeypatch.setenv('ROS_PACKAGE_PATH', os.pathsep.join(paths))
    assert robots(exported()) == ['bender']
    monkeypatch.setenv('ROS_PACKAGE_PATH', os.pathsep.join(paths[::-1]))
    assert robots(exported()) == ['flexo']
    (workspace / 'ours' / 'package.xml').write_text(PACKAGE.format(name='ours', exports=''))
    monkeypatch.setenv('ROS_PACKAGE_PATH', os.pathsep.join(paths))
    assert robots(exported()) == []
    assert warnings(caplog) == []


@pytest.mark.parametrize('marker', [
    'AMENT_IGNORE', 'CATKIN_IGNORE', 'COLCON_IGNORE', 'rospack_nosubdirs'])
def test_packages_are_not_looked_for_where_ros_does_not_look(workspace, marker, caplog):
    make_package(workspace / 'marked' / 'ours', robots=RULES)
    (workspace / 'marked' / marker).write_text('')
    make_package(workspace / '.hidden' / 'ours', robots=RULES)
    make_package(workspace / 'theirs', name='theirs', exports='')
    make_package(workspace / 'theirs' / 'ours', robots=RULES)
    (workspace / 'rosbuild').mkdir()
    (workspace / 'rosbuild' / 'manifest.xml').write_text('<package/>')
    make_package(workspace / 'rosbuild' / 'ours', robots=RULES)
    assert robots(exported()) == []
    assert warnings(caplog) == []


@pytest.mark.parametrize('marker', ['AMENT_IGNORE', 'CATKIN_IGNORE', 'COLCON_IGNORE', None])
def test_discovery_and_parse_see_the_same_packages(workspace, marker):
    ours = make_package(workspace / 'ours', robots=RULES)
    if marker is not None:
        (ours / marker).touch()
    seen = [] if marker else ['ours']
    assert list(package_index_from_package_path([str(workspace)])) == seen
    assert list(find_packages([str(workspace)])) == seen
    assert robots(exported()) == (['bender'] if seen else [])


def test_links_in_a_circle_are_followed_once(workspace):
    make_package(workspace / 'z' / 'ours', robots=RULES)
    for name in 'abcdefgh':
        (workspace / name).mkdir()
        (workspace / name / 'up').symlink_to(workspace)
    assert robots(exported()) == ['bender']


def test_a_fault_costs_only_the_file_that_it_is_in(workspace, monkeypatch, caplog):
    exports = ''.join('<rocon_uri rules="${prefix}/rules/%s.yaml"/>' % name
                      for name in ['star', 'robots', 'missing', 'slash', 'syntax', 'twice', 'more'])
    ours = make_package(
        workspace / 'ours', exports=exports, robots=RULES,
        star='hardware_platform:\n  robot:\n  - lost\n  - "*"\n',
        slash='operating_system: []\nhardware_platform: {lost: , a/b: }\n',
        syntax='hardware_platform: [lost\n',
        twice='hardware_platform:\n  phone:\n  - lost\n  - bender\n',
        more='hardware_platform: {robot: [flexo]}\n') / 'rules'
    for name, text in [('broken', '<package><name>broken'), ('empty', ''),
                       ('strange', '<?xml version="1.0" encoding="klingon"?><package/>')]:
        (workspace / name).mkdir()
        (workspace / name / 'package.xml').write_text(text)
    (workspace / 'nameless').mkdir()
    (workspace / 'nameless' / 'package.xml').write_text('<package/>')
    monkeypatch.setenv('ROCON_URI_RULES', os.pathsep.join(
        [str(workspace / 'no_such_file'), '', str(ours / 'star.yaml'), str(workspace)]))

    assert robots(exported()) == ['bender', 'flexo']
    expected = [
        ('%s:1:22: ' % (workspace / 'broken' / 'package.xml'), 'no element found'),
        ('%s:1:1: ' % (workspace / 'empty' / 'package.xml'), 'no element found'),
        ('%s:1:1: ' % (workspace / 'nameless' / 'package.xml'), 'exactly one "name" tag'),
        (str(workspace / 'strange' / 'package.xml'), 'encoding'),
        ('%s:4:5: ' % (ours / 'star.yaml'), "'*' is not a ROS base name"),
        (str(ours / 'missing.yaml'), 'missing.yaml: cannot be read: No such file or directory'),
        ('%s:2:29: ' % (ours / 'slash.yaml'), "'a/b' is not a ROS base name"),
        ('%s:2:1: ' % (ours / 'syntax.yaml'), ''),
        ('%s:4:5: ' % (ours / 'twice.yaml'), "'bender' cannot be in 'phone', since it"),
        (str(workspace / 'no_such_file'), 'file: cannot be read: No such file or directory'),
        ('%s:4:5: ' % (ours / 'star.yaml'), "'*' is not a ROS base name"),
        (str(workspace), 'src: cannot be read: Is a directory'),
    ]
    reported = warnings(caplog)
    assert len(reported) == len(expected)
    for text, (place, problem) in zip(reported, expected):
        assert place in text
        assert problem in text


def test_rules_are_named_by_the_environment(workspace, tmp_path, monkeypatch, caplog):
    (tmp_path / 'a.yaml').write_text(RULES)
    (tmp_path / 'b.json').write_text('{"operating_system": {"linux": ["planet_express_os"]}}')
    monkeypatch.setenv('ROCON_URI_RULES',
                       os.pathsep.join([str(tmp_path / 'a.yaml'), '', str(tmp_path / 'b.json')]))
    vocabulary = exported()
    assert robots(vocabulary) == ['bender']
    assert 'planet_express_os' in vocabulary.field('operating_system').leaves('linux')
    assert warnings(caplog) == []
    uri = parse('rocon:/bender/bob/noetic/planet_express_os', vocabulary)
    assert is_compatible(parse('rocon:/robot/*/ros/linux', vocabulary), uri)


def test_a_vocabulary_stays_the_same_where_nothing_is_added(workspace):
    bundled = Vocabulary.bundled()
    assert with_exported_rules(bundled) is bundled


def test_the_rules_of_many_files_are_folded_in_at_once(tmp_path, monkeypatch):
    files = [tmp_path / ('%d.yaml' % number) for number in range(50)]
    for number, file in enumerate(files):
        file.write_text('- hardware_platform: {robot: [bender_%d]}\n'
                        '- hardware_platform: {bender_%d: [flexo_%d]}\n' % ((number,) * 3))
    files[7].write_text('hardware_platform: {robot: [lost], mobile_device: [bender_6]}')
    monkeypatch.setenv('ROCON_URI_RULES', os.pathsep.join(map(str, files)))
    made = []
    make = FieldVocabulary.__init__
    monkeypatch.setattr(FieldVocabulary, '__init__',
                        lambda self, *args: made.append(self) or make(self, *args))
    vocabulary = exported()
    assert len(made) <= 9       # three fields: empty, bundled, with all rules
    field = vocabulary.field('hardware_platform')
    assert field.leaves('bender_49') == ['flexo_49'] and 'bender_6' in field
    assert 'lost' not in field and 'bender_7' not in field      # a faulty file adds nothing


# When they are looked up, in a process of its own

WATCHED = '''
import sys
reads = []
sys.addaudithook(lambda event, arguments: reads.append(event)
                 if event == 'open' and str(arguments[0]).endswith('robots.yaml') else None)
import rocon_uri
from rocon_uri import RoconURIValueError, Vocabulary, explain, is_compatible, parse, relation
def refused(text):
    try:
        parse(text)
    except RoconURIValueError as error:
        return error
'''


def run(code, **environment):
    done = subprocess.run([sys.executable, '-c', WATCHED + code], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True,
                          env=dict(os.environ, PYTHONPATH=str(SOURCE), **environment))
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture
def rules(workspace, tmp_path):
    path = tmp_path / 'robots.yaml'
    path.write_text('hardware_platform:\n  robot: [bender]\n  phone: [calculon]\n')
    return str(path)


KNOWN = [
    "parse('rocon://turtlebot2/pr2/ros'), parse('rocon:/'), parse('rocon://')",
    "parse('rocon://north/pr2/bob')",
    "parse('rocon://north/*/bob/ros/linux')",
    "parse('rocon://turtlebot2'), parse('rocon://pr2/*'), parse('rocon://robot#a')",
    "str(parse('rocon:/pr2/bob*')), parse('rocon:/pr2/bob').short, parse('rocon:/').to_rfc3986()",
    "is_compatible('rocon:/robot', 'rocon:/pr2/bob'), explain('rocon:/robot', 'rocon:/')",
    "parse('rocon:/robot').isdisjoint('rocon:/phone')",
    "'note3' in parse('rocon:/phone').hardware_platform",
    "'pr2' in parse('rocon:/phone').hardware_platform",
    "'bob' in parse('rocon:/pr2/b*').name",
    "rocon_uri.RoconURI.from_fields(hardware_platform='pr2').replace(name='bob')",
    "refused('pr2'), refused('rocon:/pr2/3bob'), refused('rocon:/pr2|'), refused('rocon:/pr2 ')",
    "hash(parse('rocon:/pr2')), parse('rocon:/pr2') == parse('rocon:/kobuki')",
]


def test_what_is_known_never_pays_for_the_search(rules):
    each = ''.join('%s\nif reads: sys.exit(%r)\n' % (code, code) for code in KNOWN)
    run(each, ROCON_URI_RULES=rules)


@pytest.mark.parametrize('code', [
    "assert parse('rocon:/bender').hardware_platform.string == 'bender'",
    "assert parse('rocon:/pr2|bender/bob/noetic/focal').hardware_platform.list[1] == 'bender'",
    "assert refused('rocon:/blender').suggestions == ['bender']",
    "assert parse('rocon://bender/bob').hardware_platform.string == 'bender'",
    "assert parse('rocon://bender').read_with_one_slash",
    "assert parse('rocon://pr2/bender').concert_name == 'pr2'",
    "assert parse('rocon://north').concert_name == 'north'",
    "assert parse('rocon://north/pr2').short == 'rocon://north/pr2'",
    "assert 'bender' in parse('rocon:/robot').hardware_platform",
    "assert 'phone' not in parse('rocon:/galaxy|mega|note3|phone_other').hardware_platform",
    "assert 'calculon' in parse('rocon:/mobile_device').hardware_platform.expand()",
    "assert relation('rocon:/phone', 'rocon:/galaxy|mega|note3|phone_other').value == 'superset'",
    "assert not parse('rocon:/phone').issubset('rocon:/galaxy|mega|note3|phone_other')",
    "assert parse('rocon:/phone').issuperset('rocon:/galaxy')",
    "assert is_compatible('rocon:/robot', 'rocon:/bender')",
    "assert is_compatible('rocon:/', 'rocon:/unheard_of')",
    "assert explain('rocon:/robot', 'rocon:/bender')",
    "assert 'bender' in Vocabulary.open().field('hardware_platform')",
    "assert rocon_uri.RoconURI.from_fields(hardware_platform='bender')",
    "assert parse('rocon:/pr2').replace(hardware_platform='bender')",
])
def test_rules_are_looked_up_when_they_matter_and_once(rules, code):
    again = '\n'.join([code, 'assert len(reads) == 1', code, "refused('rocon:/flexo')",
                       "parse('rocon:/bender').hardware_platform.expand()", 'print(len(reads))'])
    assert run(again, ROCON_URI_RULES=rules) == '1\n'


def test_what_was_read_before_is_read_again_where_it_is_compared(rules):
    run('''
app, robot = parse('rocon:/robot'), parse('rocon:/phone|tablet')
bender = parse('rocon:/bender')
assert app.vocabulary is not bender.vocabulary
assert is_compatible(app, bender) and is_compatible(bender, app)
assert explain(app, bender) and relation(bender, app).value == 'subset'
assert parse('rocon:/robot') == app
assert parse('rocon:/robot').vocabulary is bender.vocabulary is rocon_uri.vocabulary.current()
assert 'bender' in app.hardware_platform.expand()
assert parse('rocon:/mobile_device').hardware_platform.expand() == robot.hardware_platform.expand()
''', ROCON_URI_RULES=rules)


def test_a_concert_may_be_somebodys_platform(rules):
    run('''
uri = parse('rocon://bender/bob')
assert (uri.concert_name, uri.hardware_platform.string, uri.name.string) == ('', 'bender', 'bob')
uri = parse('rocon://bender/pr2/bob')
assert (uri.concert_name, uri.hardware_platform.string) == ('bender', 'pr2')
uri = rocon_uri.RoconURI.from_fields(concert_name='bender')
assert uri.short == str(uri) and parse(uri.short) == uri
''', ROCON_URI_RULES=rules)


def test_a_package_on_the_package_path_is_found_by_parse(workspace):
    make_package(workspace / 'ours', robots=RULES)
    (workspace / 'broken').mkdir()
    (workspace / 'broken' / 'package.xml').write_text('<package>rocon_uri')
    assert run("print(parse('rocon:/bender'), len(reads))") == (
        'rules of a package left out: %s:1:19: not XML: no element found\n'
        'rocon:/bender/*/*/* 1\n' % (workspace / 'broken' / 'package.xml'))


@pytest.mark.parametrize('found_by', ['ROCON_URI_RULES', 'ROS_PACKAGE_PATH'])
def test_without_rospkg_there_are_the_rules_of_the_environment(found_by, workspace, tmp_path):
    package = make_package(workspace / 'ours', robots=RULES)
    if found_by == 'ROCON_URI_RULES':
        environment = {'ROS_PACKAGE_PATH': '', found_by: str(package / 'rules/robots.yaml')}
    else:
        environment = {found_by: '/gone:%s' % workspace}
    (tmp_path / 'rospkg.py').write_text('raise ImportError\n')
    code = "import sys; sys.path.insert(0, %r); print(parse('rocon:/bender').short)" % str(tmp_path)
    assert run(code, **environment) == 'rocon:/bender\n'
