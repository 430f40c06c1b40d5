"""The apps of app_manager: .app files, the .installed files that list them, and the verdict."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Callable, Dict, List, Tuple

import pytest
from made_packages import make_package

from capabilities.spec_index import SpecIndex
from rocon_uri import Vocabulary, parse
from rocon_uri.apps.app_file import AppFile, InvalidApp, app_from_string
from rocon_uri.apps.installed import app_files_from_package_index, installed_files
from rocon_uri.sources.resources import AMBIGUOUS, MISSING, Resources
from rocon_uri.apps.runnable import REASON_IDS, runnable
from rocon_uri.cli import main
from rocon_uri.sources.packages import find_packages

DANCE = 'platform: pr2\ninterface: ours/dance.interface\nlaunch: ours/dance.launch\n'
Run = Callable[..., Tuple[int, List[str], str]]


@pytest.fixture(autouse=True)
def no_workspace_around(no_packages_around: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('CMAKE_PREFIX_PATH', raising=False)


@pytest.fixture
def apps(capsys: Any) -> Run:
    """Run the verb, and return its status, output lines and errors."""
    def run(*arguments: object) -> Tuple[int, List[str], str]:
        status = main(['apps', *map(str, arguments)])
        out, err = capsys.readouterr()
        return status, out.splitlines(), err
    return run


def package(folder: Path, dance: str = DANCE, listed: Tuple[str, ...] = ('ours/dance',),
            **files: str) -> Path:
    """A package that exports the folder apps with one list of apps, and has the app dance."""
    made = make_package(
        folder, 'ours', apps__dance_app=dance, apps__dance_interface='published_topics: {}\n',
        launch__dance_launch='<launch/>',
        apps__our_installed='apps:\n' + ''.join('  - app: %s\n' % name for name in listed), **files)
    manifest = made / 'package.xml'
    manifest.write_text(manifest.read_text().replace(
        '<export>', '<export><app_manager app_dir="${prefix}/apps"/>'))
    return made


def read(folder: Path) -> Tuple[Dict[str, AppFile], List[str]]:
    found, faults = app_files_from_package_index(find_packages([str(folder)]))
    return found, [str(fault).replace(str(folder) + '/', '') for fault in faults]


# Reading

def test_an_app_is_found_by_the_list_and_named_after_its_package_and_file(tmp_path: Path) -> None:
    made = package(tmp_path, DANCE + 'display: Dance\ndescription: ""\nicon: ours/dance.png\n',
                   media__dance_png='')
    found, faults = read(tmp_path)
    assert faults == [] and list(found) == ['ours/dance']
    app = found['ours/dance']
    assert (app.name, app.package, app.form, app.path) == (
        'ours/dance', 'ours', 'app', str(made / 'apps' / 'dance.app'))
    assert (app.display, app.description, app.platform, app.compatibility, app.run) == (
        'Dance', None, 'pr2', 'rocon:/pr2', None)
    assert app.files == {'interface': str(made / 'apps' / 'dance.interface'),
                         'launch': str(made / 'launch' / 'dance.launch'),
                         'icon': str(made / 'media' / 'dance.png')}
    assert app.position('launch') == (3, 9) and app.required_capabilities == ()


def test_the_name_stands_for_a_display_that_is_not_there() -> None:
    assert app_from_string(DANCE, 'ours/dance').display == 'ours/dance'


@pytest.mark.parametrize('text, fault', [
    ('- a', '1:1: the app is a list, expected a mapping'),
    ('interface: a/b\nlaunch: a/b', '1:1: the app has no platform'),
    ('platfrom: pr2\ninterface: a/b\nlaunch: a/b',
     "1:1: unknown key 'platfrom', and the app has no platform (did you mean 'platform'?)"),
    ('platform: pr2\nlaunch: a/b', '1:1: the app has no interface'),
    ('platform: pr2\ninterface: a/b',
     '1:1: the app has no launch and no run, expected one of them'),
    ('platform: pr2\ninterface: a/b\nlaunch: ""\nrun:',
     '1:1: the app has no launch and no run, expected one of them'),
    ('platform: pr2\ninterface: a/b\nlaunch: a/b\nrun: a/b',
     '4:1: the app has both launch and run, expected one of them'),
    ('platform: 7\ninterface: a/b\nlaunch: a/b', '1:11: platform is 7, expected text'),
    ('platform: pr2\nplatform: pr2\ninterface: a/b\nlaunch: a/b',
     "2:1: duplicate key 'platform'"),
    (DANCE + 'clients: [a]', "4:11: a client is 'a', expected a mapping with a type and a manager"),
    (DANCE + 'clients: [{type: android}]', '4:11: a client has no manager'),
    (DANCE + 'clients: [{manager: {}}]', '4:11: a client has no type'),
    (DANCE + 'clients: [{type: android, manager: 7}]', '4:36: manager is 7, expected a mapping'),
    (DANCE + 'clients: [{type: a, manager: {}, app: 7}]', '4:39: app is 7, expected a mapping'),
])
def test_what_is_no_app_is_refused_with_its_place(text: str, fault: str) -> None:
    with pytest.raises(InvalidApp) as refused:
        app_from_string(text, 'ours/dance', 'dance.app')
    assert str(refused.value) == 'dance.app:' + fault


def test_optional_keys_are_accepted() -> None:
    app_from_string(DANCE + 'clients: [{type: web, manager: {}, app: {a: b}}]\nrun_args: -v\n'
                    'plugins: [{name: p, type: t}]\nplugin_order: [p]\ntimeout: 10\n'
                    'allow_parallel: true\n', 'ours/dance')


@pytest.mark.parametrize('content, fault', [
    ('apps: 7', '1:7: apps is 7, expected a list'), ('app: []', "1:1: unknown key 'app', and the "
     "list of apps has no apps (did you mean 'apps'?)"),
    ('apps: [a]', "1:8: an item of apps is 'a', expected a mapping with an app"),
    ('apps: [{display: a}]', '1:8: an item of apps has no app')])
def test_a_list_that_is_none_is_a_fault(tmp_path: Path, content: str, fault: str) -> None:
    made = package(tmp_path)
    (made / 'apps' / 'our.installed').write_text(content)
    assert read(tmp_path) == ({}, ['ours/apps/our.installed:' + fault])


def test_a_broken_app_costs_only_itself(tmp_path: Path) -> None:
    package(tmp_path, listed=('ours/bad', 'ours/dance', 'ours/dnace', 'our/dance', 'dance'),
            apps__bad_app='platform: all')
    found, faults = read(tmp_path)
    assert list(found) == ['ours/dance']
    assert faults == [
        'ours/apps/bad.app:1:1: the app has no interface',
        "ours/apps/our.installed:4:10: app 'ours/dnace' does not exist: package 'ours' has no file "
        "'dnace.app' (did you mean 'ours/dance'?)",
        "ours/apps/our.installed:5:10: app 'our/dance' does not exist: there is no package 'our' "
        "(did you mean 'ours'?)",
        "ours/apps/our.installed:6:10: app 'dance' is not of the form package/file"]


def test_lists_count_directly_in_each_exported_folder(tmp_path: Path) -> None:
    made = package(tmp_path, apps__below__no_installed='apps: 7', more__b_installed='apps: []')
    manifest = made / 'package.xml'
    manifest.write_text(manifest.read_text().replace(
        '</export>', '<app_manager app_dir="more"/><app_manager app_dir="gone"/></export>'))
    [found] = find_packages([str(tmp_path)]).values()
    assert installed_files(found) == [str(made / 'apps' / 'our.installed'),
                                      str(made / 'more' / 'b.installed')]


# Resources

def test_a_resource_is_found_anywhere_in_its_package_and_only_once(tmp_path: Path) -> None:
    make_package(tmp_path, 'ours', a__b__dance_launch='<launch/>', a__two_launch='',
                 b__two_launch='')
    (tmp_path / 'ours' / '.git').mkdir()
    (tmp_path / 'ours' / '.git' / 'dance.launch').write_text('')
    (tmp_path / 'ours' / 'loop').symlink_to(tmp_path / 'ours')
    resources = Resources(find_packages([str(tmp_path)]))
    found = resources.find('ours/dance.launch')
    assert found.path == str(tmp_path / 'ours' / 'a' / 'b' / 'dance.launch')
    assert resources.find('ours/two.launch')[2:] == (
        AMBIGUOUS, "is ambiguous: package 'ours' has 'a/two.launch' and 'b/two.launch'")
    for name in 'dance.launch', 'ours/', '/dance.launch', 'ours/a/dance.launch':
        assert resources.find(name)[2:] == (MISSING, 'is not of the form package/file')


def test_near_misses_are_not_looked_for_without_end(tmp_path: Path) -> None:
    make_package(tmp_path, 'ours', **{'dance%d_launch' % number: '' for number in range(100)})
    resources = Resources(find_packages([str(tmp_path)]))
    problems = [str(resources.find('ours/dance_%d.launch' % number).problem)
                for number in range(300)]
    assert "(did you mean 'ours/dance0.launch'" in problems[0]
    assert 'did you mean' not in problems[-1]


def test_an_executable_is_built_or_installed_or_can_be_executed(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    make_package(tmp_path / 'share', 'ours', scripts__walk_py='')
    script = tmp_path / 'share' / 'ours' / 'scripts' / 'walk.py'
    resources = Resources(find_packages([str(tmp_path)]))
    assert resources.find_executable('ours/walk.py')[2:] == (MISSING, 'is not executable')
    script.chmod(0o755)
    assert resources.find_executable('ours/walk.py').path == str(script)
    for prefix in tmp_path / 'devel', tmp_path:
        built = prefix / 'lib' / 'ours' / 'walk.py'
        built.parent.mkdir(parents=True)
        built.touch(0o755)
        monkeypatch.setenv('CMAKE_PREFIX_PATH', str(tmp_path / 'devel'))
        assert resources.find_executable('ours/walk.py').path == str(built)


# The verdict

@pytest.mark.parametrize('platform, robot, robot_type, reason', [
    ('pr2', 'rocon:/pr2/bob', None, None),
    ('all', 'rocon:/kobuki', None, None),
    ('all', 'rocon:/zork', None, None),
    ('mobile_device', 'rocon:/phone', None, None),
    ('pr2', 'rocon:/kobuki', None,
     "'rocon:/pr2' does not include this robot: hardware_platform is kobuki"),
    ('fetch15', 'rocon:/fetch15', None, None),
    ('fetch15', 'rocon:/fetch', None, "platform 'fetch15' is not that of this robot, 'fetch' "
     "(compared as text, since 'fetch15' is not registered)"),
    ('fetch15', 'rocon:/fetch', 'fetch15', None),
    ('fetch-15', 'rocon:/fetch', 'fetch-15', None),
    ('fetch15', 'rocon:/fetch15', 'fetch', "platform 'fetch15' is not that of this robot, 'fetch' "
     "(compared as text, since 'fetch15' is not registered)"),
    ('pr2', 'rocon:/pr2', 'kobuki', None),
    ('fetch15', 'rocon:/', None, None),
])
def test_a_platform_is_a_value_or_compared_as_text(
        tmp_path: Path, platform: str, robot: str, robot_type: str, reason: str) -> None:
    package(tmp_path, DANCE.replace('pr2', platform))
    app = read(tmp_path)[0]['ours/dance']
    uri = parse(robot, Vocabulary.open())
    verdict = runnable(app, uri, SpecIndex(), robot_type=robot_type)
    assert [str(found) for found in verdict.reasons] == ([] if reason is None else [reason])
    assert all(found.id == 'platform' for found in verdict.reasons)


@pytest.mark.parametrize('text, files, kind, reason', [
    ('launch: ours/dnace.launch', {}, 'launch-missing', "launch file 'ours/dnace.launch' does not "
     "exist: package 'ours' has no file 'dnace.launch' (did you mean 'ours/dance.launch'?)"),
    ('launch: ours/dance.launch', {'b__dance_launch': '<launch/>'}, 'launch-ambiguous',
     "launch file 'ours/dance.launch' is ambiguous: package 'ours' has 'b/dance.launch' and "
     "'launch/dance.launch'"),
    ('launch: ours/bad.launch', {'bad_launch': '<launch>'}, 'launch-not-xml',
     "launch file 'ours/bad.launch' is not XML: no element found (line 1, column 9)"),
    ('launch: ours/dance.launch\nicon: ours/a.png', {'a__a_png': '', 'b__a_png': ''},
     'icon-ambiguous', "icon 'ours/a.png' is ambiguous: package 'ours' has 'a/a.png' and "
     "'b/a.png'"),
    ('run: ours/walk', {}, 'run-missing',
     "executable 'ours/walk' does not exist: package 'ours' has no file 'walk'"),
    ('run: ours/walk_py', {'walk_py': ''}, 'run-missing', None),
])
def test_an_app_whose_launch_file_or_executable_cannot_be_started_does_not_run(
        tmp_path: Path, text: str, files: Dict[str, str], kind: str, reason: str) -> None:
    package(tmp_path, 'platform: pr2\ninterface: ours/dance.interface\n%s\n' % text, **files)
    [found] = runnable(read(tmp_path)[0]['ours/dance'], 'rocon:/pr2', SpecIndex()).reasons
    assert found.id == kind and (reason is None or str(found) == reason)
    assert kind in REASON_IDS


def test_an_app_without_its_interface_file_does_not_run_but_one_without_its_icon_does(
        tmp_path: Path) -> None:
    package(tmp_path, DANCE.replace('dance.interface', 'gone.interface') + 'icon: ours/gone.png\n')
    [found] = runnable(read(tmp_path)[0]['ours/dance'], 'rocon:/pr2', SpecIndex()).reasons
    assert found.id == 'interface-missing'
    assert str(found).startswith("interface file 'ours/gone.interface' does not exist: ")


@pytest.mark.parametrize('interface, problem', [
    ('published_topics: {scan: sensor_msgs/LaserScan}', None), ('', None), ('{}', None),
    ('published_topics: {', 'cannot be read: did not find expected node content while '
     'parsing a flow node (line 2, column 1)'),
    ('[scan]', 'is a list, expected a mapping'), ('scan', "is 'scan', expected a mapping"),
    ('a: \ud800', 'cannot be read: not UTF-8'),
])
def test_an_app_whose_interface_file_cannot_be_read_does_not_run(
        tmp_path: Path, interface: str, problem: str) -> None:
    made = package(tmp_path)
    (made / 'apps' / 'dance.interface').write_bytes(
        (interface + '\n').encode('utf-8', 'surrogatepass'))
    reasons = runnable(read(tmp_path)[0]['ours/dance'], 'rocon:/pr2', SpecIndex()).reasons
    assert [reason.id for reason in reasons] == ([] if problem is None else [
        'interface-unreadable'])
    assert all(str(reason).startswith("interface file 'ours/dance.interface' " + str(problem))
               and reason.id in REASON_IDS for reason in reasons)


# The verb

def test_apps_of_both_forms_are_listed_with_their_files(apps: Run, tmp_path: Path) -> None:
    made = package(tmp_path, dance_rapp='{compatibility: "rocon:/", launch: launch/dance.launch}')
    manifest = made / 'package.xml'
    manifest.write_text(manifest.read_text().replace(
        '</export>', '<rocon_app>dance.rapp</rocon_app></export>'))
    given = ('--robot', 'rocon:/pr2', '--package-path', tmp_path)
    path = made / 'apps' / 'dance.app'
    assert apps(*given) == (0, ['rocon:/pr2 can run 2 of 2 apps:', '  ours/dance',
                                '  ours/dance  (%s)' % path], '')
    assert apps(*given, '--all')[1] == [
        'rocon:/pr2 can run 2 of 2 apps:', '  ours/dance', '      in %s' % (made / 'dance.rapp'),
        '  ours/dance', '      in %s' % path]
    status, lines, _ = apps('ours/dance', *given)
    assert status == 0 and [line for line in lines if line.startswith('yes')] == [
        'yes: rocon:/pr2 can run ours/dance'] * 2


def test_one_app_says_that_its_platform_is_not_registered(apps: Run, tmp_path: Path) -> None:
    package(tmp_path, DANCE.replace('pr2', 'fetch15'))
    status, lines, err = apps('ours/dance', '--robot', 'rocon:/fetch', '--robot-type', 'fetch15',
                              '--package-path', tmp_path)
    assert (status, err) == (0, '')
    assert lines[3] == ("  x  platform  'fetch15' includes this robot (compared as text, since it "
                        'is not registered)')


def test_one_app_says_that_its_platform_is_a_group(apps: Run, tmp_path: Path) -> None:
    package(tmp_path, DANCE.replace('pr2', 'robot'))
    status, lines, _ = apps('ours/dance', '--robot', 'rocon:/pr2', '--package-path', tmp_path)
    assert (status, lines[3]) == (0, "  x  platform  'robot' includes this robot (a group, which "
                                     'app_manager compares as text)')


def test_one_app_whose_launch_file_fits_says_so_whatever_another_file_is(
        apps: Run, tmp_path: Path) -> None:
    package(tmp_path, DANCE.replace('dance.interface', 'gone.interface'))
    for more in [], ['--ignore', 'interface-missing']:
        _, lines, _ = apps('ours/dance', '--robot', 'rocon:/pr2', '--package-path', tmp_path, *more)
        assert [line.split()[:2] for line in lines[3:]] == [
            ['x', 'platform'], ['x', 'launch'], ['.', 'interface-missing']][:3 - bool(more)]


def test_json_tells_the_forms_apart(tmp_path: Path, capsys: Any) -> None:
    made = package(tmp_path)
    assert main(['apps', '--json', '--robot', 'rocon:/pr2', '--package-path', str(tmp_path)]) == 0
    [app] = json.loads(capsys.readouterr().out)['apps']
    assert (app['form'], app['platform'], app['compatibility'], app['file'], app['launch']) == (
        'app', 'pr2', 'rocon:/pr2', str(made / 'apps' / 'dance.app'),
        str(made / 'launch' / 'dance.launch'))


def test_a_broken_app_is_shown_where_it_is_asked_for(apps: Run, tmp_path: Path) -> None:
    made = package(tmp_path, 'platform: pr2')
    given = ('--robot', 'rocon:/pr2', '--package-path', tmp_path)
    status, _, err = apps('ours/dance', *given)
    assert status == 2 and '%s:1:1: the app has no interface' % (made / 'apps/dance.app') in err
    status, _, err = apps(*given)
    assert (status, err) == (1, '1 file has faults: rocon_uri specs check %s\n'
                             % tmp_path)
