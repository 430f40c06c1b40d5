"""The ids of findings: each is explained, on the page and by the command, and can be ignored."""
from __future__ import annotations

import ast
import re
import runpy
from time import process_time

import pytest
from made_packages import make_package
from sources import ROOT, SOURCE

from rocon_uri.lint import check_packages, ignoring
from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.explanations import EXPLANATIONS
from rocon_uri.lint.source_lines import SourceLines
from rocon_uri.sources.located import LocatedError
from rocon_uri.sources.wording import quoted
from rocon_uri.sources.yaml_source import load
from rocon_uri.vocabulary import Vocabulary

RAPP = 'display: Dance\ndescription: A dance\ncompatibility: rocon:/pr2\nlaunch: dance.launch\n'

# the functions that take an id as their last argument; a Finding has it by keyword
_NAMED = {'add', 'check', 'check_exists', 'error', 'fault', 'warn', 'with_id', '_error'}


def ids_in_source():
    """The ids that the source gives to faults and findings."""
    found = set()
    for path in [path for package in ('rocon_uri', 'capabilities')
                 for path in (SOURCE / package).rglob('*.py')]:
        for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
            if isinstance(node, ast.Call) and (node.args or node.keywords):
                function = node.func
                name = getattr(function, 'attr', getattr(function, 'id', ''))
                last = (node.args or [None])[-1] if name in _NAMED else node.keywords[-1].value \
                    if name == 'Finding' else None
                if isinstance(getattr(last, 'value', None), str) and (
                        re.fullmatch('[a-z]+(-[a-z]+)+|cycle', last.value)):
                    found.add(last.value)
            elif isinstance(node, ast.Assign) and getattr(node.targets[0], 'id', '') == 'id' and (
                    isinstance(node.value, ast.Constant)):
                found.add(node.value.value)
    from rocon_uri.apps.runnable import REASON_IDS
    from rocon_uri.sources import launch_file
    of_resources = {name for name in REASON_IDS if name.endswith(('-missing', '-ambiguous'))}
    return found | of_resources | {launch_file.MISSING, launch_file.NOT_XML, launch_file.NO_LAUNCH,
                    launch_file.OUTSIDE, launch_file.UNREADABLE}


def test_each_id_in_the_source_is_explained_and_no_other():
    assert ids_in_source() == set(EXPLANATIONS)


def test_an_explanation_says_all():
    for explanation in EXPLANATIONS.values():
        assert re.fullmatch('[a-z]+(-[a-z]+)*', explanation.id)
        assert all(text and text == text.strip() and text.endswith('.') for text in (
            explanation.what, explanation.why, explanation.mend))
        assert explanation.example.strip()


def test_an_example_that_is_yaml_can_be_read():
    for explanation in EXPLANATIONS.values():
        if ':' in explanation.example and not explanation.example.startswith('<'):
            assert load(explanation.example)


def test_the_page_on_findings_is_that_of_the_table():
    page = runpy.run_path(str(ROOT / 'doc' / 'make_findings.py'))['page']
    assert (ROOT / 'doc' / 'findings.rst').read_text(encoding='utf-8') == page()


def test_an_error_keeps_its_id_where_it_is_pickled():
    import pickle
    error = LocatedError('no', 'a', 1, 1)
    error.id = 'cycle'
    assert pickle.loads(pickle.dumps(error)).id == 'cycle'


# Ignoring

def ids(workspace, monkeypatch):
    monkeypatch.chdir(workspace)
    return [(finding.file_name, finding.id) for finding in check_packages(['.'])]


@pytest.mark.parametrize('comment, is_found', [
    ('', True), ('# rocon_uri: ignore[launch-missing]', False),
    ('#rocon_uri:ignore[launch-missing]', False),
    ('# by hand # rocon_uri: ignore[unknown-key, launch-missing]', False),
    ('# rocon_uri: ignore[unknown-key]', True), ('# rocon_uri: ignore', True),
    ('# rocon_uri: ignore[]', True), ('\n# rocon_uri: ignore[launch-missing]', True)])
def test_a_comment_ignores_what_is_found_on_its_line(tmp_path, monkeypatch, comment, is_found):
    make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp')],
                 dance_rapp=RAPP.rstrip() + ' ' + comment)
    assert ids(tmp_path, monkeypatch) == [('ours/dance.rapp', 'launch-missing')] * is_found


