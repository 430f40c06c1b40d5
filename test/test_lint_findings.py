"""The ids of findings: each is explained, on the page and by the command, and can be ignored."""
from __future__ import annotations

import ast
import re
import runpy

import pytest
from made_packages import make_package
from sources import ROOT

from rocon_uri.lint import check_packages
from rocon_uri.lint.explanations import EXPLANATIONS
from rocon_uri.sources.located import LocatedError
from rocon_uri.sources.yaml_source import load

RAPP = 'display: Dance\ndescription: A dance\ncompatibility: rocon:/pr2\nlaunch: dance.launch\n'

# the functions that take an id as their last argument
_NAMED = {'add', 'check', 'check_exists', 'error', 'fault', 'warn', 'with_id', 'Finding', '_error'}


def ids_in_source():
    """The ids that the source gives to faults and findings."""
    found = set()
    for path in (ROOT / 'src').rglob('*.py'):
        for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
            if isinstance(node, ast.Call) and node.args:
                function = node.func
                name = getattr(function, 'attr', getattr(function, 'id', ''))
                last = node.args[-1]
                if name in _NAMED and isinstance(getattr(last, 'value', None), str) and (
                        re.fullmatch('[a-z]+(-[a-z]+)+|cycle', last.value)):
                    found.add(last.value)
            elif isinstance(node, ast.Assign) and getattr(node.targets[0], 'id', '') == 'id' and (
                    isinstance(node.value, ast.Constant)):
                found.add(node.value.value)
    from rocon_uri.sources import launch_file
    return found | {launch_file.MISSING, launch_file.NOT_XML, launch_file.NO_LAUNCH,
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


@pytest.mark.parametrize('configuration, found', [
    ('', ['a/dance.rapp', 'b.rapp']), ('ignore: [launch-missing]', []),
    ('ignore:', ['a/dance.rapp', 'b.rapp']),
    ("ignore: ['launch-missing:*.rapp']", []), ("ignore: ['launch-missing:a/*']", ['b.rapp']),
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
    ('ignore: [7]', 'wrong-value'), ('ignore: [launch-mising]', 'wrong-value'),
    ('ingore: []', 'unknown-key')])
def test_a_faulty_configuration_is_a_finding(tmp_path, monkeypatch, configuration, finding):
    (make_package(tmp_path, 'ours') / '.rocon_uri.yaml').write_text(configuration)
    assert ids(tmp_path, monkeypatch) == [('ours/.rocon_uri.yaml', finding)]
