"""What people get up to: each thing gives its error, and everything else is still answered."""
from __future__ import annotations

import itertools
import json
import os
import re
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import pytest
from capabilities.discovery import (
    PackageError, package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from capabilities.specs.interface import InvalidInterface, capability_interface_from_file_path
from made_packages import make_package
from sources import ROOT, SOURCE

from rocon_uri import RoconURI, RoconURIValueError, is_compatible, parse
from rocon_uri.lint import check_packages
from rocon_uri.messages import from_msg
from rocon_uri.apps.rapps import InvalidRapp, rapps_from_package_index, runnable
from rocon_uri.sources.packages import find_packages
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.vocabulary import vocabulary_of_packages

INTERFACE = 'name: %s\nspec_version: 1\nspec_type: interface\n'
PROVIDER = ('name: camera\nspec_version: 1\nspec_type: provider\nimplements: good/Camera\n'
            'launch_file: %s\n')
LOOK = '''\
display: Look
description: It looks
compatibility: rocon:/our_robot
launch: look.launch
required_capabilities:
  - name: good/Camera
'''


@pytest.fixture(autouse=True)
def whatever_waits_for_ever_fails():
    def stop(signal_number, frame):
        raise AssertionError('this waits for ever')     # not an OSError, which is answered
    earlier = signal.signal(signal.SIGALRM, stop)
    signal.alarm(300)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, earlier)


def rocon_uri(*arguments, prefix=(), ROS_PACKAGE_PATH=''):
    """Run the command."""
    return subprocess.run(
        [*prefix, sys.executable, str(ROOT / 'scripts/rocon_uri'), *map(str, arguments)],
        env=dict(os.environ, PYTHONPATH=str(SOURCE), ROS_PACKAGE_PATH=ROS_PACKAGE_PATH),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding='utf-8', timeout=60)


# -- URIs -----------------------------------------------------------------------------------------

ALTERNATIVES = ['pr2', 'kobuki'] * 500000
HUGE = {
    '10 MB of one name': 'rocon:/pr2/' + 'a' * 10000000,
    'a million alternatives': 'rocon:/' + '|'.join(ALTERNATIVES),
    'a million alternatives in a group': 'rocon:/pr2/(%s)' % '|'.join(ALTERNATIVES),
    'a million fields': 'rocon:' + '/*' * 1000000,
    'a million escapes': 'rocon:/' + '%41' * 1000000,
}


@pytest.mark.parametrize('text', HUGE.values(), ids=list(HUGE))
def test_a_huge_uri_is_an_error_of_a_line(text, tmp_path):
    for ask in (parse, lambda text: is_compatible('rocon:/', text),
                lambda text: is_compatible(text, 'rocon:/')):
        with pytest.raises(RoconURIValueError, match='at most 65536 characters') as raised:
            ask(text)
        assert raised.value.field == 'uri'
        assert len(str(raised.value)) < 500
        assert len(raised.value.pretty()) < 500

    fleet = tmp_path / 'fleet.txt'
    fleet.write_text('rocon:/pr2/bob\n%s\nrocon:/kobuki/alice\n' % text)
    done = rocon_uri('match', 'rocon:/robot', '--in', fleet)
    assert (done.returncode, done.stdout) == (2, 'rocon:/pr2/bob\nrocon:/kobuki/alice\n')
    assert done.stderr.startswith(
        '%s:2: a rocon URI has at most 65536 characters, this one has more' % fleet)
    assert len(done.stderr) < 1000


HUGE_FIELDS = [
    ('concert_name', 'a' * 10000000, 'is longer than 255 characters'),
    ('hardware_platform', ALTERNATIVES, 'more than 256 alternatives'),
    ('hardware_platform', ['a' * 10000000], 'is not registered'),
    ('application_framework', [''] * 1000000, "'' is not one alternative"),
    ('operating_system', ['focal'] * 1000000, 'more than 256 alternatives'),
    ('name', 'a' * 10000000, 'at most 255 characters'),
    ('name', '(%s)' % '|'.join(ALTERNATIVES), 'at most 255 characters'),
    ('rocon_app', 'a/' * 5000000, 'is not of the form package/name'),
]


