"""The verb apps: what a robot can run, and why not the others."""
from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from made_packages import make_package
from sources import ROOT

from rocon_uri.cli import main

EXAMPLES = ROOT / 'examples' / 'workspace'
CORPUS = os.environ.get('ROCON_URI_CORPUS')
needs_corpus = pytest.mark.skipif(not CORPUS, reason='ROCON_URI_CORPUS is not set')
ROBOT = 'rocon:/turtlebot2/bob/noetic/focal'


pytestmark = pytest.mark.usefixtures('no_packages_around')


@pytest.fixture
def apps(capsys):
    """Run the verb, and return its status, output lines and errors."""
    def run(*arguments):
        status = main(['apps', *map(str, arguments)])
        out, err = capsys.readouterr()
        return status, out.splitlines(), err
    return run


@pytest.fixture
def apps_json(capsys):
    """Run the verb, and return its status and the object."""
    def run(*arguments):
        status = main(['apps', '--json', *map(str, arguments)])
        return status, json.loads(capsys.readouterr().out)
    return run


def dance(workspace, text='compatibility: rocon:/kobuki\nlaunch: dance.launch\n', name='ours'):
    return make_package(workspace, name, [('rocon_app', 'dance.rapp')], dance_rapp=text,
                        dance_launch='<launch/>')


def test_what_runs_is_listed_and_nothing_else(apps):
    assert apps('--robot', ROBOT, '--package-path', EXAMPLES) == (0, [
        ROBOT + ' can run 2 of 7 apps:',
        '  cafe_rapps/patrol         Patrol: Looks at every table and says which ones are dirty',
        '  cafe_rapps/radio          Radio: Plays music',
        'cannot run 5: --all, or the NAME of one, shows why'], '')


def test_the_first_hundred_apps_have_near_misses(tmp_path, apps):
    names = ['a%03d' % number for number in range(102)]
    app = ("{compatibility: 'rocon:/', launch: a.launch, "
           "required_capabilities: [{name: ours/Camra}]}")
    make_package(tmp_path, 'ours', [('capability_interface', 'Camera.yaml'), *(
        ('rocon_app', name + '.rapp') for name in names)],
        Camera_yaml='name: Camera\nspec_version: 1\nspec_type: interface\ninterface: {}\n',
        **{name + '_rapp': app for name in names})
    _, lines, _ = apps('--robot', ROBOT, '--package-path', tmp_path, '--all')
    reasons = [line for line in lines if 'no package exports this capability' in line]
    assert ['ours/Camera' in reason for reason in reasons] == [True] * 100 + [False] * 2


def test_all_says_what_does_not_run_and_why(apps):
    status, lines, _ = apps('--robot', ROBOT, '--package-path', EXAMPLES, '--all')
    text = '\n'.join(lines)
    assert status == 0
    assert '      with cafe_capabilities/turtlebot_base, cafe_capabilities/front_camera' in lines
    assert lines[6] == 'and cannot run:'
    for name in 'radio', 'greet':
        assert any(line.startswith('      in ')
                   and line.endswith('cafe_rapps/rapps/%s/%s.rapp' % (name, name))
                   for line in lines)
    for reason in (
            "      'rocon:/cafe_cart' does not include this robot: hardware_platform is turtlebot2",
            "      capability 'cafe_capabilities/Speech': several providers implement it",
            "' depends on 'cafe_capabilities/Lift': no provider implements it"):
        assert reason in text
    assert '        .  hardware_platform      cafe_cart  turtlebot2  nothing' in lines
    assert '        x  application_framework  *          noetic      noetic' in lines
    assert lines[-2:] == ['(x fits, . does not)', 'Virtual, as parents of others: cafe_rapps/round']


def test_defaults_choose_among_providers(apps, tmp_path):
    for defaults in EXAMPLES / 'defaults.yaml', tmp_path / 'plain.yaml':
        if defaults.parent == tmp_path:
            defaults.write_text('cafe_capabilities/Speech: cafe_capabilities/espeak')
        status, lines, _ = apps('--robot', ROBOT, '--package-path', EXAMPLES,
                                '--defaults', defaults)
        assert status == 0 and 'cafe_rapps/greet ' in '\n'.join(lines)