@pytest.mark.parametrize('export, is_found', [
    ('<rocon_app>no.rapp</rocon_app>', True),
    ('<rocon_app>no.rapp</rocon_app> <!-- rocon_uri: ignore[file-missing] -->', False),
    ('<!-- rocon_uri: ignore[file-missing] -->\n<rocon_app>no.rapp</rocon_app>', False),
    ('<!-- rocon_uri: ignore[file-missing] -->\n\n<rocon_app>no.rapp</rocon_app>', True),
    ('<rocon_app>no.rapp</rocon_app> <!-- rocon_uri: ignore[file-missing] made later -->', False),
    ('<!-- rocon_uri: ignore[file-missing] made later -->\n<rocon_app>no.rapp</rocon_app>', False),
    ('<rosdoc/><!-- rocon_uri: ignore[file-missing] -->\n<rocon_app>no.rapp</rocon_app>', True),
    ('<rocon_app>no.rapp</rocon_app>\n<!-- rocon_uri: ignore[file-missing] -->', True)])
def test_in_xml_also_a_comment_above_ignores(tmp_path, monkeypatch, export, is_found):
    manifest = make_package(tmp_path, 'ours') / 'package.xml'
    manifest.write_text(manifest.read_text().replace('<export>', '<export>\n' + export))
    assert ids(tmp_path, monkeypatch) == [('ours/package.xml', 'file-missing')] * is_found


def test_a_comment_in_a_launch_file_ignores(tmp_path, monkeypatch):
    launch = '<launch>\n<launch/> <!-- rocon_uri: ignore[launch-no-launch] -->\n</launch>'
    make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp')], dance_rapp=RAPP,
                 dance_launch=launch)
    assert ids(tmp_path, monkeypatch) == []


def test_a_comment_on_the_last_line_of_xml_is_not_above_the_first(tmp_path, monkeypatch):
    make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp')], dance_rapp=RAPP,
                 dance_launch='<robot/>\n<!-- rocon_uri: ignore[launch-no-launch] -->')
    assert ids(tmp_path, monkeypatch) == [('ours/dance.launch', 'launch-no-launch')]


@pytest.mark.parametrize('name, lines', [
    ('x.yaml', ['a', 'b', 'c', 'd', 'e', 'f']), ('x.rapp', ['a', 'b', 'c', 'd', 'e', 'f']),
    ('x.launch', ['a\u2028b\x85c', 'd', 'e', 'f']), ('x.xml', ['a\u2028b\x85c', 'd', 'e', 'f'])])
def test_lines_are_those_that_the_reader_of_a_file_counts(tmp_path, name, lines):
    path = tmp_path / name
    path.write_bytes('a\u2028b\x85c\rd\r\ne\nf'.encode())
    source = SourceLines()
    assert [source.line(str(path), number) for number in range(len(lines) + 2)] == [
        '', *lines, '']
    assert source.line(str(tmp_path / 'gone'), 1) == ''


def test_the_comments_of_a_line_are_read_once(tmp_path, monkeypatch):
    read = []
    monkeypatch.setattr(ignoring, '_ids_in_yaml', lambda line: read.append(line) or ['unknown-key'])
    make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp')], dance_rapp='{%s}' % ', '.join(
        'key%d: 1' % number for number in range(100)))
    assert ids(tmp_path, monkeypatch) == [('ours/dance.rapp', 'missing-key')]
    assert len(read) == 1


def test_what_was_meant_is_said_of_a_few_ids(tmp_path, monkeypatch):
    folder = make_package(tmp_path, 'ours')
    (folder / '.rocon_uri.yaml').write_text('ignore: [%s]' % ', '.join(
        'launch-mising%d' % number for number in range(30)))
    assert ['did you mean' in finding.problem for finding in check_packages([str(folder)])] == (
        [True] * 20 + [False] * 10)


def test_near_misses_among_many_names_are_looked_for_as_long_as_it_does_not_take_long():
    file = CheckedFile('dance.rapp', '.')
    assert file.suggestion('wave', ['wavy']) == " (did you mean 'wavy'?)"
    assert file.suggestion('wave', ['wavy'] * 20000) == ''


def test_in_a_file_that_is_gone_a_fault_is_where_its_value_began():
    file = CheckedFile('gone.rapp', '.')
    file.check_compatibility('rocon:/pcc', Vocabulary.bundled(), (3, 16))
    assert [(finding.line, finding.column) for finding in file.findings] == [(3, 16)]