@pytest.mark.parametrize('field, value, problem', HUGE_FIELDS, ids=[
    '%s %s' % (field, problem) for field, _, problem in HUGE_FIELDS])
def test_a_huge_field_of_a_message_is_an_error_of_that_field(field, value, problem):
    fields = dict.fromkeys(('concert_name', 'name', 'rocon_app'), '')
    fields.update(dict.fromkeys(
        ('hardware_platform', 'application_framework', 'operating_system'), ['*']))
    fields[field] = value
    for read in (lambda: RoconURI.from_fields(**{field: value}),
                 lambda: from_msg(SimpleNamespace(**fields))):
        with pytest.raises(RoconURIValueError, match=problem) as raised:
            read()
        assert raised.value.field == field
        assert len(str(raised.value)) < 500


def test_as_many_alternatives_as_a_text_can_hold_are_an_error_of_the_field():
    with pytest.raises(RoconURIValueError, match='more than 256 alternatives') as raised:
        parse('rocon:/' + '|'.join(ALTERNATIVES[:10000]))
    assert raised.value.field == 'hardware_platform'


# -- files ----------------------------------------------------------------------------------------

def make_missing(path):
    pass


def make_symlink_loop(path):
    path.symlink_to(path.name)


def make_fifo(path):
    os.mkfifo(str(path))


def make_device(path):
    path.symlink_to('/dev/zero')


def make_unreadable(path):
    path.write_text('')
    path.chmod(0)


# how a file is made that cannot be read, what the linter finds, and what reading it says
UNREADABLE = [
    (make_missing, 'does not exist', 'No such file or directory'),
    (make_symlink_loop, 'does not exist', 'Too many levels of symbolic links'),
    (Path.mkdir, 'is not a file', 'Is a directory'),
    (make_fifo, 'is not a file', 'Not a regular file'),
    (make_device, 'is not a file', 'Not a regular file'),
    (make_unreadable, 'cannot be read: Permission denied', 'Permission denied'),
]
EXPORTS = {
    'capability_interface': 'interface.yaml', 'semantic_capability_interface': 'semantic.yaml',
    'capability_provider': 'provider.yaml', 'rocon_app': 'app.rapp', 'rules': 'rules.yaml'}

# root can read everything, unless it gives that up
AS_OTHERS_DO = [] if os.geteuid() else [
    'setpriv', '--inh-caps=-dac_override,-dac_read_search',
    '--bounding-set=-dac_override,-dac_read_search']


@pytest.fixture
def workspace(tmp_path):
    """A package with nothing wrong, to which others can be added."""
    add_package(tmp_path, 'good', {
        'capability_interface': 'Camera.yaml', 'capability_provider': 'camera.yaml',
        'rocon_app': 'look.rapp', 'rules': 'robots.yaml'},
        Camera_yaml=INTERFACE % 'Camera', camera_yaml=PROVIDER % 'camera.launch',
        camera_launch='<launch/>', robots_yaml='hardware_platform: [our_robot]',
        look_launch='<launch/>', look_rapp=LOOK)
    (tmp_path / 'fleet.txt').write_text('rocon:/our_robot/bob\nrocon:/pr2/alice\n')
    return tmp_path


def add_package(workspace, name, exports, **files):
    """Write a package, which can export rules too; its folder."""
    rules = exports.get('rules')
    folder = make_package(workspace, name, [
        (tag, path) for tag, path in exports.items() if tag != 'rules'], **files)
    if rules is not None:
        manifest = folder / 'package.xml'
        manifest.write_text(manifest.read_text().replace(
            '  </export>', '    <rocon_uri rules="${prefix}/%s"/>\n  </export>' % rules))
    return folder