def test_a_misspelt_default_is_mentioned_and_one_of_another_package_is_not(apps, tmp_path):
    defaults = tmp_path / 'defaults.yaml'
    defaults.write_text('cafe_capabilities/Speach: cafe_capabilities/espeak\n'
                        'elsewhere/Lift: elsewhere/lift\n')
    status, lines, err = apps('--robot', ROBOT, '--package-path', EXAMPLES, '--defaults', defaults)
    assert status == 0 and lines
    assert err.splitlines() == [
        "rocon_uri: note: a default for 'cafe_capabilities/Speach' is not used: there is no such "
        "interface (did you mean 'cafe_capabilities/Speech' or 'cafe_capabilities/Tray' or "
        "'cafe_capabilities/Camera'?)"]


@pytest.mark.parametrize('content, error', [
    (None, 'No such file or directory'), ('[', 'did not find expected node content'),
    ('- a', '1:1: the file is a list, expected a mapping from interfaces to providers'),
    ('a: 7', "1:4: the default provider of 'a' is 7, expected text"),
    ('a: b\na: c', "2:1: duplicate key 'a'")])
def test_bad_defaults_are_an_error_and_all_else_is_judged(apps, tmp_path, content, error):
    path = tmp_path / 'defaults.yaml'
    if content is not None:
        path.write_text(content)
    status, lines, err = apps('--robot', ROBOT, '--package-path', EXAMPLES, '--defaults', path)
    assert status == 2 and error in err and str(path) in err
    assert lines[0] == ROBOT + ' can run 2 of 7 apps:'


def test_a_robot_that_another_package_registers_runs_its_apps(apps):
    status, lines, err = apps('--robot', 'rocon:/cafe_cart/trolley', '--package-path', EXAMPLES)
    assert (status, err) == (0, '') and '  cafe_cart/carry ' in '\n'.join(lines)
    assert [line for line in lines if line.startswith('  cafe_cart/ring   ')]


def test_nothing_that_runs_is_status_1(apps, tmp_path):
    dance(tmp_path)
    assert apps('--robot', ROBOT, '--package-path', tmp_path) == (
        1, [ROBOT + ' can run 0 of 1 apps',
            'cannot run 1: --all, or the NAME of one, shows why'], '')


def test_the_package_path_is_that_of_ros_and_the_robot_this_machine(apps, tmp_path, monkeypatch):
    dance(tmp_path / 'a', 'compatibility: rocon:/pc\nlaunch: dance.launch')
    dance(tmp_path / 'b', name='theirs')
    monkeypatch.setenv('ROS_PACKAGE_PATH', os.pathsep.join(
        [str(tmp_path / 'a'), str(tmp_path / 'not_there'), str(tmp_path / 'b')]))
    status, lines, err = apps()
    assert (status, err) == (0, '')
    assert lines[0].startswith('rocon:/pc/') and lines[0].endswith(' can run 1 of 2 apps:')
    assert lines[1:-1] == ['  ours/dance']


def test_without_any_package_path_it_says_what_is_needed(apps):
    assert apps('--robot', ROBOT)[::2] == (
        2, 'rocon_uri: no package path, expected ROS_PACKAGE_PATH or --package-path\n')


def test_a_folder_that_is_not_there_is_an_error_and_hides_no_other(apps, tmp_path):
    path = '%s%s%s' % (tmp_path / 'gone', os.pathsep, EXAMPLES)
    status, lines, err = apps('--robot', ROBOT, '--package-path', path)
    assert status == 2 and len(lines) == 4 and "gone' is not a directory" in err


def test_a_bad_robot_is_an_error(apps):
    status, lines, err = apps('--robot', 'rocon:/turtlebot2/3bob', '--package-path', EXAMPLES)
    assert (status, lines) == (2, []) and "name '3bob'" in err


