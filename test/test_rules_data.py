"""The bundled files: what has to be in the vocabulary, and that it is well formed."""
from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import pytest
from sources import SOURCE

import rocon_uri.vocabulary
from rocon_uri.sources.ros_names import is_legal_base_name

RULES = Path(rocon_uri.vocabulary.__file__).parent / 'rules'
FIELDS = ['hardware_platform', 'application_framework', 'operating_system']


def names(rules, above=()):
    """Each value and group of a list of rules, with the groups above it."""
    for item in rules:
        if isinstance(item, str):
            yield item, above
        else:
            (group, below), = item.items()
            yield group, above
            yield from names(below, above + (group,))


def registered(field):
    return list(names(json.loads((RULES / (field + '.json')).read_text())))


@pytest.mark.parametrize('field', FIELDS)
def test_a_name_occurs_once_in_a_field_and_is_a_base_name_in_lower_case(field):
    found = [name for name, _ in registered(field)]
    assert [name for name, count in Counter(found).items() if count > 1] == []
    assert [name for name in found if not is_legal_base_name(name) or name != name.lower()] == []


@pytest.mark.parametrize('field, group, values', [
    ('hardware_platform', (), 'pc concert robot mobile_device'),
    ('hardware_platform', ('robot',),
     'fgopher gocart gocart_v1 gocart_v2 gocart_v2_1 gocart_v2_2 gocart_v2_3 gocart_v2_4 '
     'gocart_mini gocart_mini_v2_1 gocart_mini_v2_3 gocart_mini_v2_4 gopher kobuki korus pr2 '
     'robosem segbot turtlebot turtlebot2 waiterbot furo aldebaran_nao robotis_op1 roch srb '
     'robot_other'),
    ('hardware_platform', ('robot',),
     'turtlebot3 turtlebot4 husky jackal ridgeback fetch tiago hsr pepper spot stretch ur3 ur5 '
     'ur10 ur3e ur5e ur10e panda summit_xl'),
    ('hardware_platform', ('mobile_device',), 'phone tablet'),
    ('hardware_platform', ('mobile_device', 'phone'), 'galaxy mega note3 phone_other'),
    ('hardware_platform', ('mobile_device', 'tablet'), 'xoom note10 tablet_other'),
    ('application_framework', (), 'ros ros2 opros application_framework_other'),
    ('application_framework', ('ros',),
     'boxturtle cturtle diamondback electric fuerte groovy hydro indigo jade kinetic lunar '
     'melodic noetic one ros_other'),
    ('application_framework', ('ros2',),
     'ardent bouncy crystal dashing eloquent foxy galactic humble iron jazzy kilted rolling'),
    ('operating_system', (), 'windows linux osx macos freebsd android web'),
    ('operating_system', ('windows',), 'winxp windows7 windows8 windows10 windows11'),
    ('operating_system', ('linux',), 'arch gentoo fedora opensuse mint debian ubuntu'),
    ('operating_system', ('android',),
     'honeycomb ice_cream_sandwich jellybean kitkat lollipop marshmallow nougat oreo pie '
     'android10'),
    ('operating_system', ('web',), 'chrome firefox safari opera internet_explorer edge'),
])
def test_these_are_registered_in_this_group(field, group, values):
    found = {name for name, above in registered(field) if above == group}
    assert set(values.split()) - found == set()


def test_debian_releases_are_what_os_detect_calls_them():
    os_detect = pytest.importorskip('rospkg.os_detect')
    detector = os_detect.Debian()
    codenames = set()
    for version in [*map(str, range(7, 14)), 'unstable']:
        detector.lsb_info = ('debian', version, '')
        codenames.add(detector.get_codename())
    found = {name for name, above in registered('operating_system') if above[-1:] == ('debian',)}
    assert codenames - {''} - found == set()
    if codenames == {''}:
        pytest.skip('an older rospkg, which asks the system itself')
    assert {'bookworm', 'sid'} <= codenames


# os_detect takes the others' codenames from distro, and distro from /etc/os-release.
@pytest.mark.parametrize('group, os_release', [
    ('ubuntu', 'NAME="Ubuntu"\nVERSION="20.04.6 LTS (Focal Fossa)"\nID=ubuntu\n'
               'ID_LIKE=debian\nVERSION_CODENAME=focal\nUBUNTU_CODENAME=focal\n'),
    ('ubuntu', 'NAME="Ubuntu"\nVERSION="14.04.6 LTS, Trusty Tahr"\nID=ubuntu\n'),
    ('ubuntu', 'NAME="Ubuntu"\nVERSION="16.04.7 LTS (Xenial Xerus)"\nID=ubuntu\n'
               'VERSION_CODENAME=xenial\n'),
    ('mint', 'NAME="Linux Mint"\nVERSION="20.3 (Una)"\nID=linuxmint\nID_LIKE=ubuntu\n'
             'VERSION_CODENAME=una\nUBUNTU_CODENAME=focal\n'),
])
def test_other_releases_are_what_os_detect_calls_them(group, os_release, tmp_path):
    distro = pytest.importorskip('distro')
    path = tmp_path / 'os-release'
    path.write_text(os_release)
    codename = distro.LinuxDistribution(include_lsb=False, os_release_file=str(path)).codename()
    assert ('linux', group) in [above for name, above in registered('operating_system')
                                if name == codename.split()[0].lower()]


def test_its_types_are_installed_too():
    for package in ('rocon_uri', 'capabilities'):
        assert (SOURCE / package / 'py.typed').exists()