@pytest.mark.parametrize('configuration, found', [
    ('', ['a/dance.rapp', 'b.rapp']), ('ignore: [launch-missing]', []),
    ('ignore:', ['a/dance.rapp', 'b.rapp']),
    ("ignore: ['launch-missing:*.rapp']", []), ("ignore: ['launch-missing:a/*']", ['b.rapp']),
    ("ignore: ['launch-missing: a/*']", ['b.rapp']),
    ("ignore: ['launch-missing:./a/*']", ['b.rapp']),
    ("ignore: ['launch-missing:**/*.rapp']", []), ("ignore: ['launch-missing:**/b.*']", [
        'a/dance.rapp']),
    ("ignore: ['launch-missing:[ab]*']", []), ("ignore: ['launch-missing:?.rapp']", [
        'a/dance.rapp']),
    ("ignore: ['launch-missing:*a*.rapp']", ['b.rapp']),
    ("ignore: ['launch-missing:*a*n*e*r']", ['a/dance.rapp', 'b.rapp']),
    ("ignore: ['launch-missing:*a*e*rapp']", ['b.rapp']),
    ("ignore: ['launch-missing:dance.rapp']", ['a/dance.rapp', 'b.rapp']),
    ('ignore: [unknown-key]', ['a/dance.rapp', 'b.rapp'])])
def test_a_package_says_what_is_ignored_in_its_files(tmp_path, monkeypatch, configuration, found):
    for name in 'ours', 'theirs':
        make_package(tmp_path, name, [('rocon_app', 'a/dance.rapp'), ('rocon_app', 'b.rapp')],
                     a__dance_rapp=RAPP, b_rapp=RAPP)
    (tmp_path / 'ours' / '.rocon_uri.yaml').write_text(configuration)
    assert ids(tmp_path, monkeypatch) == [
        (path, 'launch-missing') for path in ['ours/' + path for path in found] + [
            'theirs/a/dance.rapp', 'theirs/b.rapp']]


@pytest.mark.parametrize('configuration, finding', [
    ('[', 'not-yaml'), ('- a', 'wrong-value'), ('ignore: cycle', 'wrong-value'),
    ('ignore: [7]', 'wrong-value'),
    pytest.param("ignore: ['cycle:%s']" % (256 * 'a'), 'wrong-value', id='long'),
    pytest.param('ignore: [%s]' % ', '.join(['cycle'] * 1001), 'wrong-value', id='many'),
    ('ignore: [launch-mising]', 'wrong-value'),
    ('ingore: []', 'unknown-key')])
def test_a_faulty_configuration_is_a_finding(tmp_path, monkeypatch, configuration, finding):
    (make_package(tmp_path, 'ours') / '.rocon_uri.yaml').write_text(configuration)
    assert ids(tmp_path, monkeypatch) == [('ours/.rocon_uri.yaml', finding)]


@pytest.mark.parametrize('count, is_found', [(1000, False), (1001, True), (1002, True)])
def test_only_so_many_items_of_a_configuration_count(tmp_path, monkeypatch, count, is_found):
    """The last one would ignore what is found in the rapp."""
    folder = make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp')], dance_rapp=RAPP)
    (folder / '.rocon_uri.yaml').write_text(
        'ignore:\n%s- launch-missing\n' % ('- cycle\n' * (count - 1)))
    monkeypatch.chdir(folder)
    assert [str(finding) for finding in check_packages(['.'])] == [
        '.rocon_uri.yaml:1002:3: error: ignore has %d items, of which only 1000 count '
        '[wrong-value]' % count,
        "dance.rapp:4:9: error: launch file 'dance.launch' does not exist [launch-missing]",
    ] * is_found


@pytest.mark.parametrize('length, found', [(255, False), (256, True)])
def test_a_pattern_has_so_many_characters(tmp_path, length, found):
    folder = make_package(tmp_path, 'ours')
    glob = length * 'a'
    (folder / '.rocon_uri.yaml').write_text('ignore: [cycle:%s]' % glob)
    assert [finding.problem for finding in check_packages([str(folder)])] == [
        '%s is not a pattern of paths: it has more than 255 characters' % quoted(glob)] * found


def test_an_empty_range_of_characters_matches_nothing_or_is_a_finding(tmp_path, monkeypatch):
    """As the Python of the day has it."""
    (make_package(tmp_path, 'ours') / '.rocon_uri.yaml').write_text("ignore: ['cycle:[z-a]']")
    assert set(ids(tmp_path, monkeypatch)) <= {('ours/.rocon_uri.yaml', 'wrong-value')}


