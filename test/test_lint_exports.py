"""What the linter says of a package.xml, and of files that nobody exports."""
from __future__ import annotations

import os

import pytest
from made_packages import make_package

from rocon_uri.lint import check_packages

SPEC = 'spec_version: 1\nspec_type: %s\nname: X\n'
RAPP = 'display: A\ndescription: B\n'


@pytest.fixture
def found(tmp_path, monkeypatch):
    """What is found in the package ours, as (file, line, id, text)."""
    def check(edit=lambda text: text, **files):
        folder = make_package(tmp_path, 'ours', **files)
        manifest = folder / 'package.xml'
        manifest.write_text(edit(manifest.read_text()))
        monkeypatch.chdir(folder)
        return [(finding.file_name, finding.line, finding.id, finding.problem)
                for finding in check_packages(['.'])]
    return check


def exporting(text):
    return lambda manifest: manifest.replace('<export>\n', '<export>' + text)


# Exports that nobody sees

@pytest.mark.parametrize('tag, meant', [
    ('rocon_apps', 'rocon_app'), ('rocon-app', 'rocon_app'), ('Rocon_App', 'rocon_app'),
    ('RoconApp', 'rocon_app'), ('roconApp', 'rocon_app'), ('Rocon_Apps', 'rocon_app'),
    ('CapabilityProvider', 'capability_provider'), ('CAPABILITY_INTERFACE', 'capability_interface'),
    ('rcon_app', 'rocon_app'), ('capability_interfaces', 'capability_interface'),
    ('capabilty_provider', 'capability_provider'), ('rocon_url', 'rocon_uri'),
    ('semantic_capabilty_interface', 'semantic_capability_interface'),
    ('capability_provid', 'capability_provider'),
    ('capability_providerss', 'capability_provider'), ('app_manger', 'app_manager'),
    ('appmanager', 'app_manager'), ('_rocon_app', 'rocon_app')])
def test_a_tag_that_is_nearly_one_of_ours_is_a_warning(found, tag, meant):
    ((path, line, fault_id, problem),) = found(exporting('<%s>a</%s>' % (tag, tag)))
    assert (path, line, fault_id) == ('package.xml', 7, 'unknown-export')
    assert problem.startswith("unknown export '<%s>', which nobody sees (did you mean '%s'" % (
        tag, meant))


def test_a_tag_with_the_letters_of_one_of_ours_is_no_other(found):
    ((_, _, _, problem),) = found(exporting('<capability-interface>a</capability-interface>'))
    assert problem.endswith(" (did you mean 'capability_interface'?)")


@pytest.mark.parametrize('tag', [
    'build_type', 'architecture_independent', 'metapackage', 'deprecated', 'rosdoc', 'rviz',
    'nodelet', 'nav_core', 'controller_interface', 'hardware_interface', 'velocity_interface',
    'transmission_interface', 'joint_limits_interface', 'rqt_gui', 'gazebo_ros', 'moveit_core',
    'concert_service', 'software_farm', 'workflow', 'cpp', 'python', 'rosbag', 'roslaunch',
    'image_transport', 'filters', 'pluginlib', 'move_base', 'base_local_planner', 'app', 'robot',
    'rocon', 'rocon_app_list', 'capability_provi', 'capability_providersss', 'nocon_app',
    'apability_interface'])
def test_the_tags_of_other_tools_are_none_of_ours(found, tag):
    if tag in ('build_type', 'metapackage', 'deprecated', 'architecture_independent'):
        text = '<%s/>' % tag if tag != 'build_type' else '<build_type>catkin</build_type>'
    else:
        text = '<%s>x</%s>' % (tag, tag)
    assert found(exporting(text)) == []