def test_a_robot_that_is_not_registered_is_an_error_and_gets_what_runs_anywhere(apps):
    status, lines, err = apps('--robot', 'rocon:/turtelbot2/bob', '--package-path', EXAMPLES)
    assert status == 2 and "did you mean 'turtlebot2'" in err
    assert lines == ['rocon:/turtelbot2/bob can run 1 of 7 apps:',
                     '  cafe_rapps/radio          Radio: Plays music',
                     'cannot run 6: --all, or the NAME of one, shows why']


def test_a_robot_with_one_slash_too_many_is_mentioned(apps):
    status, _, err = apps('--robot', 'rocon://turtlebot2/bob', '--package-path', EXAMPLES)
    assert status == 0 and "is read as 'rocon:/turtlebot2/bob'" in err


def test_files_with_faults_are_counted_and_spoil_no_answer(apps, tmp_path):
    dance(tmp_path, 'launch: 7', 'bad')
    (make_package(tmp_path, 'worse') / 'package.xml').write_text('<package>')
    make_package(tmp_path, 'specs', [('capability_provider', 'p.yaml')], p_yaml='[')
    dance(tmp_path)
    status, lines, err = apps('--robot', 'rocon:/kobuki/bob', '--package-path', tmp_path)
    assert (status, lines[1:]) == (0, ['  ours/dance'])
    assert err == '3 files have faults: rocon_uri specs check %s\n' % tmp_path


@pytest.mark.parametrize('by', ['argument', 'environment'])
def test_the_command_that_is_named_shows_the_faults_wherever_it_runs(
        apps, tmp_path, monkeypatch, capsys, by):
    pytest.importorskip('catkin_pkg', reason='catkin_pkg is not installed')
    dance(tmp_path / "a robot's", 'launch: 7', 'bad')
    (tmp_path / 'elsewhere').mkdir()
    monkeypatch.chdir(tmp_path / 'elsewhere')
    path, given = "%s:../a robot's" % EXAMPLES, []
    if by == 'argument':
        given = ['--package-path', path]
    else:
        monkeypatch.setenv('ROS_PACKAGE_PATH', path)
    _, _, err = apps('--robot', ROBOT, *given)
    counted, _, command = err.partition(': ')
    assert counted == '1 file has faults'
    assert main(shlex.split(command)[1:]) == 1
    assert capsys.readouterr() == (
        "%s/a robot's/bad/dance.rapp:1:9: error: launch is 7, expected text [wrong-value]\n"
        % tmp_path, 'rocon_uri: 1 error and no warnings in 1 package\n')


def test_the_command_itself_says_nothing_twice_and_knows_all_rules(tmp_path):
    """A process of its own: nothing in it was set up or loaded before."""
    dance(tmp_path, 'launch: 7', 'bad')
    (tmp_path / 'rules.yaml').write_text('hardware_platform: {robot: [our_robot]}')
    path = '%s%s%s' % (tmp_path, os.pathsep, EXAMPLES)      # where another robot is registered
    done = subprocess.run(
        [sys.executable, str(ROOT / 'scripts' / 'rocon_uri'), 'apps',
         '--robot', 'rocon:/our_robot', '--package-path', path],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True,
        env=dict(os.environ, ROCON_URI_RULES=str(tmp_path / 'rules.yaml')))
    assert done.stderr == '1 file has faults: rocon_uri specs check %s --package-path %s\n' % (
        tmp_path, path)
    assert done.returncode == 0 and 'cafe_rapps/radio' in done.stdout


def test_control_characters_of_files_do_not_reach_the_terminal(apps, tmp_path):
    dance(tmp_path, '{compatibility: "rocon:/", launch: dance.launch, '
                    'display: "\\e[31mA\\nB\\u202e"}')
    status, lines, _ = apps('--robot', ROBOT, '--package-path', tmp_path)
    assert (status, lines[1:]) == (0, ['  ours/dance  \\x1b[31mA B\\u202e'])


def test_a_file_name_that_is_no_text_is_no_traceback(apps, tmp_path):
    folder = make_package(tmp_path, 'ours', [('rocon_app', 'caf\u00e9.rapp')], d_launch='<launch/>')
    (folder / 'caf\u00e9.rapp').write_text('{compatibility: "rocon:/", launch: d.launch}')
    os.rename(os.fsencode(str(tmp_path)) + b'/ours', os.fsencode(str(tmp_path)) + b'/our\xff')
    status, lines, _ = apps('--robot', ROBOT, '--package-path', tmp_path, '--all')
    assert (status, lines[1]) == (0, '  ours/caf\u00e9')


