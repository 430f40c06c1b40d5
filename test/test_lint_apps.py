"""What the linter finds in the apps of app_manager."""
from __future__ import annotations

from pathlib import Path
from typing import Any, List

import pytest
from made_packages import make_package

from rocon_uri.lint import check_packages

DANCE = 'platform: pr2\ninterface: ours/dance.interface\nlaunch: ours/dance.launch\n'


def found(folder: Path, monkeypatch: Any, dance: str = DANCE, name: str = 'dance',
          installed: str = 'apps: [{app: ours/%s}]\n', **files: str) -> List[str]:
    """What is found in the package ours, which has one app."""
    made = make_package(
        folder, 'ours', **{'apps__our_installed': installed.replace('%s', name),
                           'apps__dance_interface': 'published_topics: {}\n',
                           'apps__dance_launch': '<launch/>', **files})
    (made / 'apps' / (name + '.app')).write_text(dance)
    manifest = made / 'package.xml'
    manifest.write_text(manifest.read_text().replace(
        '<export>', '<exec_depend>app_manager</exec_depend><export>'
        '<app_manager app_dir="${prefix}/apps"/>'))
    monkeypatch.chdir(folder)
    return [str(finding)[len('ours/apps/'):] for finding in check_packages(['.'])]


@pytest.mark.parametrize('text, findings', [
    (DANCE, []),
    (DANCE.replace('pr2', 'all'), []),
    (DANCE + 'dispaly: Dance',
     ["4:1: warning: unknown key 'dispaly' in the app (did you mean 'display'?) [unknown-key]"]),
    (DANCE.replace('pr2', 'pr3'), [
        "1:11: warning: platform 'pr3' is not registered; it is compared with that of the robot as "
        'text [unregistered-platform]']),
    (DANCE.replace('pr2', 'turtelbot2'), [
        "1:11: warning: platform 'turtelbot2' is not registered (did you mean 'turtlebot2' or "
        "'turtlebot' or 'turtlebot4'?); it is compared with that of the robot as text "
        '[unregistered-platform]']),
    (DANCE.replace('pr2', 'nao'), [
        "1:11: warning: platform 'nao' is not registered (did you mean 'aldebaran_nao'?); it is "
        'compared with that of the robot as text [unregistered-platform]']),
    (DANCE.replace('pr2', 'All'), [
        "1:11: warning: platform 'All' is not registered (did you mean 'all'?); it is compared "
        'with that of the robot as text [unregistered-platform]']),
    (DANCE.replace('pr2', 'mobile_device'), [
        "1:11: warning: platform 'mobile_device' is a group, which app_manager does not know: it "
        'compares the platform with that of the robot as text [group-platform]']),
    (DANCE.replace('dance.launch', 'dnace.launch'), [
        "3:9: error: launch file 'ours/dnace.launch' does not exist: package 'ours' has no file "
        "'dnace.launch' (did you mean 'ours/dance.launch'?) [launch-missing]"]),
    (DANCE.replace('dance.interface', 'gone.interface'), [
        "2:12: error: interface file 'ours/gone.interface' does not exist: package 'ours' has no "
        "file 'gone.interface' [interface-missing]"]),
    (DANCE + 'icon: ours/gone.png', [
        "4:7: warning: icon 'ours/gone.png' does not exist: package 'ours' has no file 'gone.png' "
        '[file-missing]']),
    ('platform: pr2\ninterface: ours/dance.interface\nrun: ours/dance.launch\n', [
        "3:6: error: executable 'ours/dance.launch' is not executable [run-missing]"]),
    (DANCE + 'timeout: soon',
     ["4:10: error: timeout is 'soon', expected a number of seconds [wrong-value]"]),
    (DANCE + 'timeout: true',
     ['4:10: error: timeout is true, expected a number of seconds [wrong-value]']),
    (DANCE + 'allow_parallel: 7',
     ['4:17: error: allow_parallel is 7, expected true or false [wrong-value]']),
    (DANCE + 'timeout: 7.5\nallow_parallel: false\nrun_args: -v\n'
     'plugins: [{name: a, type: b}]\nplugin_order: [a]', []),
    (DANCE + 'plugins: [{name: a, type: b}, {name: c, type: b}]\nplugin_order:\n'
     '  start_plugin_order: [a, c]\n  stop_plugin_order: [c, a]', []),
    (DANCE + 'plugins: [{name: a, type: b}]\nplugin_order: {start_plugin_order: 7}', [
        '5:36: error: start_plugin_order is 7, expected a list [wrong-value]']),
    (DANCE + 'plugins: [{name: video, type: b}]\nplugin_order: {stop_plugin_oder: [a], '
     'stop_plugin_order: [vidoe]}', [
         "5:16: warning: unknown key 'stop_plugin_oder' in plugin_order (did you mean "
         "'stop_plugin_order' or 'start_plugin_order'?) [unknown-key]",
         "5:58: warning: stop_plugin_order has 'vidoe', and there is no such plugin (did you mean "
         "'video'?) [unknown-name]"]),
    (DANCE + 'plugin_order: 7', ['4:15: error: plugin_order is 7, expected a list [wrong-value]']),
    (DANCE + 'plugins: [{name: a}]', ['4:11: error: a plugin has no type [missing-key]']),
    (DANCE + 'plugins: [{name: video, type: b}]\nplugin_order: [vidoe]', [
        "5:15: warning: plugin_order has 'vidoe', and there is no such plugin (did you mean "
        "'video'?) [unknown-name]"]),
    ('platform: pr2\ninterface: ours/dance.interface\n',
     ['1:1: error: the app has no launch and no run, expected one of them [missing-key]']),
])
def test_apps(tmp_path: Path, monkeypatch: Any, text: str, findings: List[str]) -> None:
    assert found(tmp_path, monkeypatch, text) == ['dance.app:' + line for line in findings]