@pytest.mark.parametrize('export, problem', [
    ('<rocon_uri rule="a.yaml"/>', "'<rocon_uri>' has an unknown attribute 'rule', expected "
                                   "'rules'"),
    ('<rocon_uri>a.yaml</rocon_uri>', "'<rocon_uri>' has text, which nobody sees (expected "
                                      "'<rocon_uri rules=\"a.yaml\"/>')"),
    ('<rocon_uri/>', "'<rocon_uri>' has no attribute 'rules'"),
    ('<rocon_uri rules=""/>', "attribute 'rules' of '<rocon_uri>' is empty, expected a path"),
    ('<app_manager app_dir=""/>',
     "attribute 'app_dir' of '<app_manager>' is empty, expected a path"),
    ('<app_manager appdir="apps"/>', "'<app_manager>' has an unknown attribute 'appdir', expected "
                                     "'app_dir'"),
    ('<app_manager>apps</app_manager>', "'<app_manager>' has text, which nobody sees (expected "
                                        "'<app_manager app_dir=\"apps\"/>')"),
    ('<rocon_app file="a.rapp">a.rapp</rocon_app>',
     "'<rocon_app>' has an unknown attribute 'file', expected its path as text"),
    ('<rocon_app app_dir="gone">a.rapp</rocon_app>',
     "'<rocon_app>' has an unknown attribute 'app_dir', expected its path as text"),
])
def test_an_attribute_or_a_text_that_nobody_sees_is_a_warning(found, export, problem):
    dependency = '<exec_depend>app_manager</exec_depend><export>'
    findings = found(lambda text: exporting(export)(text).replace('<export>', dependency),
                     a_rapp=RAPP)
    assert [finding for finding in findings if finding[2] != 'not-exported'] == [
        ('package.xml', 7, 'export-attribute', problem)]


@pytest.mark.parametrize('dependency, is_found', [
    ('', True), ('<build_depend>app_manager</build_depend>', False),
    ('<depend>app_manager</depend>', False), ('<exec_depend>app_manager</exec_depend>', False),
    ('<exec_depend>app_manager_msgs</exec_depend>', True),
    ('<exec_depend>actionlib</exec_depend>', True),
    ('<test_depend>app_manager</test_depend>', True)])
def test_app_manager_asks_only_packages_that_depend_on_it(found, dependency, is_found):
    findings = found(lambda text: exporting('<app_manager app_dir="${prefix}/apps"/>')(
        text).replace('<export>', dependency + '<export>'), apps__readme_txt='')
    assert [finding[2] for finding in findings] == ['no-app-manager-dependency'] * is_found


@pytest.mark.parametrize('name, is_found', [
    ('acme', True), ('zoo', True), ('app_manager', False)])
def test_app_manager_itself_needs_no_dependency(tmp_path, monkeypatch, name, is_found):
    manifest = make_package(tmp_path, name) / 'package.xml'
    export = '<app_manager app_dir="."/>'
    manifest.write_text(exporting(export + '\n  ' + export)(manifest.read_text()))
    monkeypatch.chdir(manifest.parent)
    assert [str(finding).partition(' ')[0] for finding in check_packages(['.'])] == [
        'package.xml:7:11:'] * is_found


@pytest.mark.parametrize('export', ['<rocon_uri/>', '<app_manager app_dir="."/>', '<rosdoc/>'])
def test_what_is_exported_beside_what_is_no_file_is_looked_at(found, export):
    findings = found(lambda text: exporting(export + '<rocon_app>gone.rapp</rocon_app>')(text))
    assert 'file-missing' in [finding[2] for finding in findings]


# Files that nobody exports

@pytest.mark.parametrize('path, text, expected', [
    ('a/dance_rapp', RAPP, '<rocon_app>a/dance.rapp</rocon_app>'),
    ('a/x_yaml', SPEC % 'interface', '<capability_interface>a/x.yaml</capability_interface>'),
    ('a/x_yml', SPEC % 'provider', '<capability_provider>a/x.yml</capability_provider>'),
    ('x_yaml', SPEC % 'semantic_interface',
     '<semantic_capability_interface>x.yaml</semantic_capability_interface>'),
    ('x_yaml', 'spec_type: interface\n', None),
    ('x_yaml', 'spec_type: interface\na: {spec_version: 1}\n', None),
    ('x_yaml', 'spec_version: 1\na: {spec_type: interface}\n', None),
    ('x_yaml', 'a: {spec_type: interface, spec_version: 1}\n', None),
    ('x_yaml', SPEC % 'interfce', '<capability_interface>x.yaml</capability_interface>'),
    ('x_yaml', SPEC % 'Provider', '<capability_provider>x.yaml</capability_provider>'),
    ('x_yaml', SPEC % 'other', None),
    ('x_yaml', 'hardware_platform: {robot: [x]}', None),
    ('x_yaml', '# spec_type, spec_version\n[', None),
    ('x_txt', SPEC % 'interface', None),
    ('test/dance_rapp', RAPP, None), ('a/tests/b/x_yaml', SPEC % 'interface', None),
    ('a/test_x/dance_rapp', RAPP, '<rocon_app>a/test_x/dance.rapp</rocon_app>'),
    ('.a/dance_rapp', RAPP, None),
    ('x_interactions', '[{name: A, compatibility: "rocon:/pc"}]', None),
])
def test_what_nobody_exports_is_a_warning(found, path, text, expected):
    files = {path.replace('/', '__'): text}
    name = '.'.join(path.rsplit('_', 1))
    assert found(**files) == ([] if expected is None else [
        (name, 1, 'not-exported',
         "no export names this file, so nobody sees it (expected '%s' in package.xml)" % expected)])


