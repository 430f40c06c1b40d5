"""specs check: what it is given, what it leaves out, and the forms in which it answers."""
from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from itertools import count
from xml.etree import ElementTree

import pytest
from made_packages import make_package
from sources import ROOT
from test_cli import run, run_on_terminal

from rocon_uri import lint
from rocon_uri.cli import main
from rocon_uri.lint import ERROR, WARNING, Finding
from rocon_uri.lint.explanations import EXPLANATIONS
from rocon_uri.lint.junit import junit_text

RAPP = 'display: Dance\ndescription: A dance\ncompatibility: rocon:/pr2\nlaunch: dance.launch\n'
CAMERA = ('name: Camera\nspec_version: 1\nspec_type: interface\ninterface:\n'
          '  topics: {provides: {image: {type: sensor_msgs/Image}}}\n')
USB = 'name: usb\nspec_version: 1\nspec_type: provider\nimplements: theirs/Camera\n'


pytestmark = pytest.mark.usefixtures('no_packages_around')


@pytest.fixture
def check(capsys):
    """Run the verb, and return its status, output and errors."""
    def run(*arguments):
        status = main(['specs', 'check', *map(str, arguments)])
        out, err = capsys.readouterr()
        return status, out, err
    return run


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """Two packages: ours has an error and a warning, and refers to theirs."""
    make_package(tmp_path / 'src', 'ours', [('rocon_app', 'rapps/dance.rapp'),
                                            ('capability_provider', 'usb.yaml')],
                 rapps__dance_rapp=RAPP + 'icon: dance.png\n', usb_yaml=USB,
                 other_yaml='a: b', x_launch='<launch/>', readme_txt='')
    make_package(tmp_path / 'around', 'theirs', [('capability_interface', 'Camera.yaml')],
                 Camera_yaml=CAMERA)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def found(answer):
    """The places and ids in an answer."""
    return [(line.partition(' ')[0].rstrip(':'), line.rpartition('[')[2].rstrip(']'))
            for line in answer[1].splitlines()]


DANCE = 'src/ours/rapps/dance.rapp'
OF_DANCE = [(DANCE + ':4:9', 'launch-missing'), (DANCE + ':5:7', 'file-missing')]
OF_USB = ('src/ours/usb.yaml:4:13', 'no-interface')


# What is given

@pytest.mark.parametrize('arguments, expected, end', [
    (['src'], [*OF_DANCE, OF_USB], '1 package'),
    ([], OF_DANCE, '2 packages'),
    (['src', '--package-path', 'around'], OF_DANCE, '1 package'),
    (['src/ours/'], [*OF_DANCE, OF_USB], '1 package'),
    (['ours', '--package-path', 'src:around'], OF_DANCE, '1 package'),
    (['ours', 'theirs', '--package-path', 'src', '--package-path', 'around'], OF_DANCE,
     '2 packages'),
    ([DANCE], OF_DANCE, '1 file'),
    (['src/ours/rapps'], OF_DANCE, '1 file'),
    (['src/ours/usb.yaml'], [], '1 file'),          # theirs is below the working directory
    (['src/ours/package.xml', DANCE], OF_DANCE, '2 files'),
    (['src/ours/other.yaml', 'src/ours/readme.txt', 'src/ours/x.launch'], [], 'no files'),
])
def test_what_is_checked(check, workspace, arguments, expected, end):
    answer = check(*arguments)
    assert found(answer) == expected
    assert answer[2].endswith(' in %s\n' % end)
    assert answer[0] == any('missing' in place_id[1] or place_id == OF_USB
                            for place_id in expected)


def test_a_launch_file_is_checked_as_what_names_it(check, workspace):
    launch = workspace / 'src/ours/rapps/dance.launch'
    launch.write_text('<robot/>')
    (workspace / 'src/ours/x.launch').write_text('<robot/>')        # named by nothing
    assert found(check('src/ours/rapps/dance.launch', 'src/ours/x.launch')) == [
        ('src/ours/rapps/dance.launch:1:1', 'launch-no-launch')]