def check_command(workspace, run=rocon_uri):
    """
    What the command says of the packages, line by line.

    Whatever is wrong, the good package is answered for.

    :returns: (what check finds, without the ids, what apps complains of, what match warns of)
    """
    at = str(workspace)
    checked = run('specs', 'check', at)
    asked = 'apps', '--robot', 'rocon:/our_robot', '--all', '--package-path', at
    apps = run(*asked)
    complaints = [error['message'] for error in json.loads(run(*asked, '--json').stdout)['errors']]
    match = run('match', 'rocon:/our_robot', '--in', workspace / 'fleet.txt', ROS_PACKAGE_PATH=at)
    assert not any(at + '/good' in line for line in checked.stdout.splitlines())
    assert checked.returncode == (1 if ': error: ' in checked.stdout else 0)
    assert re.search('  good/look  Look: It looks\n      in .*\n      with good/camera\n',
                     apps.stdout)
    assert bool(complaints) == (': rocon_uri specs check' in apps.stderr)
    assert (match.returncode, match.stdout) == (0, 'rocon:/our_robot/bob\n')
    assert 'Traceback' not in checked.stderr + apps.stderr + match.stderr
    return tuple([re.sub(r' \[[a-z-]+\]$', '', line.replace(at + '/', '')) for line in lines]
                 for lines in (checked.stdout.splitlines(), complaints, match.stderr.splitlines()))


@pytest.mark.parametrize('make, finding, reason', UNREADABLE)
def test_an_exported_file_that_cannot_be_read(workspace, make, finding, reason):
    folder = add_package(workspace, 'bad', EXPORTS)
    for name in EXPORTS.values():
        make(folder / name)
    run = rocon_uri
    if make is make_unreadable:
        run = partial(rocon_uri, prefix=AS_OTHERS_DO)
        if run('fields').returncode != 0:
            pytest.skip('root cannot give up reading everything here')
    else:
        check_library(workspace, {
            OSError: ['interface.yaml', 'semantic.yaml', 'provider.yaml', 'rules.yaml'],
            InvalidRapp: ['app.rapp']})
    findings, complaints, warnings = check_command(workspace, run)
    if make is make_unreadable:
        assert findings == sorted(
            'bad/%s: error: %s' % (name, finding) for name in EXPORTS.values())
    else:
        assert findings == [
            "bad/package.xml:%d:5: error: exported file '%s' %s" % (line, path, finding)
            for line, path in enumerate([*EXPORTS.values()][:-1] + ['./rules.yaml'], 8)]
    assert complaints == [
        'bad/%s: %s%s' % (name, 'cannot be read: ' if name == 'app.rapp' else '', reason)
        for name in EXPORTS.values()]
    assert [reason in line for line in warnings] == [True]      # of the rules, all it looks for


def check_library(workspace, expected):
    """The errors are of these classes, about these files; the good package is all there."""
    faults = []
    index = package_index_from_package_path(str(workspace), faults)
    specs, spec_faults = spec_index_from_spec_file_index(spec_file_index_from_package_index(index))
    rapps, rapp_faults = rapps_from_package_index(index)
    vocabulary, rules_faults = vocabulary_of_packages(find_packages([str(workspace)]))
    assert (specs.names, list(rapps)) == (['good/Camera', 'good/camera'], ['good/look'])
    assert runnable(rapps['good/look'], parse('rocon:/our_robot/bob', vocabulary), specs)
    found = {}
    for fault in faults + spec_faults + rules_faults + rapp_faults:
        kind = OSError if isinstance(fault, OSError) else type(fault)
        file = fault.filename if kind is OSError else fault.file_name
        found.setdefault(kind, []).append(Path(file).name)
    assert found == expected


def test_files_in_a_folder_that_cannot_be_read(workspace):
    folder = add_package(workspace, 'bad', {'rocon_app': 'locked/a.rapp', 'rules': 'locked/a.yaml'},
                         locked__a_rapp=LOOK)
    manifest = folder / 'package.xml'
    manifest.write_text(manifest.read_text().replace(
        '  <export>', '  <depend>app_manager</depend>\n  <export><app_manager app_dir="locked"/>'))
    (folder / 'locked').chmod(0)
    run = partial(rocon_uri, prefix=AS_OTHERS_DO)
    try:
        if run('fields').returncode != 0:
            pytest.skip('root cannot give up reading everything here')
        findings, complaints, _ = check_command(workspace, run)
    finally:
        (folder / 'locked').chmod(0o755)
    assert findings == [
        "bad/package.xml:8:11: error: exported folder 'locked' cannot be read: Permission denied",
        "bad/package.xml:9:5: error: exported file 'locked/a.rapp' cannot be read: "
        'Permission denied',
        "bad/package.xml:10:5: error: exported file './locked/a.yaml' cannot be read: "
        'Permission denied']
    assert complaints == ['bad/locked/a.rapp: cannot be read: Permission denied',
                          'bad/locked/a.yaml: Permission denied']


