"""Why not, in one wording: an app and a start are refused with the same reasons."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Dict, List, Tuple

import pytest
from made_packages import make_package

from capabilities.discovery import (
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from capabilities.planning.faults import FaultKind
from capabilities.planning.providers import error_text, plan_start
from rocon_uri.cli import main
from rocon_uri.sources.launch_file import LaunchFiles

INTERFACE = '{name: %s, spec_version: 1, spec_type: interface, interface: }'
SEMANTIC = '{name: %s, spec_version: 1, spec_type: semantic_interface, redefines: ours/%s}'
PROVIDER = '{name: %s, spec_version: 1, spec_type: provider, implements: ours/%s, %s}'

#: For each kind, what starting the capability Need meets: providers as (name, what it implements,
#: the rest of its spec), and the texts that stand before the faults. The interfaces Need, Base and
#: Other are there, and Side, a semantic interface of Base.
CASES: Dict[str, Tuple[List[Tuple[str, str, str]], str]] = {
    'no-interface': ([('need', 'Need', 'depends_on: ours/Bass')], ''),
    'no-provider': ([('need', 'Need', 'depends_on: ours/Base'), ('side', 'Side', '')], ''),
    'unknown-provider': ([('need', 'Need', 'depends_on: {ours/Base: {provider: ours/bsae}}'),
                          ('base', 'Base', '')], "Capability Provider 'ours/bsae' not found "),
    'wrong-provider': ([('need', 'Need', 'depends_on: {ours/Base: {provider: ours/need}}')], ''),
    'ambiguous': ([('need', 'Need', ''), ('want', 'Need', '')], ''),
    'conflict': ([('need', 'Need', 'depends_on: {ours/Base: {provider: ours/base}, ours/Other: }'),
                  ('other', 'Other', 'depends_on: {ours/Base: {provider: ours/side}}'),
                  ('base', 'Base', ''), ('side', 'Side', '')], ''),
    'cycle': ([('need', 'Need', 'depends_on: ours/Base'),
               ('base', 'Base', 'depends_on: ours/Need')], ''),
    'launch-missing': ([('need', 'Need', 'launch_file: godo.launch')], ''),
    'launch-outside': ([('need', 'Need', 'launch_file: ../../ours_two/good.launch')], ''),
    'launch-unreadable': ([('need', 'Need', 'launch_file: .')], ''),
    'launch-not-xml': ([('need', 'Need', 'launch_file: text.launch')], ''),
    'launch-no-launch': ([('need', 'Need', 'depends_on: ours/Base'),
                          ('base', 'Base', 'launch_file: robot.launch')], ''),
    'launch-shared': ([('need', 'Need', 'launch_file: good.launch, depends_on: ours/Base'),
                       ('base', 'Base', 'launch_file: ../specs/good.launch')], ''),
}


def workspace(folder: Path, providers: List[Tuple[str, str, str]]) -> str:
    """The path of a workspace with an app that requires the capability Need, and nothing else."""
    files = {'specs__%s_yaml' % name: PROVIDER % (name, implements, rest)
             for name, implements, rest in providers}
    exports = [('capability_provider', 'specs/%s.yaml' % name) for name, _, _ in providers]
    for name in 'Need', 'Base', 'Other':
        files['specs__%s_yaml' % name] = INTERFACE % name
        exports.append(('capability_interface', 'specs/%s.yaml' % name))
    make_package(
        folder, 'ours', [*exports, ('semantic_capability_interface', 'specs/Side.yaml'),
                         ('rocon_app', 'specs/app.rapp')],
        specs__Side_yaml=SEMANTIC % ('Side', 'Base'), specs__good_launch='<launch/>',
        specs__text_launch='text', specs__robot_launch='<robot/>', specs__app_launch='<launch/>',
        specs__app_rapp='{compatibility: "rocon:/", launch: app.launch, '
                        'required_capabilities: [{name: ours/Need}]}', **files)
    make_package(folder, 'ours_two', good_launch='<launch/>')
    return str(folder)


pytestmark = pytest.mark.usefixtures('no_packages_around')


def app_reasons(path: str, capsys: Any) -> List[Dict[str, Any]]:
    status = main(['apps', '--json', '--all', '--robot', 'rocon:/pc/bob', '--package-path', path])
    assert status == 1
    [app] = json.loads(capsys.readouterr().out)['apps']
    reasons: List[Dict[str, Any]] = app['reasons']
    return reasons


@pytest.mark.parametrize('kind', CASES)
def test_an_app_and_a_start_are_refused_with_the_same_reasons(
        kind: str, tmp_path: Path, capsys: Any) -> None:
    providers, head = CASES[kind]
    path = workspace(tmp_path, providers)
    reasons = app_reasons(path, capsys)
    assert [reason['kind'] for reason in reasons] == [kind]
    index, errors = spec_index_from_spec_file_index(
        spec_file_index_from_package_index(package_index_from_package_path(path)))
    assert errors == []
    plan = plan_start(index, 'ours/Need', launch_files=LaunchFiles())
    assert [fault.reason for fault in plan.faults] == [reason['text'] for reason in reasons]
    assert [fault.to_dict() for fault in plan.faults] == [reason['fault'] for reason in reasons]
    assert error_text(plan) == head + '; '.join(reason['text'] for reason in reasons)


def test_several_reasons_are_joined(tmp_path: Path, capsys: Any) -> None:
    path = workspace(tmp_path, [
        ('need', 'Need', 'launch_file: godo.launch, depends_on: [ours/Base, ours/Othre]'),
        ('base', 'Base', 'launch_file: text.launch')])
    reasons = app_reasons(path, capsys)
    assert [reason['kind'] for reason in reasons] == [
        'no-interface', 'launch-not-xml', 'launch-missing']
    index, _ = spec_index_from_spec_file_index(
        spec_file_index_from_package_index(package_index_from_package_path(path)))
    plan = plan_start(index, 'ours/Need', launch_files=LaunchFiles())
    assert error_text(plan) == '; '.join(reason['text'] for reason in reasons)


def test_there_is_a_case_for_each_kind_that_an_app_can_meet() -> None:
    of_the_server = {FaultKind.NO_NODELET_MANAGER.value}
    assert set(CASES) == {kind.value for kind in FaultKind} - of_the_server