def test_a_single_file_is_checked_from_within_its_package(check, workspace, monkeypatch):
    monkeypatch.chdir(workspace / 'src/ours/rapps')
    assert found(check('dance.rapp', '--package-path', workspace / 'around')) == [
        ('dance.rapp:4:9', 'launch-missing'), ('dance.rapp:5:7', 'file-missing')]
    assert found(check()) == found(check('.')) == found(check('dance.rapp'))


@pytest.mark.parametrize('name', ['x.rapp', 'x.app', 'x.installed', 'x.interactions'])
def test_a_file_in_no_package_is_a_warning_if_it_should_be_in_one(check, workspace, name):
    (workspace / name).write_text('{}')
    assert found(check(name)) == [(name, 'no-package')]


@pytest.mark.parametrize('name', ['x.yaml', 'x.launch', 'x.txt'])
def test_another_file_in_no_package_is_left_out(check, workspace, name):
    (workspace / name).write_text('[')
    assert check(name) == (0, '', 'rocon_uri: no errors and no warnings in no files\n')


def test_a_bad_manifest_of_a_single_file_is_an_error(check, workspace):
    (workspace / 'src/ours/package.xml').write_text('<package>')
    assert found(check(DANCE)) == [('src/ours/package.xml:1:10', 'invalid-manifest')]


def test_one_form_of_output_is_given(check, workspace):
    status, out, err = check('--json', '--format', 'sarif', 'src')
    assert (status, out, err) == (
        2, '', 'rocon_uri specs check: error: give --json or --format sarif\n')
    assert check('--json', '--format', 'json', 'src')[0] == 1


def test_two_packages_of_one_name_are_not_taken_for_one(check, workspace):
    make_package(workspace / 'copy', 'ours', [('rocon_app', 'a.rapp')], a_rapp='[')
    assert found(check(DANCE, 'copy/ours/a.rapp')) == [
        ('copy/ours/package.xml', 'duplicate-package'), *OF_DANCE]
    assert found(check('copy/ours/a.rapp', DANCE)) == [
        ('copy/ours/a.rapp:2:1', 'not-yaml'), ('src/ours/package.xml', 'duplicate-package')]
    assert found(check('copy', 'src')) == [
        ('copy/ours/a.rapp:2:1', 'not-yaml'), ('src/ours/package.xml', 'duplicate-package')]


def test_a_manifest_that_leads_nowhere_is_an_error(check, workspace):
    (workspace / 'gone').mkdir()
    (workspace / 'gone/package.xml').symlink_to('nowhere')
    assert found(check('gone/package.xml')) == [('gone/package.xml', 'cannot-read')]


def test_a_name_that_is_nothing_has_near_misses(check, workspace):
    status, _, err = check('our', '--package-path', 'src')
    assert status == 2
    assert ("'our' is not a file, a directory or a package on the package path "
            "(did you mean 'ours'?)") in err


# What is left out

def test_ids_are_ignored(check, workspace):
    assert found(check('ours', '--package-path', '.', '--ignore', 'file-missing')) == OF_DANCE[:1]
    status, out, _ = check('ours', '--package-path', '.', '--ignore', 'file-missing',
                           '--ignore', 'launch-missing')
    assert (status, out) == (0, '')


def test_an_id_to_ignore_that_is_none_is_bad(check, workspace):
    status, _, err = check(DANCE, '--ignore', 'launch-mising')
    assert status == 2 and "'launch-mising' is not the id of a finding (did you mean " in err


def test_warnings_as_errors(check, workspace):
    arguments = ['ours', '--package-path', '.', '--ignore', 'launch-missing']
    assert check(*arguments)[0] == 0
    status, out, err = check(*arguments, '--warnings-as-errors')
    assert status == 1 and ':5:7: error: ' in out and '1 error and no warnings' in err