def test_a_line_with_as_many_comments_as_a_file_may_have(workspace):
    add_package(workspace, 'bad', {'rocon_app': 'look.rapp'}, look_launch='<launch/>',
                look_rapp=LOOK.rstrip() + 'x  ' + '# rocon_uri: ignore[' * 50000)
    add_package(workspace, 'worse', {'rocon_app': '<!-- rocon_uri: ignore[' * 40000})
    findings = check_packages([str(workspace)])
    assert [finding.id for finding in findings] == ['no-interface', 'invalid-manifest']


def make_huge(path):
    path.write_text('<package>%s</package>' % (' ' * 2 ** 20))


@pytest.mark.parametrize('make, reason', [
    (make, 'cannot be read: ' + reason) for make, _, reason in UNREADABLE
    if make not in (make_missing, make_unreadable)
] + [(make_huge, 'larger than 1 MiB, which is all that is read')])
def test_a_manifest_that_cannot_be_read(workspace, make, reason):
    manifest = workspace / 'bad' / 'package.xml'
    manifest.parent.mkdir()
    make(manifest)
    is_package = make is not Path.mkdir     # else it is a folder like any other
    check_library(workspace, {PackageError: ['package.xml']} if is_package else {})
    findings, complaints, warnings = check_command(workspace)
    assert findings == ['bad/package.xml: error: %s' % reason] * is_package
    assert complaints == ['bad/package.xml: %s' % reason] * is_package
    assert [reason in line for line in warnings] == [True] * is_package


def test_a_manifest_of_entities_of_entities(workspace):
    entities = ''.join('<!ENTITY e%d "%s">' % (number, ('&e%d;' % (number - 1)) * 10)
                       for number in range(1, 12))
    folder = add_package(workspace, 'bad', {})
    manifest = (folder / 'package.xml').read_text().replace('Made by a test', '&e11;')
    (folder / 'package.xml').write_text(
        '<!DOCTYPE package [<!ENTITY e0 "ha">%s]>%s' % (entities, manifest))
    check_library(workspace, {PackageError: ['package.xml']})
    findings, complaints, warnings = check_command(workspace)
    for line in findings + complaints + warnings:
        assert line.endswith('it declares entities, and those are not read')
    assert len(findings) == len(complaints) == len(warnings) == 1


@pytest.mark.parametrize('path', ['../../../etc/passwd', '/etc/passwd', '..', 'launch/../../x'])
def test_a_launch_file_outside_the_package(workspace, path):
    add_package(workspace, 'bad', {'capability_provider': 'eye.yaml', 'rocon_app': 'peep.rapp'},
                eye_yaml=(PROVIDER % path).replace('name: camera', 'name: eye'),
                peep_rapp=LOOK.replace('look.launch', path))
    finding = "error: launch file '%s' is outside the package" % path
    assert [str(found).replace(str(workspace) + '/', '')
            for found in check_packages([str(workspace)])] == [
        'bad/eye.yaml:5:14: %s [launch-outside]' % finding,
        'bad/peep.rapp:4:9: %s [launch-outside]' % finding]


def test_the_command_says_what_is_outside_the_package(workspace):
    add_package(workspace, 'bad', {'rocon_app': 'peep.rapp', 'rules': '../good/robots.yaml'},
                peep_rapp=LOOK.replace('look.launch', '../../../etc/passwd'))
    findings, _, _ = check_command(workspace)
    assert findings == [
        "bad/package.xml:9:5: error: exported file './../good/robots.yaml' is outside the package",
        "bad/peep.rapp:4:9: error: launch file '../../../etc/passwd' is outside the package"]