def test_json_has_what_runs_and_with_all_the_reasons(apps_json):
    status, answer = apps_json('--robot', ROBOT, '--package-path', EXAMPLES)
    assert status == 0 and answer['errors'] == []
    assert answer['robot']['uri'] == ROBOT
    assert [app['name'] for app in answer['apps']] == ['cafe_rapps/patrol', 'cafe_rapps/radio']
    patrol = answer['apps'][0]
    assert patrol['runs'] and not patrol['virtual'] and patrol['reasons'] == []
    assert patrol['providers'] == ['cafe_capabilities/turtlebot_base',
                                   'cafe_capabilities/front_camera']
    assert patrol['display'] == 'Patrol' and patrol['launch'].endswith('/patrol/patrol.launch')

    status, answer = apps_json('--robot', ROBOT, '--package-path', EXAMPLES, '--all')
    reasons = {app['name']: app['reasons'] for app in answer['apps']}
    assert len(reasons) == 8
    assert [reason['kind'] for reason in reasons['cafe_rapps/serve']] == ['no-provider']
    assert reasons['cafe_rapps/serve'][0]['fault']['capability'] == 'cafe_capabilities/Lift'
    assert reasons['cafe_rapps/greet'][0]['fault']['kind'] == 'ambiguous'
    (platform,) = reasons['cafe_cart/carry']
    assert platform['kind'] == 'platform' and platform['fault'] is None
    assert platform['fields'][0] == {
        'field': 'hardware_platform', 'a': 'cafe_cart', 'b': 'turtlebot2', 'compatible': False,
        'in_common': ''}
    assert [app['name'] for app in answer['apps'] if app['virtual']] == ['cafe_rapps/round']


def test_json_has_the_errors(apps_json, tmp_path):
    dance(tmp_path, 'launch: 7')
    status, answer = apps_json('--robot', 'rocon:/zork', '--package-path', tmp_path)
    assert (status, answer['apps']) == (2, [])
    assert [(error['field'], error['line']) for error in answer['errors']] == [
        ('hardware_platform', None), (None, 1)]


@needs_corpus
def test_the_corpus_on_a_kobuki(apps, apps_json):
    """It holds no launch files; with them, eight of its apps would run."""
    defaults = Path(CORPUS) / 'kobuki_capabilities/param/defaults_kobuki_capabilities.yaml'
    given = ('--robot', 'rocon:/kobuki/bob/indigo/trusty', '--package-path', CORPUS,
             '--defaults', defaults)
    run = ['kobuki_rapps/auto_docking', 'kobuki_rapps/random_walker', 'rocon_apps/listener',
           'rocon_apps/talker', 'rocon_apps/lion_chirp', 'rocon_apps/angry_cat_chirp',
           'rocon_apps/meow_chirp', 'rocon_apps/moo_chirp']
    status, lines, err = apps(*given, '--ignore', 'launch-missing')
    assert (status, err) == (0, '')
    assert [line.split()[0] for line in lines[1:]] == run
    status, answer = apps_json(*given, '--all')
    assert status == 1
    kinds = {app['name']: [reason['kind'] for reason in app['reasons']] for app in answer['apps']}
    assert [name for name, found in kinds.items() if set(found) == {'launch-missing'}] == run
    # its own, and those of the providers that it needs
    assert len(kinds['rocon_apps/talker']) == 1 and len(kinds['kobuki_rapps/random_walker']) > 1


# Launch files

def kinds(answer):
    return [reason['kind'] for app in answer['apps'] for reason in app['reasons']]


