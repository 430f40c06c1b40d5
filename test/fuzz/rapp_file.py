"""Rapps, their public interfaces and interactions: read, inherited, linted and judged."""
from __future__ import annotations

import tempfile
from pathlib import Path

import yaml
from capabilities.discovery import (
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from fuzz.damage import ROOT, damaged_yaml, files
from fuzz.findings import check_findings
from made_packages import make_package

from rocon_uri import RoconURIValueError, is_compatible
from rocon_uri.lint import ERROR, check_package_index
from rocon_uri.apps.rapps import InvalidRapp, rapp_from_string, rapps_from_package_index, runnable
from rocon_uri.sources.packages import find_packages
from rocon_uri.sources.yaml_data import YamlMapping


OTHERS = package_index_from_package_path(str(ROOT / 'examples/workspace/cafe_capabilities'))
LINT_OTHERS = find_packages([str(ROOT / 'examples/workspace/cafe_capabilities')])
SPECS, _ = spec_index_from_spec_file_index(spec_file_index_from_package_index(OTHERS))
ROBOT = 'rocon:/waiterbot/bob/noetic/focal'

GOOD = {kind: [path.read_text() for path in files('*.' + kind)]
        for kind in ('rapp', 'interface', 'interactions')}
GOOD['rapp'].append('''\
compatibility: rocon:/robot
launch: dance.launch
parent_name: parent
public_interface: dance.interface
required_capabilities:
  - name: cafe_capabilities/Camera
    interface: {topics: {provides: {camera/image_raw: /eye}, requires: []}, parameters: {}}
  - name: cafe_capabilities/FrontCamera
''')
TREES = {kind: [yaml.safe_load(text) for text in texts] for kind, texts in GOOD.items()}
SCALARS = ['display', 'description', 'icon', 'launch', 'compatibility', 'parent_name', 'name',
           'type', 'public_interface', 'public_parameters', 'required_capabilities', 'interface',
           'topics', 'services', 'provides', 'requires', 'publishers', 'subscribers',
           'interactions', 'pairings', 'group', 'rapp', 'remappings', 'remap_from', 'remap_to',
           'namespace', 'dance', 'parent', 'damaged/dance', 'damaged/parent', 'a/b/c', '/',
           'dance.launch', 'dance.interface', '.', '../../../etc/passwd', '/etc/passwd',
           'a' * 5000, '\0', '\U0001f916', '', ' ', 'rocon:/pr2', 'rocon:/nobody',
           'rocon://pr2/bob', 'rocon:/*/(a|aa)+b', 'cafe_capabilities/Camera',
           'cafe_capabilities/FrontCamera', 'std_msgs/String', 'camera/image_raw', '/scan',
           '~rate', None, True, 0, 1.5, 10 ** 300, float('nan')]


def make(rng):
    """The text of each file by its name, two rapps among them."""
    return {'dance.rapp': make_text(rng, 'rapp'), 'parent.rapp': make_text(rng, 'rapp'),
            'dance.interface': make_text(rng, 'interface'),
            'cafe.interactions': make_text(rng, 'interactions')}


def make_text(rng, kind):
    number = rng.randrange(len(GOOD[kind]))
    return damaged_yaml(rng, GOOD[kind][number], TREES[kind][number], SCALARS)


def check(texts):
    with tempfile.TemporaryDirectory() as folder:
        exports = [('rocon_app', name) for name in texts if name.endswith('.rapp')]
        package = make_package(Path(folder), 'damaged', exports, dance_launch='<launch/>')
        for name, text in texts.items():
            (package / name).write_bytes(text.encode('utf-8', 'surrogatepass'))
        index = package_index_from_package_path(folder)
        findings = check_package_index(find_packages([folder]), LINT_OTHERS).findings
        check_findings(findings, folder)
        assert check_package_index(find_packages([folder]), LINT_OTHERS).findings == findings
        rapps, errors = rapps_from_package_index(index)
        assert len(rapps) + len(errors) == len(exports)
        found = {(Path(finding.file_name).name, finding.line, finding.column)
                 for finding in findings if finding.severity == ERROR}
        for error in errors:
            assert str(error).isprintable()
            assert (Path(error.file_name).name, error.line, error.column) in found
        for rapp in rapps.values():
            check_rapp(rapp)
    for name, text in texts.items():
        check_text(name, text)


def check_text(name, text):
    try:
        rapp = rapp_from_string(text, 'damaged/' + name, name)
    except InvalidRapp as error:
        assert str(error).isprintable() and error.line >= 1 and error.column >= 1
    else:
        assert isinstance(rapp.source, YamlMapping)
        assert repr(rapp) == repr(rapp_from_string(text.encode(), 'damaged/' + name, name))


def check_rapp(rapp):
    verdict = runnable(rapp, ROBOT, SPECS)
    assert bool(verdict) is not bool(verdict.reasons)
    assert all(str(reason).isprintable() for reason in verdict.reasons)
    assert str(verdict) == str(runnable(rapp, ROBOT, SPECS))
    try:
        fits = rapp.is_implementation and is_compatible(rapp.compatibility, ROBOT)
    except RoconURIValueError:
        fits = False
    assert fits or not verdict