@pytest.mark.parametrize('rules, place, problem', [
    ('hardware_platform: {robot: [a_robot, "*"]}', '1:38',
     "hardware_platform '*' is not a ROS base name"),
    ('operating_system: [linux/ours]', '1:20',
     "operating_system 'linux/ours' is not a ROS base name"),
    ('hardware_platform:\n  "*": [pr2]', '2:3', "hardware_platform '*' is not a ROS base name"),
    ('application_framework:\n- 1.0', '2:3',
     'a value of application_framework is 1.0, expected text (in quotes)'),
    ('name: [bob]', '1:1', "unknown field 'name' in the rules"),
    ('hardware_platform: ' + '[' * 200, '1:119', 'nested deeper than 100'),
    ('hardware_platform: &a\n  robot: *a', '2:10', "alias '*a' is inside"),
])
def test_rules_with_a_value_that_is_none(workspace, rules, place, problem):
    add_package(workspace, 'bad', {'rules': 'rules.yaml'}, rules_yaml=rules)
    check_library(workspace, {YamlError: ['rules.yaml']})
    findings, complaints, warnings = check_command(workspace)
    assert len(findings) == len(complaints) == len(warnings) == 1
    assert findings[0].startswith('bad/rules.yaml:%s: error: %s' % (place, problem))
    assert complaints[0].startswith('bad/rules.yaml:%s: %s' % (place, problem))
    assert 'left out: bad/rules.yaml:%s: %s' % (place, problem) in warnings[0]


# -- files that change while they are read --------------------------------------------------------

def test_a_spec_that_changes_while_it_is_read_is_one_or_the_other_or_refused(tmp_path):
    path = tmp_path / 'Camera.yaml'
    path.write_text(INTERFACE % 'Camera')
    texts = [INTERFACE % 'Camera', INTERFACE % 'Lift' + '# longer' * 20000, '', 'name: [',
             '\0' * 70000]
    found = set()

    def read():
        try:
            found.add(capability_interface_from_file_path(str(path)).name)
        except InvalidInterface as error:
            assert error.file_name == str(path)
            assert error.line >= 1

    with ThreadPoolExecutor(1) as pool:
        for text in itertools.islice(itertools.cycle(texts), 500):
            writer = pool.submit(path.write_text, text)
            read()
            writer.result()
            read()      # when it is there whole
    assert found == {'Camera', 'Lift'}


def test_packages_that_change_while_they_are_checked(workspace):
    folder = add_package(workspace, 'bad', {'rocon_app': 'peep.rapp'}, peep_rapp='')
    texts = ['compatibility: rocon:/nobody\nlaunch: peep.launch\n', '\n\n' + LOOK, '', '- ' * 1000]
    with while_changing(folder / 'peep.rapp', texts):
        for _ in range(50):
            for finding in check_packages([str(workspace)]):
                assert finding.file_name.endswith(('bad/peep.rapp', 'bad/package.xml'))
            rapps, _ = rapps_from_package_index(package_index_from_package_path(str(workspace)))
            assert 'good/look' in rapps


def test_files_that_are_gone_since_the_packages_were_found(workspace):
    folder = add_package(
        workspace, 'bad', {'capability_interface': 'Lift.yaml', 'rocon_app': 'go.rapp'},
        Lift_yaml=INTERFACE % 'Lift', go_rapp='display: Go')
    index = package_index_from_package_path(str(workspace))
    for file in folder.iterdir():
        file.unlink()
    folder.rmdir()
    specs, spec_faults = spec_index_from_spec_file_index(spec_file_index_from_package_index(index))
    rapps, rapp_faults = rapps_from_package_index(index)
    assert (specs.names, list(rapps)) == (['good/Camera', 'good/camera'], ['good/look'])
    assert [Path(fault.filename).name for fault in spec_faults] == ['Lift.yaml']
    assert [Path(fault.file_name).name for fault in rapp_faults] == ['go.rapp']


@contextmanager
def while_changing(path, texts):
    """Meanwhile, the file is written again and again, with one text after the other."""
    done = threading.Event()

    def write():
        for text in itertools.cycle(texts):
            if done.is_set():
                break
            path.write_text(text)

    with ThreadPoolExecutor(1) as pool:
        writer = pool.submit(write)
        try:
            yield
        finally:
            done.set()
        writer.result()     # raises what it raised