def test_what_is_ignored_takes_little_time_to_find_out(tmp_path, monkeypatch):
    """Of the globs of a package and of its findings, both are a stranger's."""
    folder = make_package(tmp_path, 'ours', [('rocon_app', '%s.rapp' % (100 * 'a'))])
    (folder / ('%s.rapp' % (100 * 'a'))).write_text('{%s}' % ', '.join(
        'key%d: 1' % number for number in range(3000)))
    (folder / '.rocon_uri.yaml').write_text('ignore: [%s]' % ', '.join(
        "'unknown-key:%s%d'" % (25 * '*a', number) for number in range(1000)))
    begin = process_time()
    assert len(ids(tmp_path, monkeypatch)) > 3000
    assert process_time() - begin < 10      # it is one


@pytest.mark.parametrize('text', ['<!-- rocon_uri: ignore[a] ', '<!-- rocon_uri: ignore[',
                                  '<!--' + ' ' * 1000])
def test_a_line_of_comments_takes_little_time_to_look_through(tmp_path, text):
    manifest = make_package(tmp_path, 'ours') / 'package.xml'
    manifest.write_text(text * (2 ** 20 // len(text)))
    begin = process_time()
    assert [finding.id for finding in check_packages([str(tmp_path)])] == ['invalid-manifest']
    assert process_time() - begin < 10


# Each kind of finding, where it occurs

CAMERA = '''\
name: Camera
spec_version: 1
spec_type: interface
interface: {topics: {provides: {image: {type: %s}}}}
'''
FRONT = 'name: Front\nspec_version: 1\nspec_type: semantic_interface\nredefines: ours/Camera\n'
USB = 'name: usb\nspec_version: 1\nspec_type: provider\nimplements: ours/Camera\n'
LAUNCH = {'a_launch': '<launch/>'}


def rapp(text='', launch='a.launch', **files):
    """The files of a package with a rapp."""
    return {'a_rapp': 'display: A\ndescription: B\ncompatibility: rocon:/pr2\nlaunch: %s\n%s' % (
        launch, text), **(files or LAUNCH)}


def specs(camera='sensor_msgs/Image', front='', usb=''):
    """The files of a package with specs."""
    return {'Camera_yaml': CAMERA % camera, 'Front_yaml': FRONT + front, 'usb_yaml': USB + usb}


def app(platform='pr2', interface='a.interface', more='launch: ours/a.launch', **files):
    """The files of a package with an app of app_manager."""
    return {'<export>': '<depend>app_manager</depend><export><app_manager app_dir="apps"/>',
            'apps__x_installed': 'apps: [{app: ours/a}]', 'a_interface': '{}', **LAUNCH,
            'a_app': '{platform: %s, interface: ours/%s, %s}' % (platform, interface, more),
            **files}


OCCURRENCES = {
    'cannot-read': {'x_interactions': None},
    'not-yaml': rapp('['),
    'wrong-value': rapp('icon: 7'),
    'missing-key': {'Camera_yaml': 'spec_version: 1\nspec_type: interface\n'},
    'unknown-key': rapp('colour: red'),
    'duplicate-key': rapp('display: B'),
    'illegal-name': specs(front='global_namespace: a-b'),
    'illegal-type': specs('Image'),
    'file-missing': rapp('icon: a.png'),
    'file-outside': rapp('icon: ../../a.png'),
    'duplicate-name': {**rapp(), 'b__a_rapp': 'display: A\ndescription: B\n'},
    'no-interface': specs(usb='depends_on: ours/Light'),
    'unknown-provider': specs(usb='depends_on: {ours/Front: {provider: ours/other}}'),
    'wrong-provider': specs(usb='depends_on: {ours/Front: {provider: ours/usb}}'),
    'cycle': specs(usb='depends_on: ours/Camera'),
    'unknown-name': specs(usb='remappings: {topics: {iamge: a}}'),
    'remapping-collision': {**specs(front='remappings: {topics: {image: a, depth: a}}'),
                            'Camera_yaml': CAMERA % 'a/B}, depth: {type: a/B'},
    'unknown-app': rapp('parent_name: other'),
    'ancestor-cycle': rapp('parent_name: a'),
    'launch-missing': rapp(launch='b.launch'),
    'launch-outside': rapp(launch='../../b.launch'),
    'launch-unreadable': rapp(launch='.'),
    'launch-not-xml': rapp(a_launch='<launch>'),
    'launch-no-launch': rapp(a_launch='<robot/>'),
    'invalid-uri': {'x_interactions': '[{name: A, compatibility: "rocon:/pr3"}]'},
    'one-slash': {'x_interactions': '[{name: A, compatibility: "rocon://pc"}]'},
    'misplaced-name': {'x_interactions': '[{name: A, compatibility: "rocon:/pc/kitkat"}]'},
    'invalid-manifest': {'email="somebody@example.org"': ''},
    'duplicate-package': {'copy__package_xml': '<package><name>ours</name></package>',
                          'package_xml': None},
    'duplicate-export': {'</export>': 2 * '<rocon_uri rules="a.yaml"/>' + '</export>',
                         'a_yaml': 'hardware_platform: {robot: [ours]}'},
    'unknown-export': {'</export>': '<rocon_apps>a.rapp</rocon_apps></export>'},
    'export-attribute': {'</export>': '<rocon_uri rule="a"/></export>'},
    'no-app-manager-dependency': {'</export>': '<app_manager app_dir="."/></export>'},
    'not-exported': {'b__c_rapp': 'display: A\ndescription: B\n'},
    'not-listed': {'a_app': '{}'},
    'outside-app-dir': {'a_installed': 'apps: []'},
    'never-runs': {'a_rapp': 'display: A\ndescription: B\ncompatibility: rocon:/'},
    'own-interface': {**rapp('parent_name: b\npublic_interface: a.yaml', a_yaml='{}', **LAUNCH),
                      'b__b_rapp': 'display: A\ndescription: B\n'},
    'virtual-capabilities': {**specs(), 'a_rapp': 'display: A\ndescription: B\n'
                                                  'required_capabilities: [{name: ours/Camera}]'},
    'interface-missing': app(interface='b.interface'),
    'interface-ambiguous': app(b__a_interface='{}'),
    'launch-ambiguous': app(b__a_launch='<launch/>'),
    'run-missing': app(more='run: ours/a.sh'),
    'run-ambiguous': app(more='run: ours/a.sh', a_sh='x', b__a_sh='x'),
    'icon-ambiguous': app(more='launch: ours/a.launch, icon: ours/a.png', a_png='', b__a_png=''),
    'unregistered-platform': app('our_robot'),
    'group-platform': app('robot'),
    'no-interactions': {'x_interactions': ''},
    'duplicate-interaction': {'x_interactions': '[%s, %s]' % (
        2 * ('{name: A, command: a, compatibility: "rocon:/"}',))},
    'unknown-pairing': {'x_interactions': '[{name: A, command: a, compatibility: "rocon:/", '
                                          'required_pairings: [B]}]'},
    'unknown-interaction': {**rapp(), 'x_interactions': 'pairings: [{name: A, rapp: ours/a, '
                                                        'requires_interaction: B}]'},
    'invalid-rules': {'</export>': '<rocon_uri rules="rules.yaml"/></export>',
                      'rules_yaml': 'robot: [ours]'},
    'no-package': None,         # of single files: test_cli_check.py
}
EXPORTED = {'Camera_yaml': 'capability_interface', 'Front_yaml': 'semantic_capability_interface',
            'usb_yaml': 'capability_provider', 'a_rapp': 'rocon_app', 'b__a_rapp': 'rocon_app',
            'b__b_rapp': 'rocon_app'}


def test_each_id_has_an_occurrence():
    assert set(OCCURRENCES) == set(EXPLANATIONS)


@pytest.mark.parametrize('fault_id', [fault_id for fault_id, files in OCCURRENCES.items() if files])
def test_each_id_occurs_where_it_should_and_alone(tmp_path, monkeypatch, fault_id):
    files = OCCURRENCES[fault_id]
    edits = {old: new for old, new in files.items() if not re.fullmatch(r'\w+', old)}
    names = {key: text for key, text in files.items() if key not in edits}
    exports = [(tag, '.'.join(key.replace('__', '/').rsplit('_', 1)))
               for key, tag in EXPORTED.items() if key in names]
    folder = make_package(tmp_path, 'ours', exports,
                          **{key: text for key, text in names.items() if text is not None})
    manifest = folder / 'package.xml'
    for old, new in edits.items():
        manifest.write_text(manifest.read_text().replace(old, new))
    for program in folder.rglob('*.sh'):
        program.chmod(0o755)
    if fault_id == 'cannot-read':
        (folder / 'x.interactions').symlink_to('nowhere')
    if fault_id == 'duplicate-package':
        manifest.rename(folder / 'ours.xml')
        for name in 'copy', 'other':
            (folder / name).mkdir(exist_ok=True)
            (folder / name / 'package.xml').write_text((folder / 'ours.xml').read_text())
    assert {found for _, found in ids(tmp_path, monkeypatch)} == {fault_id}
