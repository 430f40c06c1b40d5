"""The verb specs: list, show, check and graph."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
from xml.etree import ElementTree

import pytest
from made_packages import make_package
from sources import ROOT

from rocon_uri.cli import main
from rocon_uri.spec_graph import Edge, Node, SpecGraph
from rocon_uri.spec_picture import dot_text

EXAMPLES = ROOT / 'examples' / 'workspace'
CORPUS = os.environ.get('ROCON_URI_CORPUS')
needs_corpus = pytest.mark.skipif(not CORPUS, reason='ROCON_URI_CORPUS is not set')
needs_dot = pytest.mark.skipif(not shutil.which('dot'), reason='graphviz is not installed')


pytestmark = pytest.mark.usefixtures('no_packages_around')


@pytest.fixture
def specs(capsys):
    """Run the verb, and return its status, output and errors."""
    def run(*arguments):
        try:
            status = main(['specs', *map(str, arguments)])
        except SystemExit as stopped:
            status = stopped.code
        out, err = capsys.readouterr()
        return status, out, err
    return run


def bad_package(workspace, warning_only=False):
    text = 'colour: red\n%sdisplay: A\ndescription: B\n' % (
        '' if warning_only else 'icon: ../../x.png\n')
    return make_package(workspace, 'bad', [('rocon_app', 'dance.rapp')], dance_rapp=text)


# The verb itself

def test_without_a_verb_of_its_own_it_says_how_to_use_it(specs):
    status, out, err = specs()
    assert status == 2 and out == '' and err.startswith('usage: rocon_uri specs')


@pytest.mark.parametrize('verb', ['list', 'show', 'check', 'graph'])
def test_each_has_help_that_fits(specs, verb):
    status, out, _ = specs(verb, '--help')
    assert status == 0
    assert 'Exit status: ' in out and '--json' in out
    assert '  rocon_uri specs ' + verb in out
    assert max(map(len, out.splitlines())) <= 84


@pytest.mark.parametrize('arguments', [('list', '--json'), ('--json', 'list')])
def test_json_is_asked_for_before_or_after_the_verb(specs, arguments):
    _, out, _ = specs(*arguments, '--package-path', EXAMPLES)
    assert json.loads(out)['errors'] == []


@pytest.mark.parametrize('arguments', [('list',), ('show', 'a/b'), ('graph',)])
def test_all_but_check_need_a_package_path(specs, arguments):
    status, _, err = specs(*arguments)
    assert status == 2 and 'expected ROS_PACKAGE_PATH or --package-path' in err


# list

def test_list_has_all_specs_by_kind(specs):
    status, out, err = specs('list', '--package-path', EXAMPLES)
    lines = out.splitlines()
    assert (status, err) == (0, '') and len(lines) == 14
    assert lines[:2] == ['interfaces', '  cafe_capabilities/MobileBase      A base that drives']
    assert lines[6:8] == ['semantic interfaces',
                          '  cafe_capabilities/FrontCamera     redefines cafe_capabilities/Camera']
    assert lines[8] == 'providers'


@needs_corpus
def test_list_of_the_corpus(specs):
    status, out, err = specs('list', '--json', '--package-path', CORPUS)
    kinds = [spec['spec_type'] for spec in json.loads(out)['specs']]
    assert (status, err) == (0, '')
    assert [kinds.count(kind) for kind in ('interface', 'semantic_interface', 'provider')] == [
        13, 2, 15]


# show

def test_show_of_a_semantic_interface_is_what_its_clients_see(specs):
    status, out, _ = specs('show', 'cafe_capabilities/FrontCamera', '--package-path', EXAMPLES)
    assert status == 0
    assert out.splitlines()[3:] == [
        'redefines cafe_capabilities/Camera', 'provides topics',
        '  front/camera/image_raw    sensor_msgs/Image',
        '  front/camera/camera_info  sensor_msgs/CameraInfo', 'provides services',
        '  front/camera/set_camera_info  sensor_msgs/SetCameraInfo', 'providers',
        '  cafe_capabilities/front_camera']


def test_show_of_a_provider_has_what_starts_before_it(specs):
    status, out, _ = specs('show', 'cafe_capabilities/front_camera', '--package-path', EXAMPLES)
    assert status == 0
    assert out.splitlines()[3:] == [
        'implements cafe_capabilities/FrontCamera', 'launch_file ../launch/front_camera.launch',
        'depends on', '  cafe_capabilities/MobileBase by cafe_capabilities/turtlebot_base',
        'to start, in this order', '  cafe_capabilities/turtlebot_base',
        '  cafe_capabilities/front_camera']


def test_show_of_a_provider_that_cannot_start_has_the_faults(specs):
    _, out, _ = specs('show', 'cafe_capabilities/tray_scale', '--package-path', EXAMPLES)
    assert out.endswith("faults\n  provider 'cafe_capabilities/tray_scale' depends on "
                        "'cafe_capabilities/Lift': no provider implements it\n")


def test_show_of_a_provider_looks_at_the_launch_files_that_it_needs(specs, tmp_path):
    spec = 'spec_version: 1\nspec_type: %s\nname: %s\n'
    make_package(
        tmp_path, 'ours', [('capability_interface', 'Base.yaml'),
                           ('capability_provider', 'base.yaml')],
        Base_yaml=spec % ('interface', 'Base'),
        base_yaml=spec % ('provider', 'base') + 'implements: ours/Base\nlaunch_file: no.launch\n')
    _, out, _ = specs('show', 'ours/base', '--package-path', tmp_path)
    assert out.endswith("faults\n  provider 'ours/base': launch file 'no.launch' does not exist\n")


def test_show_of_a_provider_has_the_fault_of_the_file_that_it_lacks(specs, tmp_path):
    spec = 'spec_version: 1\nspec_type: %s\nname: %s\n'
    make_package(
        tmp_path, 'ours', [('capability_interface', 'Base.yaml'),
                           ('capability_interface', 'Arm.yaml'),
                           *(('capability_provider', name + '.yaml') for name in ('a', 'b', 'c'))],
        Base_yaml=spec % ('interface', 'Base'), Arm_yaml=spec % ('interface', 'Arm'),
        a_yaml=spec % ('provider', 'a') + 'implements: ours/Arm\ndepends_on: ours/Base\n',
        b_yaml=spec % ('provider', 'b') + 'implement: ours/Base\n', c_yaml='[')
    _, _, err = specs('show', 'ours/a', '--package-path', tmp_path)
    assert err.startswith('%s:4:1: ' % (tmp_path / 'ours' / 'b.yaml'))
    assert err.splitlines()[1].startswith('1 file has faults: ')
    _, _, err = specs('show', 'ours/Base', '--package-path', tmp_path)
    assert err.startswith('2 files have faults: ')


@pytest.mark.parametrize('name, meant', [
    ('cafe_capabilities/MobleBase', "(did you mean 'cafe_capabilities/MobileBase'?)"),
    ('MobileBase', "(did you mean 'cafe_capabilities/MobileBase'?)"),
    ('cafe_capabilties/MobileBase', "(did you mean 'cafe_capabilities/MobileBase'?)"),
    ('cafe_capabilities/zzz', "the name 'cafe_capabilities/zzz'\n"), ('', "the name ''\n"),
    ('a' * 10000, "...'\n")])
def test_show_of_an_unknown_name_says_what_was_meant(specs, name, meant):
    status, out, err = specs('show', name, '--package-path', EXAMPLES)
    assert (status, out) == (2, '') and meant in err


def test_show_as_json(specs):
    status, out, _ = specs('show', '--json', 'cafe_capabilities/FrontCamera', '--package-path',
                           EXAMPLES)
    answer = json.loads(out)
    assert status == 0 and answer['spec_type'] == 'semantic_interface'
    assert answer['spec']['redefines'] == 'cafe_capabilities/Camera'
    assert 'front/camera/image_raw' in answer['resolved']['interface']['topics']['provides']
    assert answer['providers'] == ['cafe_capabilities/front_camera']
    status, out, _ = specs('show', '--json', 'cafe_capabilities/Camra', '--package-path', EXAMPLES)
    answer = json.loads(out)
    assert status == 2 and answer['spec'] is None
    assert answer['errors'][0]['suggestions'] == ['cafe_capabilities/Camera']


# check

def test_check_of_what_is_right(specs):
    assert specs('check', EXAMPLES) == (
        0, '', 'rocon_uri: no errors and no warnings in 3 packages\n')


@pytest.mark.parametrize('warning_only, status, summary', [
    (True, 0, 'no errors and 1 warning in 1 package'),
    (False, 1, '1 error and 1 warning in 1 package')])
def test_check_ends_with_1_for_errors_not_for_warnings(specs, tmp_path, monkeypatch, warning_only,
                                                       status, summary):
    bad_package(tmp_path, warning_only)
    monkeypatch.chdir(tmp_path)
    found_status, out, err = specs('check', '.')
    assert (found_status, err) == (status, 'rocon_uri: %s\n' % summary)
    assert out.splitlines()[0].startswith(
        "bad/dance.rapp:1:1: warning: unknown key 'colour' in the rapp (expected display, ")


def test_check_without_a_path_checks_the_working_directory(specs, tmp_path, monkeypatch):
    bad_package(tmp_path)
    monkeypatch.chdir(tmp_path)
    status, out, err = specs('check')
    assert (status, out.count('\n')) == (1, 2) and err.endswith(' in 1 package\n')


def test_check_of_a_path_takes_the_package_path_for_what_is_around(specs, monkeypatch):
    assert specs('check', EXAMPLES / 'cafe_rapps')[0] == 1
    monkeypatch.setenv('ROS_PACKAGE_PATH', str(EXAMPLES))
    assert specs('check', EXAMPLES / 'cafe_rapps') == (
        0, '', 'rocon_uri: no errors and no warnings in 1 package\n')


@pytest.mark.parametrize('name, problem', [
    ('gone', 'is not a file, a directory or a package on the package path'),
    ('empty', 'has no package in it')])
def test_check_of_a_bad_path_is_2_whatever_else_was_found(specs, tmp_path, name, problem):
    (tmp_path / 'empty').mkdir()
    bad_package(tmp_path / 'good')
    status, out, err = specs('check', tmp_path / name, tmp_path / 'good')
    assert status == 2 and "%s' %s" % (name, problem) in err and out.count('\n') == 2


def test_check_of_a_package_that_is_none_is_an_error_of_it(specs, tmp_path):
    (tmp_path / 'package.xml').write_text('<package>')
    status, out, err = specs('check', tmp_path)
    assert status == 1 and ': error: ' in out and 'has no package in it' not in err


def test_check_as_json(specs, tmp_path, monkeypatch):
    bad_package(tmp_path)
    monkeypatch.chdir(tmp_path)
    status, out, _ = specs('check', '.', '--json')
    answer = json.loads(out)
    assert status == 1 and answer['packages'] == ['bad'] and answer['errors'] == []
    assert answer['findings'][1] == {
        'file': 'bad/dance.rapp', 'line': 2, 'column': 7, 'severity': 'error',
        'id': 'file-outside', 'text': "icon '../../x.png' is outside the package"}


def test_check_for_github(specs, tmp_path, monkeypatch):
    bad_package(tmp_path)
    monkeypatch.chdir(tmp_path)
    status, out, _ = specs('check', '.', '--format', 'github')
    assert status == 1
    assert out.splitlines()[1] == ('::error file=bad/dance.rapp,line=2,col=7,title=file-outside'
                                   "::icon '../../x.png' is outside the package")


@pytest.mark.parametrize('warning_only, failures, element', [
    (True, '0', 'system-out'), (False, '1', 'failure')])
def test_check_writes_a_report_for_catkin(specs, tmp_path, monkeypatch, warning_only, failures,
                                          element):
    bad_package(tmp_path, warning_only)
    monkeypatch.chdir(tmp_path)
    specs('check', '.', '--junit', 'results/bad/check.xml')
    suite = ElementTree.parse(str(tmp_path / 'results/bad/check.xml')).getroot()
    assert (suite.get('tests'), suite.get('failures'), suite.get('errors')) == ('2', failures, '0')
    assert [case.get('name') for case in suite] == ['bad/dance.rapp', 'bad/package.xml']
    assert all(float(case.get('time')) >= 0 for case in suite)
    assert "unknown key 'colour' in the rapp" in suite.find('testcase/' + element).text


def test_check_whose_report_cannot_be_written_is_2(specs, tmp_path):
    (tmp_path / 'file').write_text('')
    status, _, err = specs('check', EXAMPLES, '--junit', tmp_path / 'file' / 'check.xml')
    assert status == 2 and 'cannot write' in err
    status, out, _ = specs('check', EXAMPLES, '--json', '--junit', tmp_path / 'file' / 'check.xml')
    [error] = json.loads(out)['errors']
    assert status == 2 and error['file'] == str(tmp_path / 'file' / 'check.xml')


def test_check_of_a_bad_path_writes_no_report_that_it_passed(specs, tmp_path):
    assert specs('check', tmp_path, '--junit', tmp_path / 'check.xml')[0] == 2
    assert not (tmp_path / 'check.xml').exists()


@needs_corpus
def test_check_of_the_corpus_finds_errors(specs):
    status, out, err = specs('check', CORPUS)
    assert status == 1 and err.endswith(' in 6 packages\n')
    assert all(line.count(': error: ') + line.count(': warning: ') == 1
               for line in out.splitlines())


# graph

def test_graph_has_a_node_for_each_and_an_edge_for_each_relation(specs):
    _, out, _ = specs('graph', '--json', '--package-path', EXAMPLES)
    answer = json.loads(out)
    kinds = {node['id']: node['kind'] for node in answer['nodes']}
    edges = {(edge['from'].rpartition('/')[2], edge['kind'], edge['to'].rpartition('/')[2],
              edge['preferred']) for edge in answer['edges']}
    assert kinds['cafe_capabilities/FrontCamera'] == 'semantic interface'
    assert kinds['cafe_capabilities/Camera'] == 'interface'
    assert kinds['cafe_capabilities/espeak'] == 'provider'
    assert (kinds['#cafe_rapps/patrol'], kinds['#cafe_rapps/round']) == ('app', 'virtual app')
    assert {('FrontCamera', 'redefines', 'Camera', None), ('espeak', 'implements', 'Speech', None),
            ('front_camera', 'depends on', 'MobileBase', 'cafe_capabilities/turtlebot_base'),
            ('patrol', 'requires', 'FrontCamera', None),
            ('patrol', 'inherits from', 'round', None)} <= edges
    assert 'missing' not in kinds.values()


def test_what_is_named_and_not_there_is_in_the_graph(specs, tmp_path):
    make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp')],
                 dance_rapp='required_capabilities: [{name: ours/Legs}]')
    _, out, _ = specs('graph', '--package-path', tmp_path)
    assert '"ours/Legs" [label="Legs\\nnot there", shape=box, style="filled,dashed"' in out
    assert '"#ours/dance" -> "ours/Legs" [arrowhead=vee' in out


def test_graph_of_an_app_that_cannot_be_read_has_its_fault(specs, tmp_path):
    make_package(tmp_path, 'ours', [('rocon_app', 'dance.rapp'), ('rocon_app', 'sing.rapp')],
                 dance_rapp='launch: 7', sing_rapp='launch: 7')
    status, _, err = specs('graph', '--package-path', tmp_path, '--app', 'ours/dance')
    assert status == 2 and err.splitlines()[1] == (
        '%s:1:9: launch is 7, expected text' % (tmp_path / 'ours' / 'dance.rapp'))
    assert err.splitlines()[2].startswith('1 file has faults: ')


HOSTILE = 'a"];\\x -> "</svg>\n\u202e\udcff<b>&amp;\\'


@needs_dot
def test_any_name_can_be_drawn():
    nodes = {'#' + HOSTILE: Node(HOSTILE, 'app'), 'b': Node('b', 'missing')}
    text = dot_text(SpecGraph(nodes, [Edge('#' + HOSTILE, 'b', 'depends on', HOSTILE)]))
    done = subprocess.run(['dot', '-Tsvg'], input=text.encode(), stdout=subprocess.PIPE, check=True)
    groups = [group for group in ElementTree.fromstring(done.stdout).iter()
              if group.get('class') in ('node', 'edge')]
    assert [group.get('class') for group in groups] == ['node', 'node', 'edge']


@needs_dot
@pytest.mark.parametrize('name, start', [('x.svg', b'<?xml'), ('x.PNG', b'\x89PNG'),
                                         ('x.pdf', b'%PDF'), ('x.dot', b'digraph')])
def test_graph_writes_a_picture(specs, tmp_path, name, start):
    assert specs('graph', '--package-path', EXAMPLES, '--output', tmp_path / name) == (0, '', '')
    assert (tmp_path / name).read_bytes().startswith(start)


@needs_dot
@pytest.mark.parametrize('name, problem', [
    ('x.jpg', 'ends in none of .dot, .svg, .png and .pdf'), ('gone/x.svg', 'cannot draw'),
    ('gone/x.dot', 'cannot write')])
def test_graph_that_cannot_be_written_is_an_error(specs, tmp_path, name, problem):
    status, out, err = specs('graph', '--package-path', EXAMPLES, '--output', tmp_path / name)
    assert (status, out) == (2, '') and problem in err and err.count('\n') == 1


def test_graph_without_graphviz_says_what_to_do(specs, tmp_path, monkeypatch):
    monkeypatch.setenv('PATH', str(tmp_path))
    status, _, err = specs('graph', '--package-path', EXAMPLES, '--output', tmp_path / 'x.svg')
    assert status == 2 and 'install graphviz' in err


@pytest.fixture
def graph(capsys):
    """The nodes by id and the edges of the graph of the examples, as the verb has them in JSON."""
    def run(*arguments, package_path=EXAMPLES):
        main(['specs', 'graph', '--json', '--package-path', str(package_path),
              *map(str, arguments)])
        answer = json.loads(capsys.readouterr().out)
        return {node['id']: node for node in answer['nodes']}, answer['edges']
    return run


def states(nodes):
    return {key.rpartition('/')[2]: (node['state'], node['fault']) for key, node in nodes.items()}


def test_the_graph_shows_what_is_wrong_and_why(graph):
    nodes, _ = graph()
    found = states(nodes)
    assert found['Lift'] == ('fails', 'no-provider')
    assert found['Speech'] == ('fails', 'ambiguous')
    assert found['serve'] == found['greet'] == ('fails', '')
    assert {found[name] for name in ('carry', 'radio', 'patrol', 'MobileBase')} == {('', '')}
    assert 'no provider implements it' in nodes['cafe_capabilities/Lift']['problem']


def test_the_graph_shows_what_a_robot_can_run(graph):
    found = states(graph('--robot', 'rocon:/turtlebot2/bob', '--defaults',
                         EXAMPLES / 'defaults.yaml')[0])
    assert {name for name, (state, _) in found.items() if state == 'runs'} == {
        'patrol', 'greet', 'radio', 'MobileBase', 'turtlebot_base', 'FrontCamera', 'front_camera',
        'Speech', 'festival'}
    assert found['carry'] == found['fetch_a_drink'] == ('fails', 'platform')
    assert found['espeak'] == ('unused', '')


def test_the_graph_of_one_app_has_what_it_needs(graph, specs):
    nodes, edges = graph('--app', 'cafe_rapps/greet')
    assert set(nodes) == {'#cafe_rapps/greet', 'cafe_capabilities/Speech',
                          'cafe_capabilities/espeak', 'cafe_capabilities/festival'}
    assert {edge['kind'] for edge in edges} == {'requires', 'implements'}
    status, _, err = specs('graph', '--app', 'cafe_rapps/gret', '--package-path', EXAMPLES)
    assert status == 2 and "did you mean 'cafe_rapps/greet'?" in err


def test_launch_files_and_cycles_are_in_the_graph(graph, tmp_path):
    interface = '{name: %s, spec_version: 1, spec_type: interface, interface: }'
    provider = '{name: %s, spec_version: 1, spec_type: provider, implements: ours/%s, %s}'
    make_package(
        tmp_path, 'ours', [('capability_interface', 'A.yaml'), ('capability_interface', 'B.yaml'),
                           ('capability_provider', 'a.yaml'), ('capability_provider', 'b.yaml'),
                           ('capability_provider', 'c.yaml'), ('rocon_app', 'dance.rapp')],
        A_yaml=interface % 'A', B_yaml=interface % 'B',
        a_yaml=provider % ('a', 'A', 'depends_on: {ours/B: {provider: ours/b}}'),
        b_yaml=provider % ('b', 'B', 'depends_on: {ours/A: {provider: ours/a}}'),
        c_yaml=provider % ('c', 'B', 'launch_file: gone.launch'),
        dance_rapp='{compatibility: "rocon:/", launch: gone.launch}')
    found = states(graph(package_path=tmp_path)[0])
    assert found == {'A': ('', ''), 'B': ('', ''), 'a': ('fails', 'cycle'), 'b': ('fails', 'cycle'),
                     'c': ('fails', 'launch-missing'), 'dance': ('fails', 'launch-missing')}


def test_an_interface_runs_beside_a_semantic_one_that_redefines_it(graph, tmp_path):
    interface = '{name: %s, spec_version: 1, spec_type: interface, interface: }'
    provider = '{name: %s, spec_version: 1, spec_type: provider, implements: ours/%s, %s}'
    make_package(
        tmp_path, 'ours',
        [('capability_interface', 'View.yaml'), ('capability_interface', 'Camera.yaml'),
         ('semantic_capability_interface', 'Front.yaml'), ('capability_provider', 'view.yaml'),
         ('capability_provider', 'camera.yaml'), ('capability_provider', 'front.yaml'),
         ('rocon_app', 'look.rapp')],
        View_yaml=interface % 'View', Camera_yaml=interface % 'Camera',
        Front_yaml='{name: Front, spec_version: 1, spec_type: semantic_interface, '
                   'redefines: ours/Camera}',
        view_yaml=provider % ('view', 'View', 'depends_on: {ours/Camera: {provider: ours/front}}'),
        camera_yaml=provider % ('camera', 'Camera', ''),
        front_yaml=provider % ('front', 'Front', ''), look_launch='<launch/>',
        look_rapp='{compatibility: "rocon:/", launch: look.launch, '
                  'required_capabilities: [{name: ours/View}, {name: ours/Camera}]}')
    found = states(graph('--robot', 'rocon:/pr2/bob', package_path=tmp_path)[0])
    assert found == dict.fromkeys(['look', 'View', 'view', 'Camera', 'camera', 'Front', 'front'],
                                  ('runs', ''))


def test_the_picture_reads_from_the_app_to_the_provider_and_has_frames_and_a_legend(specs):
    _, out, _ = specs('graph', '--package-path', EXAMPLES)
    assert '"cafe_capabilities/Speech" -> "cafe_capabilities/espeak" [arrowhead=empty' in out
    assert '"#cafe_rapps/greet" -> "cafe_capabilities/Speech"' in out
    assert out.count('subgraph "cluster_') == 3 and 'subgraph "cluster_cafe_rapps"' in out
    assert 'does not work, and why' in out and 'white head: is implemented by' in out
    assert r'"cafe_capabilities/Lift" [label="Lift\nno provider"' in out


@needs_dot
def test_the_picture_of_many_apps_has_the_proportions_of_a_screen(specs, tmp_path):
    for number in range(4):
        make_package(tmp_path, 'caps_%d' % number, [('capability_interface', 'Base.yaml')],
                     Base_yaml='{name: Base, spec_version: 1, spec_type: interface, interface: }')
        make_package(
            tmp_path, 'apps_%d' % number,
            [('rocon_app', 'a%d.rapp' % app) for app in range(10)],
            **{'a%d_rapp' % app: '{compatibility: "rocon:/", launch: a.launch, '
               'required_capabilities: [{name: caps_%d/Base}]}' % ((number + app) % 4)
               for app in range(10)})
    assert specs('graph', '--package-path', tmp_path, '--output', tmp_path / 'x.svg')[0] == 0
    root = ElementTree.parse(str(tmp_path / 'x.svg')).getroot()
    width, height = (float(root.get(key)[:-2]) for key in ('width', 'height'))
    assert 0.4 <= height / width <= 0.8
