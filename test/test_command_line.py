"""What people expect of any command: help where they look for it, near misses, a version."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from importlib import import_module

import pytest
from sources import ROOT, SOURCE
from terminal import open_terminal

from rocon_uri.cli import VERBS, main
from rocon_uri.cli.json_forms import json_forms

SCRIPT = str(ROOT / 'scripts' / 'rocon_uri')
FLEET = str(ROOT / 'examples' / 'fleet.txt')


def run(*arguments, command=(sys.executable, SCRIPT), stdin='', **changes):
    environment = {name: value for name, value in os.environ.items() if name != 'COLUMNS'}
    return subprocess.run([*command, *arguments], input=stdin, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True,
                          env={**environment, 'PYTHONPATH': str(SOURCE), **changes})


# -- help ------------------------------------------------------------------------------------------

def test_without_arguments_there_is_a_line_for_each_verb(capsys):
    assert main([]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert [line.split()[0] for line in lines] == ['usage:', *VERBS]
    assert 'rocon_uri help VERB' in lines[0] and len(lines) <= 12


@pytest.mark.parametrize('verb', ['specs', 'capabilities'])
@pytest.mark.parametrize('more', [[], ['--json']])
def test_a_verb_without_one_of_its_own_has_a_line_for_each(verb, more, capsys):
    assert main([verb, *more]) == 2
    out, err = capsys.readouterr()
    assert [line.split()[0] for line in err.splitlines()] == [
        'usage:', *import_module('rocon_uri.cli.' + verb).VERBS]
    assert out == '' and 'rocon_uri help %s VERB' % verb in err


@pytest.mark.parametrize('names, title', [
    ([], 'usage: rocon_uri '), (['match'], 'usage: rocon_uri match '),
    (['help'], 'usage: rocon_uri '), (['-h', 'match', '--help'], 'usage: rocon_uri match '),
    (['specs', 'check'], 'usage: rocon_uri specs check '), (['json'], 'The JSON that each verb')])
@pytest.mark.parametrize('word', ['help', '--help', '-h'])
def test_help_is_asked_for_by_a_verb_or_an_option(word, names, title, capsys):
    assert main([word, *names]) == 0
    assert capsys.readouterr().out.startswith(title)


def test_help_is_there_for_who_asks_for_json_first(capsys):
    assert main(['--json', 'help', 'match']) == 0
    assert capsys.readouterr().out.startswith('usage: rocon_uri match ')


def test_the_forms_of_json_are_in_one_place(capsys):
    assert main(['help', 'json']) == 0
    shown = capsys.readouterr().out
    for verb in VERBS:
        assert re.search(r'^rocon_uri %s$' % verb, shown, re.MULTILINE)
    for verb in 'specs check', 'capabilities status':
        assert re.search(r'^rocon_uri %s$' % verb, shown, re.MULTILINE)
    assert not re.search(r'\n\n\n|\n\Z', json_forms(VERBS))   # nothing is empty


@pytest.mark.parametrize('columns, width', [('60', 60), ('90', 90), ('200', 100), ('', 80)])
def test_help_is_as_wide_as_the_terminal(columns, width, monkeypatch, capsys):
    monkeypatch.setenv('COLUMNS', columns)
    assert main(['help', 'apps']) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith('  roc')]
    assert width - 10 < max(map(len, lines)) <= width


# -- near misses -----------------------------------------------------------------------------------

@pytest.mark.parametrize('arguments, error', [
    (['chek', 'x', '-y'],
     "rocon_uri: 'chek' is not a verb (did you mean 'check'?); rocon_uri help lists them\n"),
    (['help', 'aps'],
     "rocon_uri: 'aps' is not a verb (did you mean 'apps'?); rocon_uri help lists them\n"),
    (['parse', 'rocon:/pr2', '--jsn'],
     "rocon_uri parse: error: --jsn is not an option (did you mean '--json'?)\n"),
    (['match', '--requests_in=x'],
     "rocon_uri match: error: --requests_in is not an option (did you mean '--requests-in'?)\n"),
    (['specs', 'chekc'], "rocon_uri specs: error: argument VERB: 'chekc' is none of list, show, "
     "check, graph (did you mean 'check'?)\n"),
    (['specs', 'list', '--jsonn'],
     "rocon_uri specs list: error: --jsonn is not an option (did you mean '--json'?)\n"),
    (['specs', '--jsonn', 'list'],
     "rocon_uri specs: error: --jsonn is not an option (did you mean '--json'?)\n"),
    (['--vresion'], "rocon_uri: error: --vresion is not an option (did you mean '--version'?)\n"),
    (['fields', 'operating_systems'], "rocon_uri fields: error: argument FIELD: "
     "'operating_systems' is none of hardware_platform, application_framework, operating_system "
     "(did you mean 'operating_system'?)\n"),
])
def test_what_was_probably_meant_is_said(arguments, error, capsys):
    assert main(arguments) == 2
    printed = capsys.readouterr()
    assert printed.out == ''
    assert re.sub(r'\Ausage: [^\n]*\n( [^\n]*\n)*', '', printed.err) == error


# -- json, version, module -------------------------------------------------------------------------

def test_json_stands_before_or_after_the_verb(capsys):
    printed = []
    for arguments in (['--json', 'parse', 'rocon:/pr2'], ['parse', '--json', 'rocon:/pr2'],
                      ['parse', 'rocon:/pr2', '--json']):
        assert main(arguments) == 0
        printed.append(capsys.readouterr().out)
    assert printed[0].startswith('{') and len(set(printed)) == 1


@pytest.mark.parametrize('arguments', [
    ['match', 'rocon:/kobuki', '--in', FLEET, 'rocon:/pr2'],
    ['specs', 'check', 'examples/workspace/cafe_cart', '--package-path', 'examples/workspace', '-q',
     'examples/workspace/cafe_rapps'],
    ['parse', '--in=' + FLEET, 'rocon:/pr2', '-q', '--', 'rocon:/kobuki'],
    ['fields', '--json', 'operating_system'],
])
def test_options_may_stand_between_arguments(arguments, capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    assert main(arguments) == 0
    assert capsys.readouterr().err == ''


@pytest.mark.parametrize('arguments, error', [
    (['match', 'rocon:/pr2', '--in'], 'argument --in: expected one argument'),
    (['match', '--in', '--json', 'rocon:/pr2'], 'argument --in: expected one argument'),
    (['fields', 'name', '-q'], "'name' is none of"),
    (['check', 'rocon:/pr2', '--json', 'rocon:/pr2', 'c'], 'unrecognized arguments: c'),
])
def test_options_between_arguments_take_none_of_them(arguments, error, capsys):
    assert main(arguments) == 2
    assert error in capsys.readouterr().err


def test_what_follows_two_hyphens_is_no_option(capsys):
    assert main(['parse', 'rocon:/pr2', '--', '-q', '--json', '-1']) == 2
    assert re.findall(r"'(-.*)' does not start with", capsys.readouterr().err) == [
        '-q', '--json', '-1']


def test_the_module_and_the_script_are_one_command():
    for arguments in ['--version'], ['parse', 'rocon:/pr2'], ['parse', 'zork']:
        script = run(*arguments)
        module = run(*arguments, command=(sys.executable, '-m', 'rocon_uri'))
        assert (module.returncode, module.stdout, module.stderr) == (
            script.returncode, script.stdout, script.stderr)


# -- files of URIs ---------------------------------------------------------------------------------

def test_parse_reads_a_file_and_standard_input(tmp_path):
    whole = run('parse', '--in', FLEET)
    assert whole.returncode == 0 and whole.stdout.count('\n  canonical ') > 20
    fleet = tmp_path / 'fleet.txt'
    fleet.write_text('# ours\n  # indented\nrocon:/pr2/bob\n\nrocon:/zork\n')
    with fleet.open() as file:
        done = subprocess.run([sys.executable, SCRIPT, 'parse', 'rocon:/pc', '--in', '-'],
                              stdin=file, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              universal_newlines=True)
    assert done.returncode == 2 and done.stderr.startswith('<stdin>:5: ')
    assert [line for line in done.stdout.splitlines() if line.startswith('rocon:')] == [
        'rocon:/pc', 'rocon:/pr2/bob']
    quiet = run('parse', '--quiet', '--in', str(fleet))
    assert (quiet.returncode, quiet.stdout) == (2, '') and quiet.stderr.count('\n') == 1
    assert run('parse').stderr == (
        'rocon_uri parse: error: give a URI, or a file of them with --in\n')


@pytest.mark.parametrize('arguments', [['match', 'rocon:/', '--in', '-'], ['parse', '--in', '-']])
def test_who_types_the_input_is_told_that_it_is_waited_for(arguments):
    ours, theirs = open_terminal()
    with subprocess.Popen([sys.executable, SCRIPT, *arguments], stdin=theirs,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        os.close(theirs)
        assert process.stderr.readline() == (
            b'rocon_uri: reading standard input, one URI a line; Ctrl-D ends it\n')
        os.write(ours, b'rocon:/pr2\n\x04')
        assert b'rocon:/pr2\n' in process.stdout.read()
        assert process.wait() == 0
    os.close(ours)


def test_who_types_the_input_sees_no_progress_bar():
    pytest.importorskip('tqdm', reason='tqdm is not installed')
    ours, theirs = open_terminal()
    with subprocess.Popen([sys.executable, SCRIPT, 'match', 'rocon:/', '--in', '-'], stdin=theirs,
                          stdout=subprocess.PIPE, stderr=theirs) as process:
        os.close(theirs)
        seen = b''
        while b'Ctrl-D ends it' not in seen:
            seen += os.read(ours, 4096)
        os.write(ours, b'rocon:/pr2\n\x04')
        assert process.stdout.read() == b'rocon:/pr2\n' and process.wait() == 0
    try:
        while True:
            seen += os.read(ours, 4096)
    except OSError:     # Linux has no end of file here, but this
        pass
    os.close(ours)
    assert b'B/s' not in seen


# -- without what it needs -------------------------------------------------------------------------

@pytest.mark.parametrize('module, package', [('catkin_pkg', 'python3-catkin-pkg'),
                                             ('yaml', 'python3-yaml')])
def test_a_python_module_that_is_not_installed_is_one_line(module, package, tmp_path):
    (tmp_path / (module + '.py')).write_text(
        'raise ModuleNotFoundError("No module named %r", name=%r)\n' % (module, module))
    shutil.copytree(str(ROOT / 'examples' / 'workspace'), str(tmp_path / 'src'))
    done = run('specs', 'check', str(tmp_path / 'src'),
               PYTHONPATH='%s:%s' % (tmp_path, SOURCE))
    assert done.returncode == 2 and done.stdout == ''
    assert done.stderr.startswith('rocon_uri: specs needs the Python module %s, which ' % module)
    assert 'apt-get install %s' % package in done.stderr and done.stderr.count('\n') == 1
    done = run('--json', 'specs', 'check', str(tmp_path / 'src'),
               PYTHONPATH='%s:%s' % (tmp_path, SOURCE))
    assert done.stdout.startswith('{') and module in done.stdout