def test_quiet_prints_findings_only(check, workspace):
    status, out, err = check(DANCE, '-q')
    assert (status, out.count('\n'), err) == (1, 2, '')


# Explanations

def test_explain(check):
    status, out, err = check('--explain', 'one-slash')
    assert (status, err) == (0, '')
    assert out.splitlines()[0] == 'one-slash' and '\nWhy: ' in out and '\nMend: ' in out
    assert json.loads(check('--explain', 'cycle', '--json')[1]) == {
        **EXPLANATIONS['cycle']._asdict(), 'errors': []}


def test_explain_of_what_is_no_id(check):
    status, out, err = check('--explain', 'one-slsh')
    assert (status, out) == (2, '') and "(did you mean 'one-slash'?)" in err


# Forms

def test_format_json_is_json(check, workspace):
    answer = check(DANCE, '--format', 'json')
    assert answer == check(DANCE, '--json')
    assert [finding['id'] for finding in json.loads(answer[1])['findings']] == [
        'launch-missing', 'file-missing']


def test_format_junit_has_a_test_for_each_file(check, workspace):
    status, out, _ = check('ours', '--package-path', '.', '--format', 'junit')
    suite = ElementTree.fromstring(out.encode())
    assert status == 1
    assert [(case.get('name'), [below.tag for below in case]) for case in suite] == [
        ('src/ours/package.xml', []), (DANCE, ['failure']), ('src/ours/usb.yaml', [])]
    assert float(suite.get('time')) >= max(float(case.get('time')) for case in suite) - 0.001
    assert any(float(case.get('time')) > 0 for case in suite)


def test_a_report_says_how_many_errors_are_in_a_file_and_shows_its_warnings():
    findings = [Finding('a.rapp', 1, 1, ERROR, 'no', 'cycle'),
                Finding('a.rapp', 2, 1, ERROR, 'no', 'cycle'),
                Finding('b.rapp', 3, 1, WARNING, 'a < b', 'one-slash'),
                Finding('a.rapp', 4, 1, WARNING, 'well', 'one-slash'),
                Finding('c.rapp', None, None, ERROR, 'no', 'no-package')]
    suite = ElementTree.fromstring(junit_text(findings, {'a.rapp': 1, 'b.rapp': 0.5}))
    assert suite.attrib == {'name': 'rocon_uri_check', 'tests': '3', 'failures': '2',
                            'errors': '0', 'time': '1.5000'}
    assert [(case.get('name'), case.get('time'), below.tag, below.attrib, below.text)
            for case in suite for below in case] == [
        ('a.rapp', '1.0000', 'failure', {'message': '2 errors', 'type': 'error'}, '\n'.join([
            'a.rapp:1:1: error: no [cycle]', 'a.rapp:2:1: error: no [cycle]',
            'a.rapp:4:1: warning: well [one-slash]'])),
        ('b.rapp', '0.5000', 'system-out', {}, 'b.rapp:3:1: warning: a < b [one-slash]'),
        ('c.rapp', '0.0000', 'failure', {'message': '1 error', 'type': 'error'},
         'c.rapp: error: no [no-package]')]


def times(check, *arguments):
    """The files in a report, each with the time that it took; the last is that of all."""
    suite = ElementTree.fromstring(check(*arguments, '--format', 'junit')[1].encode())
    return [*((case.get('name'), case.get('time')) for case in suite), suite.get('time')]


def test_the_time_of_a_file_is_that_of_all_its_checks(check, workspace, monkeypatch):
    monkeypatch.setattr(lint, 'perf_counter', count(1).__next__)        # a second for each check
    assert times(check, 'ours', '--package-path', '.') == [
        ('src/ours/package.xml', '2.0000'), (DANCE, '1.0000'), ('src/ours/usb.yaml', '1.0000'),
        '4.0000']


def test_a_file_that_cannot_be_read_takes_no_time(check, workspace):
    (workspace / 'src/ours/package.xml').write_text('<package>')
    assert times(check, 'src') == [('src/ours/package.xml', '0.0000'), '0.0000']


