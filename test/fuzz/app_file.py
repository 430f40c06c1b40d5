"""Apps of app_manager, the lists of them and their interface files: read, linted and judged."""
from __future__ import annotations

import tempfile
from pathlib import Path

import yaml
from fuzz.damage import damaged_yaml, files
from fuzz.findings import check_findings
from made_packages import make_package

from capabilities.spec_index import SpecIndex
from rocon_uri.apps.app_file import InvalidApp, app_from_string
from rocon_uri.apps.installed import app_files_from_package_index
from rocon_uri.apps.runnable import REASON_IDS, runnable
from rocon_uri.lint import ERROR, check_package_index
from rocon_uri.sources.packages import find_packages
from rocon_uri.sources.yaml_data import YamlMapping

ROBOT = 'rocon:/pr2/bob/noetic/focal'
GOOD = {
    'app': [path.read_text() for path in files('*.app')] + ['''\
platform: pr2
interface: damaged/dance.interface
launch: damaged/dance.launch
display: Dance
description: It dances
icon: damaged/dance.png
clients: [{type: android, manager: {api: 1}, app: {a: b}}]
plugins: [{name: video, type: p/Video, launch_args: {a: b}}]
plugin_order: [video]
timeout: 10.5
allow_parallel: true
'''],
    'installed': ['apps:\n- app: damaged/dance\n  display: Dance\n- app: damaged/other\n'],
    'interface': ['published_topics: {scan: sensor_msgs/LaserScan}\nsubscribed_topics: {}\n'],
}
TREES = {kind: [yaml.safe_load(text) for text in texts] for kind, texts in GOOD.items()}
SCALARS = ['apps', 'app', 'display', 'description', 'platform', 'interface', 'launch', 'run',
           'icon', 'clients', 'type', 'manager', 'plugins', 'plugin_order', 'timeout',
           'allow_parallel', 'run_args', 'published_topics', 'subscribed_topics', 'damaged/dance',
           'damaged/other', 'damaged/dance.launch', 'damaged/dance.py', 'damaged/', '/dance',
           'a/b/c', 'gone/dance',
           '../../../etc/passwd', 'all', 'pr2', 'robot', 'pr2|kobuki', '*', 'fetch15', 'a' * 5000,
           '\0', '\U0001f916', '', ' ', None, True, 0, 1.5, 10 ** 300, float('nan')]


def make(rng):
    """The text of each file by its name."""
    return {'dance.app': make_text(rng, 'app'), 'other.app': make_text(rng, 'app'),
            'ours.installed': make_text(rng, 'installed'),
            'dance.interface': make_text(rng, 'interface')}


def make_text(rng, kind):
    number = rng.randrange(len(GOOD[kind]))
    return damaged_yaml(rng, GOOD[kind][number], TREES[kind][number], SCALARS)


def check(texts):
    with tempfile.TemporaryDirectory() as folder:
        package = make_package(Path(folder), 'damaged', dance_launch='<launch/>', dance_py='')
        manifest = package / 'package.xml'
        manifest.write_text(manifest.read_text().replace(
            '<export>', '<export><app_manager app_dir="."/>'))
        for name, text in texts.items():
            (package / name).write_bytes(text.encode('utf-8', 'surrogatepass'))
        packages = find_packages([folder])
        findings = check_package_index(packages, {}).findings
        check_findings(findings, folder)
        assert check_package_index(packages, {}).findings == findings
        apps, faults = app_files_from_package_index(packages)
        found = {(Path(finding.file_name).name, finding.line, finding.column)
                 for finding in findings if finding.severity == ERROR}
        for fault in faults:
            assert str(fault).isprintable()
            assert (Path(fault.file_name).name, fault.line, fault.column) in found
        for app in apps.values():
            check_app(app)
    for name, text in texts.items():
        if name.endswith('.app'):
            check_text(name, text)


def check_text(name, text):
    try:
        app = app_from_string(text, 'damaged/' + name, name)
    except InvalidApp as error:
        assert str(error).isprintable() and error.line >= 1 and error.column >= 1
    else:
        assert isinstance(app.source, YamlMapping) and (app.launch is None) != (app.run is None)
        assert repr(app) == repr(app_from_string(text.encode(), 'damaged/' + name, name))


def check_app(app):
    for robot_type in None, 'fetch15':
        verdict = runnable(app, ROBOT, SpecIndex(), robot_type=robot_type)
        assert bool(verdict) is not bool(verdict.reasons)
        for reason in verdict.reasons:
            assert str(reason).isprintable() and reason.id in REASON_IDS
    assert not verdict or {'interface', 'launch'} <= set(app.files)