@pytest.mark.parametrize('launch, content, kind, text', [
    ('dnace.launch', '<launch/>', 'launch-missing',
     "launch file 'dnace.launch' does not exist (did you mean 'dance.launch'?)"),
    ('../dance.launch', '<launch/>', 'launch-outside',
     "launch file '../dance.launch' is outside the package"),
    ('.', '<launch/>', 'launch-unreadable', "launch file '.' is not a file"),
    ('dance.launch', '<launch>', 'launch-not-xml',
     "launch file 'dance.launch' is not XML: no element found (line 1, column 9)"),
    ('dance.launch', '<lunch/>', 'launch-no-launch',
     "launch file 'dance.launch' has '<lunch>' at its top, expected <launch> (line 1, column 1)"),
])
def test_an_app_whose_launch_file_cannot_be_started_does_not_run(
        apps, apps_json, tmp_path, launch, content, kind, text):
    folder = dance(tmp_path, 'compatibility: rocon:/kobuki\nlaunch: %s\n' % launch)
    (folder / 'dance.launch').write_text(content)
    given = ('--robot', 'rocon:/kobuki/bob', '--package-path', tmp_path, '--all')
    status, lines, _ = apps(*given)
    assert (status, lines[1:3], lines[4:]) == (1, [
        'and cannot run:', '  ours/dance'], ['      %s [%s]' % (text, kind)])
    status, answer = apps_json(*given)
    assert status == 1 and answer['apps'][0]['reasons'] == [
        {'kind': kind, 'text': text, 'fields': None, 'fault': None}]
    status, answer = apps_json(*given, '--ignore', kind)
    assert status == 0 and kinds(answer) == [] and answer['apps'][0]['runs']


def test_each_kind_of_reason_can_be_ignored(apps_json):
    given = ('--robot', ROBOT, '--package-path', EXAMPLES, '--all')
    _, answer = apps_json(*given)
    assert set(kinds(answer)) == {'virtual', 'platform', 'no-provider', 'ambiguous'}
    _, answer = apps_json(*given, '--ignore', 'platform', '--ignore', 'ambiguous')
    assert set(kinds(answer)) == {'virtual', 'no-provider'}
    _, answer = apps_json(*given, '--ignore', 'virtual')
    assert set(kinds(answer)) == {'platform', 'no-provider', 'ambiguous'}


@pytest.mark.parametrize('given, hint', [
    ('launch-mising', "'launch-mising' is not the ID of a reason (did you mean 'launch-missing'"),
    ('x', "'x' is not the ID of a reason, expected one of virtual, platform, no-interface, ")])
def test_to_ignore_what_is_no_reason_is_an_error(capsys, given, hint):
    assert main(['apps', '--ignore', given]) == 2
    assert hint in capsys.readouterr().err


# One app

def test_one_app_is_judged_with_all_that_was_judged(apps):
    status, lines, err = apps('cafe_rapps/greet', '--robot', ROBOT, '--package-path', EXAMPLES)
    assert (status, err) == (1, '')
    assert lines[0] == 'no: %s cannot run cafe_rapps/greet' % ROBOT
    assert lines[1:3] == ['  Greet', '  Says hello to whoever comes in']
    assert lines[3].endswith('cafe_rapps/rapps/greet/greet.rapp')
    assert lines[4:6] == ['judged  (x fits, . does not)',
                          "  x  platform   'rocon:/robot/*/ros' includes this robot"]
    assert lines[6].startswith('  x  launch     ') and lines[6].endswith('greet.launch')
    assert lines[7].startswith("  .  ambiguous  capability 'cafe_capabilities/Speech': several ")
    assert lines[8:] == ['cafe_capabilities/Speech',
                         '  requires  topics  /say  std_msgs/String  in the app greet/say']


def test_what_is_ignored_is_not_said_to_fit(apps):
    given = '--robot', ROBOT, '--package-path', EXAMPLES, '--ignore', 'platform'
    status, lines, _ = apps('cafe_cart/carry', *given)
    assert (status, lines[0]) == (0, 'yes: %s can run cafe_cart/carry' % ROBOT)
    assert [line.split()[:2] for line in lines[5:]] == [['x', 'launch']]
    status, lines, _ = apps('cafe_rapps/radio', *given)
    assert [line.split()[:2] for line in lines[5:]] == [['x', 'platform'], ['x', 'launch']]
    _, lines, _ = apps('cafe_rapps/serve', *given, '--ignore', 'no-provider')
    assert [line.split()[:3] for line in lines[5:8]] == [
        ['x', 'platform', "'rocon:/turtlebot2|waiterbot'"], ['x', 'launch', lines[6].split()[2]],
        ['x', 'capability', 'cafe_capabilities/MobileBase']]
    assert 'capability  cafe_capabilities/Tray' not in '\n'.join(lines)