def test_rules_and_lists_of_apps_of_the_package_are_files_that_are_checked(
        check, tmp_path, monkeypatch):
    folder = make_package(tmp_path, 'ours', rules_yaml='{}', apps__x_installed='apps: []')
    (tmp_path / 'elsewhere.yaml').write_text('{}')
    (folder / 'package.xml').write_text((folder / 'package.xml').read_text().replace(
        '<export>', '<depend>app_manager</depend><export><app_manager app_dir="apps"/>' + ''.join(
            '<rocon_uri rules="%s"/>' % path
            for path in ('rules.yaml', '../elsewhere.yaml', 'gone.yaml'))))
    monkeypatch.chdir(folder)
    assert [file for file, _ in times(check, '.')[:-1]] == [
        'apps/x.installed', 'package.xml', 'rules.yaml']


def test_a_report_is_xml_whatever_a_file_is_called(check, workspace):
    (workspace / 'src/ours/a\x01\udcff.interactions').write_text('7')
    for arguments in (['--format', 'junit'], ['--junit', 'report.xml']):
        _, out, _ = check('src', '-q', *arguments)
        text = out if arguments[0] == '--format' else (workspace / 'report.xml').read_text()
        cases = ElementTree.fromstring(text.encode())
        assert 'src/ours/a\\x01\\udcff.interactions' in [case.get('name') for case in cases]


def sarif(check, *arguments):
    status, out, _ = check(*arguments, '--format', 'sarif')
    return json.loads(out)


def test_format_sarif(check, workspace, tmp_path):
    log = sarif(check, 'ours', '--package-path', '.')
    (run,) = log['runs']
    assert log['version'] == '2.1.0' and 'sarif-2.1.0' in log['$schema']
    assert run['columnKind'] == 'unicodeCodePoints'
    assert [rule['id'] for rule in run['tool']['driver']['rules']] == [
        'launch-missing', 'file-missing']
    assert [(result['ruleId'], result['ruleIndex'], result['level'])
            for result in run['results']] == [
        ('launch-missing', 0, 'error'), ('file-missing', 1, 'warning')]
    assert run['results'][0]['locations'] == [{'physicalLocation': {
        'artifactLocation': {'uri': DANCE, 'uriBaseId': '%SRCROOT%'},
        'region': {'startLine': 4, 'startColumn': 9}}}]


def test_sarif_has_uris_that_are_legal_and_absolute_ones_of_what_is_elsewhere(
        check, workspace, monkeypatch):
    make_package(workspace, 'x y', [('rocon_app', 'é#.rapp')])
    (workspace / 'x y' / 'package.xml').write_text(
        (workspace / 'x y' / 'package.xml').read_text().replace('x y', 'x_y'))
    (workspace / 'x y' / 'é#.rapp').write_text(RAPP)
    (run,) = sarif(check, 'x y')['runs']
    uris = [result['locations'][0]['physicalLocation']['artifactLocation']['uri']
            for result in run['results']]
    assert set(uris) == {'x%20y/%C3%A9%23.rapp'}
    monkeypatch.chdir(ROOT)
    (run,) = sarif(check, workspace / DANCE)['runs']
    location = run['results'][0]['locations'][0]['physicalLocation']['artifactLocation']
    assert location == {'uri': (workspace / DANCE).as_uri()}


def test_columns_are_counted_in_code_points(check, workspace):
    (workspace / DANCE).write_text('{display: "\U0001d11eé", colour: red, %s}' % RAPP.replace(
        'display: Dance\n', '').strip().replace('\n', ', '))
    (run,) = sarif(check, DANCE, '--ignore', 'launch-missing')['runs']
    (result,) = run['results']
    assert result['locations'][0]['physicalLocation']['region'] == {
        'startLine': 1, 'startColumn': 17}


