"""What the packages depend on is known to rosdep, and to apt by the names that rosdep gives it."""
from __future__ import annotations

import re
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Dict, List, Optional, Set

import pytest
from built import PACKAGES
from sources import ROOT

yaml = pytest.importorskip('yaml', reason='PyYAML is not installed')

MANIFESTS = [ROOT / 'package.xml', ROOT / 'capabilities' / 'package.xml']
LIST = ROOT / 'test' / 'rosdep.yaml'
pytestmark = pytest.mark.skipif(not all(path.is_file() for path in MANIFESTS),
                                reason='not in the source of rocon_uri')


def known() -> Dict[str, Dict[str, List[str]]]:
    found: Dict[str, Dict[str, List[str]]] = yaml.safe_load(LIST.read_text(encoding='utf-8'))
    return found


def keys() -> Set[str]:
    """What the two packages depend on, but for each other."""
    roots = [ElementTree.parse(str(path)).getroot() for path in MANIFESTS]
    return ({str(tag.text) for root in roots for tag in root if tag.tag.endswith('depend')}
            - {root.findtext('name') for root in roots})


def this_system() -> Optional[str]:
    """The column of the list that is for this system, if there is one."""
    path = Path('/etc/os-release')
    release = path.read_text(encoding='utf-8') if path.is_file() else ''
    if re.search(r'^VERSION_CODENAME=bookworm$', release, re.MULTILINE):
        return 'debian'
    return 'ubuntu' if Path('/opt/ros/noetic').is_dir() else None


def test_every_key_is_in_the_list_and_the_list_has_no_other() -> None:
    assert keys() == set(known())


def test_a_key_is_in_the_list_once_and_in_order() -> None:
    listed = re.findall(r'^(\S+):', LIST.read_text(encoding='utf-8'), re.MULTILINE)
    assert listed == sorted(set(listed))


@pytest.mark.parametrize('system', ['debian', 'ubuntu'])
def test_a_key_is_packages_on_both_systems(system: str) -> None:
    for key, systems in known().items():
        assert set(systems) == {'debian', 'ubuntu'}
        assert systems[system] and len(systems[system]) == len(set(systems[system]))
        for package in systems[system]:
            assert re.match(r'[a-z0-9][a-z0-9.+-]+$', package)
            # what is ROS's own is an apt package of the distribution
            assert package.startswith('ros-noetic-') == (
                system == 'ubuntu' and not key.startswith('python3-')
                and key not in ('graphviz', 'postgresql'))


def test_the_old_package_of_the_same_name_is_replaced() -> None:
    root = ElementTree.parse(str(MANIFESTS[0])).getroot()
    assert root.findtext('conflict') == root.findtext('replace') == 'capabilities'


def test_a_package_inside_a_package_is_not_found() -> None:
    packages = pytest.importorskip('catkin_pkg.packages', reason='catkin_pkg is not installed')
    found = packages.find_package_paths(str(ROOT))
    assert found == ['.']


@pytest.mark.skipif('rocon_uri' not in PACKAGES or this_system() is None,
                    reason='not where what the tests need was installed by apt-get')
def test_apt_knows_the_packages() -> None:
    named = {package for systems in known().values()
             for package in systems[this_system() or '']}
    shown = subprocess.run(['apt-cache', 'show', *sorted(named)], stdout=subprocess.PIPE,
                           stderr=subprocess.DEVNULL, universal_newlines=True).stdout
    assert named - set(re.findall(r'^Package: (\S+)$', shown, re.MULTILINE)) == set()