def test_an_app_may_have_nothing_to_judge(apps, tmp_path):
    dance(tmp_path, 'display: Dance\n')
    status, lines, _ = apps('ours/dance', '--robot', ROBOT, '--package-path', tmp_path,
                            '--ignore', 'virtual')
    assert (status, lines[-1]) == (0, 'judged  (x fits, . does not)')


def test_white_space_in_a_path_is_left_as_it_is(apps, tmp_path):
    dance(tmp_path / 'two  blanks')
    path = tmp_path / 'two  blanks' / 'ours' / 'dance.rapp'
    given = '--robot', 'rocon:/kobuki', '--package-path', tmp_path
    assert '      in %s' % path in apps('--all', *given)[1]
    assert '  in %s' % path in apps('ours/dance', *given)[1]


def test_one_app_that_runs_shows_its_plan_and_the_names_that_it_sees(apps):
    status, lines, _ = apps('cafe_rapps/patrol', '--robot', ROBOT, '--package-path', EXAMPLES)
    assert status == 0
    assert lines[0] == 'yes: %s can run cafe_rapps/patrol' % ROBOT
    start = lines.index('starts for it, in this order')
    assert lines[start - 1] == ('  x  capability  cafe_capabilities/FrontCamera by '
                                'cafe_capabilities/front_camera')
    assert lines[start + 1:start + 6] == [
        '  cafe_capabilities/turtlebot_base', '  cafe_capabilities/front_camera',
        'cafe_capabilities/MobileBase by cafe_capabilities/turtlebot_base',
        '  requires  topics  /cmd_vel  geometry_msgs/Twist  on the robot '
        '/mobile_base/commands/velocity, in the app patrol/velocity',
        '  provides  topics  /odom     nav_msgs/Odometry    in the app patrol/odom']
    # as the semantic interface has them
    assert ('  provides  topics    front/camera/camera_info      sensor_msgs/CameraInfo'
            in lines[start + 6:])


def test_one_app_shows_what_a_provider_of_a_semantic_interface_does_for_it(
        apps, apps_json, tmp_path):
    top = 'spec_version: 1, description: made by a test'
    make_package(
        tmp_path, 'ours', [
            ('capability_interface', 'camera.yaml'),
            ('semantic_capability_interface', 'front.yaml'),
            ('capability_provider', 'usb.yaml'), ('rocon_app', 'dance.rapp')],
        camera_yaml='{name: Camera, spec_type: interface, %s, interface: {topics: {provides: '
                    '{/image: {type: a/A}, /info: {type: a/B}}}}}' % top,
        front_yaml='{name: Front, spec_type: semantic_interface, %s, redefines: ours/Camera, '
                   'remappings: {topics: {/image: /front/image}}}' % top,
        usb_yaml='{name: usb, spec_type: provider, %s, implements: ours/Front, '
                 'remappings: {topics: {/info: /usb/info}}}' % top,
        dance_rapp='{compatibility: "rocon:/", launch: dance.launch, '
                   'required_capabilities: [{name: ours/Camera}]}',
        dance_launch='<launch/>')
    defaults = tmp_path / 'defaults.yaml'
    defaults.write_text('ours/Camera: ours/usb\n')
    given = ('ours/dance', '--robot', ROBOT, '--package-path', tmp_path, '--defaults', defaults)
    status, lines, err = apps(*given)
    assert (status, err) == (0, '')
    assert lines[-6:] == [
        '  x  capability  ours/Camera by ours/usb', 'starts for it, in this order', '  ours/usb',
        'ours/Camera by ours/usb', '  provides  topics  /image  a/A  on the robot /front/image',
        '  provides  topics  /info   a/B  on the robot /usb/info']
    assert apps_json(*given)[1]['apps'][0]['capabilities'][0]['provider'] == 'ours/usb'