@pytest.mark.parametrize('mark', ['', '\ufeff'])
def test_a_byte_order_mark_is_no_column(check, tmp_path, monkeypatch, mark):
    folder = make_package(tmp_path, 'ours', [('rocon_app', 'b.rapp'), ('rocon_app', 'no.rapp')],
                          b_rapp='{compatibility: "rocon:/pr3", launch: a.launch, display: A}')
    (folder / 'a.launch').write_text('<robot/>')
    (folder / 'c.interactions').write_text('[{name: A, compatibility: "rocon:/", command: c}, 7]')
    manifest = folder / 'package.xml'
    manifest.write_text(' '.join(manifest.read_text().split()))
    for path in folder.iterdir():
        path.write_text(mark + path.read_text())
    monkeypatch.chdir(folder)
    column = manifest.read_text().index('<rocon_app>no') + 1 - len(mark)
    assert found(check()) == [
        ('a.launch:1:1', 'launch-no-launch'), ('b.rapp:1:1', 'missing-key'),
        ('b.rapp:1:25', 'invalid-uri'), ('c.interactions:1:51', 'wrong-value'),
        ('package.xml:1:%d' % column, 'file-missing')]
    shown = run_on_terminal('specs', 'check', str(folder), NO_COLOR='1')
    assert '    {compatibility: "rocon:/pr3"' in shown and '    <robot/>\n    ^\n' in shown


@pytest.mark.parametrize('mark', [b'', b'\xef\xbb\xbf'])
def test_nor_is_it_where_a_launch_file_is_not_xml(check, workspace, mark):
    (workspace / 'src/ours/rapps/dance.launch').write_bytes(mark + b'<launch></lanch>')
    assert found(check('src/ours/rapps/dance.launch')) == [
        ('src/ours/rapps/dance.launch:1:11', 'launch-not-xml')]


def oracle(name):
    """A module of PyPI that test/lint_requirements.txt names, in a Python that has it."""
    pythons = list((ROOT / 'build' / 'lint' / 'bin').glob('python3'))
    if not pythons or subprocess.run([str(pythons[0]), '-c', 'import ' + name],
                                     stderr=subprocess.DEVNULL).returncode:
        if os.environ.get('CI') and sys.version_info >= (3, 10):    # which it needs
            pytest.fail('%s is not installed' % name)
        pytest.skip('%s is not installed' % name)
    return str(pythons[0])


def test_others_read_the_sarif(check, workspace):
    python = oracle('sarif_pydantic')
    (workspace / 'x.sarif').write_text(check('.', '--format', 'sarif')[1])
    script = ('import sarif_pydantic, sys\n'
              'log = sarif_pydantic.Sarif.model_validate_json(open(sys.argv[1]).read())\n'
              'print([result.rule_id for result in log.runs[0].results])')
    assert subprocess.check_output([python, '-c', script, 'x.sarif'], text=True).strip() == (
        "['launch-missing', 'file-missing']")


def test_sarif_tools_make_a_summary_of_it(check, workspace):
    python = oracle('sarif')
    (workspace / 'x.sarif').write_text(check('.', '--format', 'sarif')[1])
    summary = subprocess.check_output([python, '-m', 'sarif', 'summary', 'x.sarif'], text=True)
    assert re.search(r'error: 1\n - launch-missing.*: 1', summary)
    assert re.search(r'warning: 1\n - file-missing.*: 1', summary)


# On a terminal

def test_on_a_terminal_a_finding_has_colour_and_its_line(workspace):
    shown = run_on_terminal('specs', 'check', str(workspace / DANCE), TERM='xterm')
    assert '\x1b[31merror\x1b[0m: launch file' in shown
    assert '\x1b[33mwarning\x1b[0m: icon' in shown
    assert '    launch: dance.launch\n            ^^^^^^^^^^^^\n' in shown


def test_without_colour_it_still_has_its_line(workspace):
    shown = run_on_terminal('specs', 'check', str(workspace / DANCE), NO_COLOR='1')
    assert '\x1b' not in shown
    assert '    icon: dance.png\n          ^^^^^^^^^\n' in shown