def test_what_is_in_a_package_within_is_not_looked_at(found, tmp_path):
    make_package(tmp_path / 'ours', 'inner', a_rapp=RAPP)
    folder = tmp_path / 'again'
    folder.mkdir()
    outer = make_package(folder, 'outer')
    make_package(outer, 'inner', a_rapp=RAPP)
    assert check_packages([str(folder)]) == []


def test_an_exported_link_is_that_of_its_file(found, tmp_path):
    def edit(text):
        (tmp_path / 'ours' / 'link.rapp').symlink_to('dance.rapp')
        return exporting('<rocon_app>link.rapp</rocon_app>')(text)
    assert found(edit, dance_rapp=RAPP) == []


APP = '{platform: all, interface: ours/a.interface, launch: ours/a.launch}'


def apps(found, listed='ours/dance', exported='apps', **files):
    """What is found where the package exports a folder to app_manager."""
    return [(path, fault_id) for path, _, fault_id, _ in found(
        lambda text: text.replace('<export>', '<depend>app_manager</depend>\n  <export>').replace(
            '<export>\n', '<export><app_manager app_dir="${prefix}/%s"/>\n' % exported),
        apps__x_installed='apps: [{app: %s}]' % listed, a_interface='{}', a_launch='<launch/>',
        **files) if fault_id in ('not-listed', 'outside-app-dir')]


@pytest.mark.parametrize('files, findings', [
    ({'apps__dance_app': APP}, []),
    ({'elsewhere__dance_app': APP}, []),
    ({'apps__dance_app': APP, 'sing_app': APP}, [('sing.app', 'not-listed')]),
    ({'dance_app': APP, 'test__sing_app': APP}, []),
    ({'dance_app': APP, 'apps__below__y_installed': 'apps: []'},
     [('apps/below/y.installed', 'outside-app-dir')]),
    ({'dance_app': APP, 'y_installed': 'apps: []'}, [('y.installed', 'outside-app-dir')]),
    ({'dance_app': APP, 'sing_app': APP, 'y_installed': 'apps: [{app: ours/sing}]'},
     [('sing.app', 'not-listed'), ('y.installed', 'outside-app-dir')]),
    ({'dance_app': APP, 'sing_app': APP, 'apps__y_installed': 'apps: [{app: ours/sing}]'}, []),
])
def test_an_app_is_listed_by_an_installed_file_that_counts(found, files, findings):
    assert apps(found, **files) == findings


def test_an_app_of_another_package_is_none_of_this_one(found):
    assert apps(found, listed='theirs/dance', dance_app=APP) == [('dance.app', 'not-listed')]


@pytest.mark.parametrize('elsewhere', [False, True])
def test_an_app_may_be_listed_by_another_package(tmp_path, elsewhere):
    """As robots have it: one package lists the apps of several."""
    make_package(tmp_path / 'a', 'theirs', dance_app=APP.replace('ours', 'theirs'),
                 sing_app=APP.replace('ours', 'theirs'), a_interface='{}', a_launch='<launch/>')
    robot = make_package(tmp_path / 'b', 'robot', apps__x_installed='apps: [{app: theirs/dance}]')
    (robot / 'package.xml').write_text((robot / 'package.xml').read_text().replace(
        '<export>', '<depend>app_manager</depend><export><app_manager app_dir="apps"/>'))
    paths = ([str(tmp_path / 'a')], [str(tmp_path / 'b')]) if elsewhere else ([str(tmp_path)], [])
    [finding] = check_packages(*paths)
    assert (os.path.basename(finding.file_name), finding.id) == ('sing.app', 'not-listed')