def test_one_app_shows_the_table_of_its_platform(apps):
    _, lines, _ = apps('cafe_cart/carry', '--robot', ROBOT, '--package-path', EXAMPLES)
    table = lines[lines.index('platform'):]
    assert table[2] == '  .  hardware_platform      cafe_cart  turtlebot2  nothing'
    assert table[3] == '  x  name                   *          bob         bob'


def test_several_apps_run_only_if_each_does(apps, apps_json):
    given = ('--robot', ROBOT, '--package-path', EXAMPLES)
    assert apps('cafe_rapps/patrol', 'cafe_rapps/radio', *given)[0] == 0
    status, lines, _ = apps('cafe_rapps/radio', 'cafe_rapps/greet', *given)
    assert status == 1 and [line[:3] for line in lines if ROBOT in line] == ['yes', 'no:']
    status, answer = apps_json('cafe_rapps/radio', 'cafe_rapps/greet', *given)
    assert (status, [app['runs'] for app in answer['apps']]) == (1, [True, False])


@pytest.mark.parametrize('name, meant', [
    ('cafe_rapps/gret', 'cafe_rapps/greet'), ('cafe/greet', 'cafe_rapps/greet'),
    ('greet', 'cafe_rapps/greet')])
def test_an_app_that_is_not_there_gets_near_misses(apps, apps_json, name, meant):
    given = (name, 'cafe_rapps/radio', '--robot', ROBOT, '--package-path', EXAMPLES)
    status, lines, err = apps(*given)
    assert (status, err) == (2, "rocon_uri: no app has the name '%s' (did you mean '%s'?)\n" % (
        name, meant))
    assert lines[0] == 'yes: %s can run cafe_rapps/radio' % ROBOT
    status, answer = apps_json(*given)
    assert status == 2 and [app['name'] for app in answer['apps']] == ['cafe_rapps/radio']
    assert answer['errors'][0]['suggestions'] == [meant]


def test_the_faults_that_are_about_what_was_asked_are_shown(apps, tmp_path):
    bad = dance(tmp_path, 'launch: 7', 'bad')
    make_package(tmp_path, 'caps', [('capability_interface', 'Legs.yaml')], Legs_yaml='[')
    dance(tmp_path, '{compatibility: "rocon:/kobuki", launch: dance.launch, '
                    'required_capabilities: [{name: caps/Legs}]}')
    given = ('--robot', 'rocon:/kobuki', '--package-path', tmp_path)
    status, _, err = apps('ours/dance', *given)
    assert status == 1 and str(tmp_path / 'caps' / 'Legs.yaml') in err.splitlines()[0]
    assert err.splitlines()[1].startswith('1 file has faults: ')
    status, _, err = apps('bad/dance', *given)
    assert status == 2 and "no app has the name 'bad/dance'" in err
    assert '%s:1:9: launch is 7, expected text' % (bad / 'dance.rapp') in err
    assert apps('bad/dance', *given, '--html', tmp_path / 'x.html')[2] == err


LEGS = '{name: Legs, spec_version: 1, spec_type: interface, interface: }'
WALK = '{name: %s, spec_version: 1, spec_type: provider, %s: caps/Legs%s}'