@pytest.mark.parametrize('platform, ids', [('agv', ['group-platform']), ('all', [])])
def test_an_exported_group_is_a_group_unless_it_is_called_all(
        tmp_path: Path, monkeypatch: Any, platform: str, ids: List[str]) -> None:
    make_package(tmp_path, 'a', rules_yaml='hardware_platform: {agv: [agv_1], all: [agv_2]}')
    manifest = tmp_path / 'a' / 'package.xml'
    manifest.write_text(manifest.read_text().replace(
        '<export>', '<export><rocon_uri rules="rules.yaml"/>'))
    lines = found(tmp_path, monkeypatch, DANCE.replace('pr2', platform))
    assert [line.rpartition('[')[2].rstrip(']') for line in lines] == ids


def test_a_launch_file_is_checked_in_its_own_lines(tmp_path: Path, monkeypatch: Any) -> None:
    assert found(tmp_path, monkeypatch, apps__dance_launch='<launch>') == [
        'dance.launch:1:9: error: launch file is not XML: no element found [launch-not-xml]']


@pytest.mark.parametrize('text, finding', [
    ('published_topics: {scan: sensor_msgs/LaserScan}\nsubscribed_topics:', None),
    ('- a', '1:1: error: the interface is a list, expected a mapping [wrong-value]'),
    ('7', '1:1: error: the interface is 7, expected a mapping [wrong-value]'),
    ('published_topics: 7', '1:19: error: published_topics is 7, expected a mapping [wrong-value]'),
    ('published_topics: {sc-an: a/B}', "1:20: error: name 'sc-an' is not a legal ROS name "
     '[illegal-name]'),
    ('subscribed_topics: {scan: LaserScan}', "1:27: error: type 'LaserScan' of 'scan' is not of "
     'the form package/Type [illegal-type]'),
])
def test_interface_files(tmp_path: Path, monkeypatch: Any, text: str, finding: str) -> None:
    assert found(tmp_path, monkeypatch, apps__dance_interface=text) == (
        [] if finding is None else ['dance.interface:' + finding])


def test_two_files_of_one_name_are_an_error(tmp_path: Path, monkeypatch: Any) -> None:
    assert found(tmp_path, monkeypatch, b__dance_launch='<launch/>') == [
        "dance.app:3:9: error: launch file 'ours/dance.launch' is ambiguous: package 'ours' has "
        "'apps/dance.launch' and 'b/dance.launch' [launch-ambiguous]"]


def test_an_app_that_no_uri_can_name_is_a_warning(tmp_path: Path, monkeypatch: Any) -> None:
    [line] = found(tmp_path, monkeypatch, name='tango-nuevo')
    assert line == (
        "tango-nuevo.app: warning: no rocon URI can name app 'ours/tango-nuevo': the names of "
        'package and file have to be ROS base names (a letter, then letters, digits and _) '
        '[illegal-name]')


def test_what_is_wrong_with_a_list_is_found_in_it(tmp_path: Path, monkeypatch: Any) -> None:
    installed = 'apps: [{app: ours/%s}, {app: ours/dnace}]\n'
    assert found(tmp_path, monkeypatch, installed=installed) == [
        "our.installed:1:33: error: app 'ours/dnace' does not exist: package 'ours' has no file "
        "'dnace.app' (did you mean 'ours/dance'?) [unknown-app]"]


def test_what_was_meant_is_said_of_a_few_plugins(tmp_path: Path, monkeypatch: Any) -> None:
    plugins = 'plugins: [%s]\nplugin_order: [%s]\n' % (
        ', '.join('{name: plugin_%d, type: t}' % number for number in range(30)),
        ', '.join('plugim_%d' % number for number in range(30)))
    findings = found(tmp_path, monkeypatch, DANCE + plugins)
    assert ['did you mean' in finding for finding in findings] == [True] * 20 + [False] * 10


def test_a_plugin_in_the_order_may_be_anything(tmp_path: Path, monkeypatch: Any) -> None:
    findings = found(tmp_path, monkeypatch,
                     DANCE + 'plugins: [{name: a, type: t}]\nplugin_order: [a, [a], 7]\n')
    assert [finding.partition(', ')[0].partition(' has ')[2] for finding in findings] == [
        "'['a']'", "'7'"]