@pytest.mark.parametrize('columns', [80, 100, 200])
def test_a_line_is_cut_where_the_terminal_would_wrap_it(workspace, columns):
    (workspace / DANCE).write_text('{%s, icon: dance.png, colour: %s}' % (
        RAPP.strip().replace('\n', ', '), 'b' * 200))
    shown = run_on_terminal('specs', 'check', str(workspace / DANCE), COLUMNS=str(columns))
    lines = re.findall('\n(    .*\\.\\.\\.)\n', shown)
    assert len(lines) == 3 and all(columns / 2 < len(line) <= columns for line in lines)


def test_a_long_line_is_cut_around_the_place(workspace):
    (workspace / DANCE).write_text('{%s, icon: dance.png, colour: %s}' % (
        RAPP.strip().replace('\n', ', ').replace('A dance', 'a' * 200), 'b' * 200))
    shown = run_on_terminal('specs', 'check', str(workspace / DANCE), NO_COLOR='1')
    marked = []
    for line, below in re.findall('    (.*)\n    ( *\\^+)\n', shown):
        assert len(line) < 110 and line.startswith('...') and line.endswith('...')
        marked.append(line[below.index('^'):len(below)])
    assert sorted(marked) == ['colour', 'dance.launch', 'dance.png']


def test_carets_end_where_a_long_line_is_cut(workspace):
    name = 'd' * 63 + '.launch'
    (workspace / DANCE).write_text(RAPP.replace('dance.launch', name))
    shown = run_on_terminal('specs', 'check', str(workspace / DANCE), NO_COLOR='1')
    [(line, below)] = re.findall('    (launch.*)\n    ( *\\^+)\n', shown)
    assert line.endswith('...') and len(below) == len(line) - 3
    assert line[below.index('^'):len(below)] == name[:below.count('^')]


def test_carets_are_below_text_after_wide_characters(workspace):
    (workspace / DANCE).write_text('{display: \u8e0a\u308b, description: e\u0301, icon: no.png}')
    shown = run_on_terminal('specs', 'check', str(workspace / DANCE), NO_COLOR='1')
    [(line, below)] = re.findall('    (.*)\n    ( *\\^{6})\n', shown)
    # two columns more for the first two characters, one less for the accent
    assert line[below.index('^') - 1:].startswith('no.png')


@pytest.mark.parametrize('verb, found, logged', [
    (['specs', 'check', '.'], ['bad', 'worse'], ['of_machine']),
    (['specs', 'check', 'src/bad/r.yaml'], ['bad'], ['of_machine', 'worse']),
    (['specs', 'check', 'other'], [], ['bad', 'of_machine', 'worse']),
    (['apps', '--robot', 'rocon:/pr2'], [], ['of_machine']),        # which counts the others
    (['specs', 'list'], [], ['of_machine'])])
def test_the_fault_of_a_file_of_rules_is_shown_once(workspace, verb, found, logged):
    """Whoever has sourced a workspace has on the package path what is checked."""
    for name in 'bad', 'worse', 'other':
        folder = make_package(workspace / ('src' if name != 'other' else ''), name,
                              r_yaml='platform: [x]' if name != 'other' else '{}')
        manifest = folder / 'package.xml'
        manifest.write_text(manifest.read_text().replace(
            '<export>', '<export><rocon_uri rules="r.yaml"/>'))
    (workspace / 'of_machine').mkdir()
    (workspace / 'of_machine/r.yaml').write_text('platform: [x]')
    shown = run(*verb, ROS_PACKAGE_PATH=str(workspace / 'src'),
                ROCON_URI_RULES=str(workspace / 'of_machine/r.yaml'))
    faulty = re.findall('(.*/)?(.+)/r.yaml:1:1: .*unknown field', shown.stdout + shown.stderr)
    assert sorted(name for _, name in faulty) == sorted(found + logged)
    assert sorted(re.findall('rules left out: .*/(.+)/r.yaml:', shown.stderr)) == logged
