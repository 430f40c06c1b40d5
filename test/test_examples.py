"""The examples are of one café: what has one name is one thing in all of them."""
from __future__ import annotations

import re
from pathlib import Path
from typing import List

import pytest
from sources import ROOT

import rocon_uri

EXAMPLES = ROOT / 'examples'
PAGES = [ROOT / 'README.md', ROOT / 'doc' / 'index.rst', ROOT / 'doc' / 'command_line.rst']


def uris(name: str) -> List[rocon_uri.RoconURI]:
    lines = (EXAMPLES / name).read_text(encoding='utf-8').splitlines()
    return [rocon_uri.parse(line) for line in lines if line.startswith('rocon:')]


def without_app(uri: rocon_uri.RoconURI) -> str:
    return str(uri.replace(rocon_app=''))


def test_an_app_on_the_list_that_is_in_the_workspace_is_the_same_app() -> None:
    pytest.importorskip('yaml', reason='PyYAML is not installed')
    from rocon_uri.workspace import read_workspace
    workspace = {}
    for app in read_workspace([str(EXAMPLES / 'workspace')]).apps():
        try:
            if app.compatibility:
                workspace[app.name] = str(rocon_uri.parse(app.compatibility))
        except rocon_uri.RoconURIValueError:
            assert 'cafe_cart' in app.compatibility     # only its own package registers it
    listed = {uri.rocon_app: without_app(uri) for uri in uris('apps.txt')}
    assert len(workspace) == 5
    assert {name: listed.get(name) for name in workspace} == workspace
    assert {name for name in listed if name.startswith('cafe_')} == set(workspace)


def test_no_two_apps_have_one_name() -> None:
    names = [uri.rocon_app.rpartition('/')[2] for uri in uris('apps.txt')]
    names += ['round', 'carry', 'ring']     # in the workspace only
    assert len(names) == len(set(names))
    for folder in (EXAMPLES / 'workspace').iterdir():
        found = {path.stem for pattern in ('*.rapp', '*.app') for path in folder.rglob(pattern)}
        assert found <= set(names)


def test_a_robot_is_in_the_fleet_once() -> None:
    fleet = [str(uri) for uri in uris('fleet.txt')]
    names = [text.split('/')[1:3] for text in fleet]
    assert len(fleet) == 44 and all(names.count(name) == 1 for name in names)


@pytest.mark.skipif(not PAGES[1].is_file(), reason='the pages are not here')
@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_the_first_pages_show_robots_of_the_fleet_and_apps_as_the_list_has_them(page: Path) -> None:
    text = page.read_text(encoding='utf-8')
    apps = {uri.rocon_app: str(uri) for uri in uris('apps.txt')}
    robots = re.findall(r'rocon:/(?:fetch|kobuki|turtlebot2)/\w+/\w+/\w+', text)
    assert robots and set(robots) <= {str(uri) for uri in uris('fleet.txt')}
    for found in re.findall(r'rocon:/[^\s\']+#cafe_rapps/\w+', text):
        uri = rocon_uri.parse(found)
        assert str(uri) == apps[uri.rocon_app]
