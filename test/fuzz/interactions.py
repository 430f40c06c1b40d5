"""Interactions of a package, two files that may refer to each other: linted, in all their forms."""
from __future__ import annotations

import tempfile
from pathlib import Path

import yaml
from fuzz.damage import damaged_yaml, files
from fuzz.findings import check_findings
from made_packages import make_package

from rocon_uri.lint import ERROR, check_package_index
from rocon_uri.lint.explanations import EXPLANATIONS
from rocon_uri.sources.packages import find_packages
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load

GOOD = [path.read_text() for path in files('*.interactions')] + ['''\
interactions:
- {name: Menu, command: web, group: Staff, compatibility: 'rocon:/pc', max: -1, hidden: true,
   namespace: /kitchen, required_pairings: [Dance], remappings: [{remap_from: a, remap_to: b}]}
pairings:
- {name: Dance, rapp: damaged/dance, group: Staff, requires_interaction: Menu, parameters: {a: 1}}
''', '''\
- group: Staff
  interactions:
  - {name: web, role: Staff, compatibility: 'rocon:/*/bob_*', display_name: Menu, icon: a/b.png,
     pairing: {rapp: damaged/dance, remappings: []}}
- Guest:
  - {name: '', role: Guest, compatibility: 'rocon://pc/bob', pairing: {rapp: damaged/wave}}
''']
TREES = [yaml.safe_load(text) for text in GOOD]
SCALARS = ['interactions', 'interaction', 'pairings', 'group', 'name', 'command', 'role',
           'display_name', 'compatibility', 'namespace', 'remappings', 'remap_from', 'remap_to',
           'parameters', 'max', 'hidden', 'pairing', 'bringup_pairing', 'required_pairings', 'rapp',
           'requires_interaction', 'Staff', 'Menu', 'Dance', 'damaged/dance', 'damaged/wave',
           'damaged/danse', 'dance', 'a/b/c', '/', '/kitchen', '~private', 'rocon:/', 'rocon:/pc',
           'rocon:/nobody', 'rocon://pc/bob', 'rocon:/*/noetic', 'rocon:/*/(a|aa)+b', '\0',
           '\U0001f916', '', ' ', 'a' * 5000, None, True, 0, -1, -2, 1.5, 10 ** 300, float('nan')]


def make(rng):
    """The texts of the two files."""
    return [damaged_yaml(rng, GOOD[number], TREES[number], SCALARS)
            for number in (rng.randrange(len(GOOD)), rng.randrange(len(GOOD)))]


def check(texts):
    with tempfile.TemporaryDirectory() as folder:
        package = make_package(
            Path(folder), 'damaged', [('rocon_app', 'dance.rapp'), ('rocon_app', 'wave.rapp')],
            dance_rapp='{display: Dance, description: It dances}',
            wave_rapp='{display: Wave, description: It waves}')
        paths = [package / name for name in ('a.interactions', 'b.interactions')]
        for path, text in zip(paths, texts):
            path.write_bytes(text.encode('utf-8', 'surrogatepass'))
        found = findings(folder)
        check_findings(found, folder)
        assert findings(folder) == found
        assert {Path(finding.file_name) for finding in found} <= set(paths)
        assert all(finding.id in EXPLANATIONS for finding in found)
        for path, text in zip(paths, texts):
            wrong = any(finding.severity == ERROR and Path(finding.file_name) == path
                        for finding in found)
            assert wrong or has_entries(text)


def findings(folder):
    return check_package_index(find_packages([folder]), {}).findings


def has_entries(text):
    """Is there anything in it that could be an interaction or a pairing?"""
    try:
        return bool(load(text))
    except YamlError:
        return False