@pytest.mark.parametrize('broken, shown', [
    # a provider that nobody names, and no other is there
    ({'walk_yaml': WALK % ('walk', 'implement', '')}, 'walk.yaml'),
    # it could have been: who knows
    ({'walk_yaml': 'caps/Legs: ['}, 'walk.yaml'),
    # a provider that is named
    ({'walk_yaml': WALK % ('walk', 'implements', ', depends_on: {caps/Legs: {provider: caps/run}}'),
      'run_yaml': '['}, 'run.yaml'),
    # one of something else
    ({'walk_yaml': '{name: walk, spec_version: 1, spec_type: provider, implements: caps/Arms}'},
     None),
    # one that is not needed
    ({'walk_yaml': WALK % ('walk', 'implements', ''), 'run_yaml': '['}, None),
])
def test_the_fault_that_a_reason_comes_from_is_shown(apps, tmp_path, broken, shown):
    make_package(tmp_path, 'caps', [
        ('capability_interface', 'Legs.yaml'),
        *(('capability_provider', name.replace('_', '.')) for name in broken)],
        Legs_yaml=LEGS, **broken)
    dance(tmp_path, '{compatibility: "rocon:/kobuki", launch: dance.launch, '
                    'required_capabilities: [{name: caps/Legs}]}')
    given = ('--robot', 'rocon:/kobuki', '--package-path', tmp_path)
    for more in [], ['--json']:
        err = apps('ours/dance', *given, *more)[2]
        if shown is None:
            assert err.startswith('1 file has faults: ')
        else:
            assert err.startswith('%s:' % (tmp_path / 'caps' / shown)) and err.count('\n') == 1
    assert apps(*given)[2].startswith('1 file has faults: ')      # nothing was asked of an app


def test_the_fault_of_an_ancestor_is_shown(apps, tmp_path):
    make_package(tmp_path, 'ours', [('rocon_app', name + '.rapp') for name in 'abcx'],
                 a_rapp='display: 7', b_rapp='parent_name: a', c_rapp='parent_name: ours/d',
                 x_rapp='display: 7')
    given = ('--robot', 'rocon:/kobuki', '--package-path', tmp_path)
    _, _, err = apps('ours/b', *given)
    assert [line.partition(': ')[0] for line in err.splitlines()[1:]] == [
        '%s:1:10' % (tmp_path / 'ours' / 'a.rapp'), '%s:1:14' % (tmp_path / 'ours' / 'b.rapp'),
        '2 files have faults']      # c and x


def test_the_fault_of_a_rules_file_is_shown_where_a_value_is_not_registered(apps, tmp_path):
    made = make_package(tmp_path, 'robots', rules_yaml='hardware_platform: {robot: [ours, 3d]}')
    (made / 'package.xml').write_text((made / 'package.xml').read_text().replace(
        '<export>', '<export><rocon_uri rules="rules.yaml"/>'))
    dance(tmp_path, 'compatibility: rocon:/ours\nlaunch: dance.launch\n')
    dance(tmp_path, name='theirs')
    given, rules = ('--package-path', tmp_path), str(made / 'rules.yaml') + ':1:'
    for arguments, is_shown in ((('--robot', 'rocon:/ours'), True),
                                (('--robot', 'rocon:/kobuki'), False),
                                (('ours/dance', '--robot', 'rocon:/kobuki'), True),
                                (('theirs/dance', '--robot', 'rocon:/kobuki'), False)):
        err = apps(*arguments, *given)[2]
        assert (rules in err) is is_shown
        assert ('1 file has faults: ' in err) is not is_shown


def test_json_of_one_app_has_the_names_of_its_capabilities(apps_json):
    status, answer = apps_json('cafe_rapps/patrol', '--robot', ROBOT, '--package-path', EXAMPLES)
    assert status == 0
    base = answer['apps'][0]['capabilities'][0]
    assert (base['name'], base['provider']) == ('cafe_capabilities/MobileBase',
                                                'cafe_capabilities/turtlebot_base')
    assert base['names'][0] == {
        'kind': 'topics', 'grouping': 'requires', 'name': '/cmd_vel', 'type': 'geometry_msgs/Twist',
        'robot_name': '/mobile_base/commands/velocity', 'app_name': 'patrol/velocity'}


@pytest.mark.parametrize('robot, runs', [('rocon:/turtlebot2/3bob', []), ('zork', []),
                                         ('rocon:/zork', ['cafe_rapps/radio'])])
def test_json_is_one_object_whatever_is_wrong(apps_json, robot, runs):
    status, answer = apps_json('--robot', robot, '--defaults', '/no/such/file',
                               '--package-path', EXAMPLES)
    assert status == 2 and [app['name'] for app in answer['apps']] == runs
    assert [error['file'] for error in answer['errors']] == [None, '/no/such/file']