@pytest.mark.parametrize('path, problem', [
    ('${prefix}/apps', None), ('.', None),
    ('${prefix}/app', "exported folder './app' does not exist"),
    ('a.rapp', "exported folder 'a.rapp' is not a directory"),
    ('..', "exported folder '..' is outside the package")])
def test_an_app_dir_is_a_folder_of_the_package(found, path, problem):
    findings = found(lambda text: text.replace('<export>', '<depend>app_manager</depend><export>')
                     .replace('<export>\n', '<export><app_manager app_dir="%s"/>' % path),
                     apps__readme_txt='', a_rapp=RAPP)
    assert [finding[3] for finding in findings if finding[2] != 'not-exported'] == (
        [] if problem is None else [problem])


def test_without_an_app_dir_nothing_is_listed(found):
    assert apps(found, exported='none', dance_app=APP) == [
        ('apps/x.installed', 'outside-app-dir'), ('dance.app', 'not-listed')]


def test_a_list_that_cannot_be_read_is_that_and_no_more(found):
    findings = apps(found, listed='[', dance_app=APP)
    assert findings == [('dance.app', 'not-listed')]


def test_a_list_that_cannot_be_read_hides_no_other(found):
    assert apps(found, dance_app=APP, apps__a_installed='[') == []


def test_a_file_that_nobody_sees_is_marked_at_its_begin(tmp_path):
    folder = make_package(tmp_path, 'ours', a_app=APP, b_rapp=RAPP, c_installed='apps: []')
    assert [(finding.file_name, finding.line, finding.column)
            for finding in check_packages([str(folder)])] == [
        (str(folder / name), 1, 1) for name in ('a.app', 'b.rapp', 'c.installed')]


# What catkin refuses

@pytest.mark.parametrize('old, new, line, problem', [
    (' email="somebody@example.org"', '', 5,
     'The "maintainer" tag must have the attribute "email"'),
    ('email="somebody@example.org"', 'email="somebody"', 5,
     'Invalid email "somebody" for person "Somebody"'),
    ('1.0.0', '1.0', 3, 'Package version "1.0" does not follow version conventions'),
    ('<license>BSD</license>', '', 1, 'The package node must contain at least one "license" tag'),
    ('<license>BSD</license>', '<license> </license>', 6,
     'The license tag must neither be empty nor only contain whitespaces'),
    ('Made by a test', '', 4, 'Package description must not be empty'),
    ('<license>', '<foo/>\n<license>', 6,
     'The manifest of package "ours" (with format version 2) must not contain the following tags: '
     'foo'),
    ('<license>', '<run_depend>x</run_depend>\n<license>', 6, 'following tags: run_depend'),
    ('<license>', '<license x="y">', 6, 'The "license" tag must not have the following attr'),
    ('<license>', '<license description="x">', 6,
     'The "license" tag must not have the following attributes: description'),
    ('<license>', '<license>MIT</license>\n<license> </license>\n<license>', 7,
     'The license tag must neither be empty nor only contain whitespaces'),
    ('email="somebody@example.org"', 'email=""', 5, 'Maintainers must have an email address'),
    ('</maintainer>', '</maintainer>\n<maintainer email="">Else</maintainer>', 6,
     'Maintainers must have an email address'),
    ('</maintainer>', '</maintainer>\n<maintainer>Else</maintainer>', 6,
     'The "maintainer" tag must have the attribute "email"'),
])
def test_what_catkin_refuses_is_one_finding_with_its_line_and_hides_no_other(
        found, old, new, line, problem):
    findings = found(lambda text: exporting('<rocon_app>no.rapp</rocon_app>')(text).replace(
        old, new), dance_rapp=RAPP)
    of_catkin = [finding for finding in findings if finding[2] == 'invalid-manifest']
    assert [(path, at) for path, at, _, _ in of_catkin] == [('package.xml', line)]
    assert problem in of_catkin[0][3]
    assert [finding[2] for finding in findings if finding not in of_catkin] == [
        'not-exported', 'file-missing']
