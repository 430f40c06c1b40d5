"""Packages on a package path, the specs that they export, and the index of those."""
from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Sequence, Tuple

import pytest
from catkin_pkg.package import Export, Package
from catkin_pkg.packages import find_packages
from hypothesis import given, settings
from hypothesis import strategies as st

from capabilities import discovery
from capabilities.discovery import (
    DuplicateNameException, InterfaceNameNotFoundException, PackageError, SpecIndex,
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from capabilities.specs.common import InvalidSpec
from capabilities.specs.interface import CapabilityInterface, InvalidInterface
from capabilities.specs.provider import CapabilityProvider, InvalidProvider
from capabilities.specs.semantic_interface import (
    InvalidSemanticInterface, SemanticCapabilityInterface)
from rocon_uri.lint import check_packages
from rocon_uri.sources.packages import find_packages as packages_of_ours
from rocon_uri.workspace import read_workspace

WORKSPACE = str(Path(__file__).parent / 'workspace')
CORPUS = os.environ.get('ROCON_URI_CORPUS', '')

INTERFACE, SEMANTIC, PROVIDER = (
    'capability_interface', 'semantic_capability_interface', 'capability_provider')
SPEC = {
    INTERFACE: 'name: %s\nspec_version: 1\nspec_type: interface\n',
    SEMANTIC: 'name: %s\nspec_version: 1\nspec_type: semantic_interface\nredefines: %s\n',
    PROVIDER: 'name: %s\nspec_version: 1\nspec_type: provider\nimplements: %s\n',
}

MANIFEST = '''<?xml version="1.0"?>
<package format="2">
  <name>%s</name>
  <version>1.0.0</version>
  <description>A package of a test</description>
  <maintainer email="nobody@example.org">Nobody</maintainer>
  <license>BSD</license>
  <export>%s</export>
</package>
'''


def add_package(folder: Path, name: str, exports: Sequence[Tuple[str, str]] = ()) -> Path:
    folder.mkdir(parents=True)
    tags = ''.join('<%s>%s</%s>' % (tag, path, tag) for tag, path in exports)
    (folder / 'package.xml').write_text(MANIFEST % (name, tags), encoding='utf-8')
    return folder


def add_specs(folder: Path, name: str, *specs: Tuple[str, str, str]) -> Path:
    """A package that exports specs, given as kind, file name and content."""
    add_package(folder, name, [(tag, file_name) for tag, file_name, _ in specs])
    for _, file_name, content in specs:
        (folder / file_name).write_text(content, encoding='utf-8')
    return folder


def interface(name: str = 'Camera') -> Tuple[str, str, str]:
    return INTERFACE, name + '.yaml', SPEC[INTERFACE] % name


def semantic_interface(name: str, redefines: str) -> Tuple[str, str, str]:
    return SEMANTIC, name + '.yaml', SPEC[SEMANTIC] % (name, redefines)


def provider(name: str, implements: str) -> Tuple[str, str, str]:
    return PROVIDER, name + '.yaml', SPEC[PROVIDER] % (name, implements)


def index_of(*paths: Path) -> Tuple[SpecIndex, List[Exception]]:
    errors: List[Any] = []
    packages = package_index_from_package_path([str(path) for path in paths], errors)
    assert errors == []
    return spec_index_from_spec_file_index(spec_file_index_from_package_index(packages))


class TestPackageIndex:

    def test_packages_are_catkin_packages_by_name(self, tmp_path: Path) -> None:
        add_package(tmp_path / 'stack' / 'folder', 'a_package')
        packages = package_index_from_package_path([str(tmp_path)])
        assert list(packages) == ['a_package']
        assert isinstance(packages['a_package'], Package)
        assert packages['a_package'].filename == str(tmp_path / 'stack' / 'folder' / 'package.xml')

    def test_a_relative_path_gives_absolute_file_names(self, tmp_path: Path,
                                                       monkeypatch: Any) -> None:
        add_package(tmp_path / 'src' / 'a_package', 'a_package')
        monkeypatch.chdir(tmp_path)
        packages = package_index_from_package_path(['src'])
        assert packages['a_package'].filename == str(tmp_path / 'src' / 'a_package' / 'package.xml')

    @pytest.mark.parametrize('root', [WORKSPACE] + ([CORPUS] if CORPUS else []))
    def test_finds_what_catkin_finds(self, root: str) -> None:
        expected = {package.name for package in find_packages(root).values()}
        assert set(package_index_from_package_path([root])) == expected

    def test_a_str_is_one_path(self) -> None:
        assert 'home_capabilities' in package_index_from_package_path(WORKSPACE)

    def test_a_package_on_an_earlier_path_wins(self, tmp_path: Path) -> None:
        paths = [tmp_path / 'overlay', tmp_path / 'underlay']
        for path in paths:
            add_package(path / 'a_package', 'a_package')
        add_package(paths[1] / 'b_package', 'b_package')
        errors: List[Any] = []
        packages = package_index_from_package_path(map(str, paths), errors)
        assert {name: package.filename for name, package in packages.items()} == {
            'a_package': str(paths[0] / 'a_package' / 'package.xml'),
            'b_package': str(paths[1] / 'b_package' / 'package.xml')}
        assert errors == []

    def test_a_package_twice_on_one_path_is_reported_and_the_first_counts(
            self, tmp_path: Path, caplog: Any) -> None:
        first = add_package(tmp_path / ('a' * 200), 'a_package')     # and its path is shown whole
        second = add_package(tmp_path / 'b', 'a_package')
        add_package(tmp_path / 'c', 'c_package')
        errors: List[Any] = []
        packages = package_index_from_package_path([str(tmp_path)], errors)
        assert list(packages) == ['a_package', 'c_package']
        assert packages['a_package'].filename == str(first / 'package.xml')
        assert [str(error) for error in errors] == [
            "%s: duplicate package 'a_package', the first is in '%s'"
            % (second / 'package.xml', first / 'package.xml')]
        assert str(errors[0]) in caplog.text

    @pytest.mark.parametrize('marker', ['AMENT_IGNORE', 'CATKIN_IGNORE', 'COLCON_IGNORE'])
    def test_an_ignored_folder_is_not_looked_into(self, tmp_path: Path, marker: str) -> None:
        add_package(tmp_path / 'build' / 'a_package', 'a_package')
        (tmp_path / 'build' / marker).touch()
        assert package_index_from_package_path([str(tmp_path)]) == {}

    def test_nothing_in_hidden_folders_or_other_packages(self, tmp_path: Path) -> None:
        add_package(tmp_path / 'a_package', 'a_package')
        add_package(tmp_path / 'a_package' / 'test' / 'b_package', 'b_package')
        add_package(tmp_path / '.hidden' / 'c_package', 'c_package')
        assert list(package_index_from_package_path([str(tmp_path)])) == ['a_package']

    @pytest.mark.parametrize('path', ['', 'no/such/folder', '/dev/null'])
    def test_a_path_without_packages(self, path: str) -> None:
        errors: List[Any] = []
        assert package_index_from_package_path([path], errors) == {}
        assert errors == []

    def test_links_in_circles_and_to_packages_are_followed_once(self, tmp_path: Path) -> None:
        folder = add_package(tmp_path / 'outside' / 'a_package', 'a_package')
        root = tmp_path / 'root'
        (root / 'x').mkdir(parents=True)
        for number in range(10):    # with each visited again, 40 levels of 10 links
            (root / 'x' / str(number)).symlink_to(root)
        (root / 'package_a').symlink_to(folder)
        (root / 'package_b').symlink_to(folder)
        errors: List[Any] = []
        packages = package_index_from_package_path([str(root)], errors)
        assert packages['a_package'].filename == str(root / 'package_a' / 'package.xml')
        assert errors == []

    @pytest.mark.parametrize('content, line, column, problem', [
        ('', 1, 1, 'no element found'),
        ('<package>\n  <name>a</nam>\n</package>', 2, 12, 'mismatched tag'),
        ('<robot/>', 1, 1, 'single "package" root tag'),
        ('<package/>', 1, 1, 'exactly one "name" tag'),
        ('\n  <package format="4"/>', 2, 3, 'format version'),
        ('<package format="two"/>', 1, 1, 'two'),
        (MANIFEST % ('a_package', '') + '<again/>', 10, 1, 'junk after document element'),
        (MANIFEST % ('', ''), 3, 3, 'name'),
        (MANIFEST % ('a_package', '<a>' * 5000 + '</a>' * 5000), None, None, 'recursion'),
        (MANIFEST % ('a_package', ' ' * 2 ** 20), None, None, 'larger than 1 MiB'),
        (b'<package>\xff</package>', 1, 10, 'not UTF-8'),
        ('<!DOCTYPE a [<!ENTITY a "a">]>' + MANIFEST % ('a_package', '&a;'), None, None,
         'declares entities'),
    ], ids=['empty', 'not XML', 'other root', 'nothing in it', 'format 4', 'format two',
            'two roots', 'no name', 'deep', 'large', 'not UTF-8', 'entities'])
    def test_an_invalid_manifest_is_reported_and_costs_only_its_package(
            self, tmp_path: Path, caplog: Any, content: Any, line: Any, column: Any,
            problem: str) -> None:
        add_package(tmp_path / 'good', 'good_package')
        manifest = add_package(tmp_path / 'bad', 'bad_package') / 'package.xml'
        manifest.write_bytes(content if isinstance(content, bytes) else content.encode('utf-8'))
        errors: List[Any] = []
        assert list(package_index_from_package_path([str(tmp_path)], errors)) == ['good_package']
        [error] = errors
        assert isinstance(error, PackageError)
        assert (error.file_name, error.line, error.column) == (str(manifest), line, column)
        assert problem in error.problem
        assert '\n' not in str(error)
        assert str(error) in caplog.text

    def test_a_manifest_that_is_no_file(self, tmp_path: Path) -> None:
        for name in ('fifo', 'loop', 'dangling', 'folder'):
            (tmp_path / name).mkdir()
        os.mkfifo(str(tmp_path / 'fifo' / 'package.xml'))
        (tmp_path / 'loop' / 'package.xml').symlink_to('package.xml')
        (tmp_path / 'dangling' / 'package.xml').symlink_to('no_such_file')
        add_package(tmp_path / 'folder' / 'package.xml' / 'a_package', 'a_package')
        errors: List[Any] = []
        packages = package_index_from_package_path([str(tmp_path)], errors)
        assert list(packages) == ['a_package']
        assert [error.file_name for error in errors] == [
            str(tmp_path / name / 'package.xml') for name in ('dangling', 'fifo', 'loop')]

    def test_errors_need_not_be_asked_for(self, tmp_path: Path) -> None:
        (add_package(tmp_path / 'bad', 'bad_package') / 'package.xml').write_text('')
        assert package_index_from_package_path([str(tmp_path)]) == {}

    def test_nothing_is_printed(self, tmp_path: Path, capfd: Any) -> None:
        add_package(tmp_path / 'a', 'Odd-Name')     # of which catkin_pkg warns
        assert list(package_index_from_package_path([str(tmp_path)])) == ['Odd-Name']
        assert capfd.readouterr() == ('', '')


def test_the_errors_of_specs_have_a_second_place() -> None:
    for error in InvalidInterface, InvalidSemanticInterface, InvalidProvider:
        assert getattr(discovery, error.__name__) is error


def test_the_linter_and_discovery_read_an_export_alike(tmp_path: Path) -> None:
    folder = add_package(tmp_path / 'ours', 'ours', [
        (INTERFACE, 'a&amp;b.yaml'), (INTERFACE, 'c.yaml<!-- the main one -->'),
        (INTERFACE, '<![CDATA[d<e>.yaml]]>'), (INTERFACE, '&#x66;.yaml')])
    for number, name in enumerate(['a&b.yaml', 'c.yaml', 'd<e>.yaml', 'f.yaml']):
        (folder / name).write_text(SPEC[INTERFACE] % ('A%d' % number))
    index, errors = index_of(tmp_path)
    assert (index.names, errors) == (['ours/A0', 'ours/A1', 'ours/A2', 'ours/A3'], [])
    assert read_workspace([str(tmp_path)]).spec_index.names == index.names
    assert check_packages([str(tmp_path)]) == []
    (folder / 'a&b.yaml').unlink()
    [error] = index_of(tmp_path)[1]
    assert isinstance(error, OSError) and error.filename == str(folder / 'a&b.yaml')
    [finding] = check_packages([str(tmp_path)])
    assert finding.problem == "exported file 'a&b.yaml' does not exist"


@pytest.mark.skipif(not os.path.exists('/proc/self/mem'), reason='there is no /proc')
def test_a_read_that_fails_says_the_name_of_the_file(tmp_path: Path) -> None:
    folder = add_package(tmp_path / 'ours', 'ours', [
        (INTERFACE, 'A.yaml'), (INTERFACE, 'B.yaml'), ('rocon_app', 'a.rapp')])
    (folder / 'B.yaml').write_text(SPEC[INTERFACE] % 'B')
    for name in 'A.yaml', 'a.rapp':
        (folder / name).symlink_to('/proc/self/mem')     # as a bad disk, it fails when it is read
    index, [error] = index_of(tmp_path)
    assert index.names == ['ours/B']
    assert isinstance(error, OSError) and error.filename == str(folder / 'A.yaml')
    assert [str(finding) for finding in check_packages([str(tmp_path)])] == [
        '%s: error: cannot be read: Input/output error [cannot-read]' % (folder / name)
        for name in ('A.yaml', 'a.rapp')]


def test_near_misses_of_many_specs_are_looked_for_as_long_as_it_does_not_take_long() -> None:
    index = SpecIndex()
    for number in range(600):
        index.add_interface(CapabilityInterface('Camera%d' % number, 1), 'f', 'ours')
        index.add_interface(CapabilityInterface('Base', 1), 'f', 'theirs_%d' % number)
    suggestions = []
    for number in range(50):
        with pytest.raises(InterfaceNameNotFoundException) as caught:
            index.add_provider(CapabilityProvider('a', 1, 'ours/Camra%d' % number), 'f', 'a')
        suggestions.append(caught.value.suggestions)
    assert [bool(names) for names in suggestions] == [True] * 33 + [False] * 17    # 20,000 names
    assert 'ours/Camera32' in suggestions[32]


def test_of_many_names_those_that_share_a_part_are_looked_at() -> None:
    index = SpecIndex()
    for number in range(300):
        index.add_interface(CapabilityInterface('Base', 1), 'f', 'ours_%d' % number)
        index.add_interface(CapabilityInterface('Laser', 1), 'f', 'ours_%d' % number)
    index.add_semantic_interface(SemanticCapabilityInterface('Front', 'ours_7/Laser', 1), 'f', 'my')
    assert sorted(index.names_like('ours_7/Lasr', 'interfaces')) == ['ours_7/Base', 'ours_7/Laser']
    assert len(index.names_like('our_7/Laser', 'interfaces')) == 300
    assert len(index.names_like('Laser', 'interfaces')) == 300
    assert index.names_like('my/Fronnt', 'capabilities') == ['my/Front']
    assert index.names_like('my/Fronnt', 'interfaces') == []
    assert index.names_like('my/front', 'providers') == []
    index.add_provider(CapabilityProvider('front', 1, 'my/Front'), 'f', 'my')
    assert index.names_like('my/fronnt', 'providers') == ['my/front']
    index.add_interface(CapabilityInterface('Laser', 1), 'f', 'my')
    assert index.names_like('my/Lasr', 'interfaces') == ['my/Laser']
    index.remove_interface('my/Laser')
    index.remove_semantic_interface('my/Front')
    index.remove_provider('my/front')
    for kind in 'interfaces', 'capabilities', 'providers':
        assert index.names_like('my/Front', kind) == []


def test_one_spec_is_found_without_all_others() -> None:
    index = SpecIndex()
    interface = CapabilityInterface('Camera', 1)
    front = SemanticCapabilityInterface('Front', 'ours/Camera', 1)
    provider = CapabilityProvider('front', 1, 'ours/Front')
    index.add_interface(interface, 'a.yaml', 'ours')
    index.add_semantic_interface(front, 'b.yaml', 'ours')
    index.add_provider(provider, 'c.yaml', 'ours')
    assert index.capability('ours/Camera') is interface
    assert index.capability('ours/Front') is front
    assert index.capability('ours/front') is index.provider('ours/Front') is None
    assert index.provider('ours/front') is provider
    assert index.provider_path('ours/front') == 'c.yaml'
    with pytest.raises(KeyError):
        index.provider_path('ours/Front')
    assert index.redefinitions_of('ours/Camera') == ['ours/Front']
    index.remove_semantic_interface('ours/Front')
    assert index.redefinitions_of('ours/Camera') == index.redefinitions_of('x/Y') == []


class TestSpecFileIndex:

    def test_paths_by_package_and_export_in_order(self, tmp_path: Path) -> None:
        exports = [(PROVIDER, 'providers/z.yaml'), (INTERFACE, '\n  interfaces/B.yaml\n  '),
                   (INTERFACE, 'interfaces/A.yaml'), ('rosdoc', 'rosdoc.yaml')]
        folder = add_package(tmp_path / 'a_package', 'a_package', exports)
        packages = package_index_from_package_path([str(tmp_path)])
        assert spec_file_index_from_package_index(packages) == {'a_package': {
            'package': packages['a_package'],
            INTERFACE: [str(folder / 'interfaces/B.yaml'), str(folder / 'interfaces/A.yaml')],
            SEMANTIC: [],
            PROVIDER: [str(folder / 'providers/z.yaml')]}}

    def test_packages_made_by_hand(self) -> None:
        package = Package('src/a_package/package.xml')
        package.exports = [Export(INTERFACE, '\v A.yaml '), Export(INTERFACE)]
        folder = os.path.abspath(os.path.join('src', 'a_package'))
        assert spec_file_index_from_package_index({'a_package': package}) == {'a_package': {
            'package': package,
            INTERFACE: [os.path.join(folder, 'A.yaml'), os.path.join(folder, '')],
            SEMANTIC: [], PROVIDER: []}}

    def test_the_package_is_that_which_was_given(self) -> None:
        for packages in (package_index_from_package_path([WORKSPACE]),
                         packages_of_ours([WORKSPACE])):
            files = spec_file_index_from_package_index(packages)
            assert files['home_navigation']['package'] is packages['home_navigation']

    def test_packages_without_specs_are_left_out(self) -> None:
        packages = package_index_from_package_path([WORKSPACE])
        assert 'dustbot_bringup' in packages
        assert list(spec_file_index_from_package_index(packages)) == [
            'dustbot_capabilities', 'home_capabilities', 'home_navigation', 'home_simulation']

    def test_a_path_out_of_the_package_is_followed(self, tmp_path: Path) -> None:
        _, file_name, content = interface('Camera')
        add_package(tmp_path / 'a_package', 'a_package',
                    [(INTERFACE, '../Camera.yaml'), (INTERFACE, str(tmp_path / 'Laser.yaml'))])
        (tmp_path / file_name).write_text(content)
        (tmp_path / 'Laser.yaml').write_text(SPEC[INTERFACE] % 'Laser')
        index, errors = index_of(tmp_path)
        assert index.names == ['a_package/Camera', 'a_package/Laser']
        assert errors == []


def test_the_specs_of_a_workspace() -> None:
    index, errors = index_of(Path(WORKSPACE))
    assert errors == []
    assert index.interface_names == [
        'dustbot_capabilities/DustbotBringup', 'dustbot_capabilities/Vacuum',
        'home_capabilities/MobileBase', 'home_capabilities/RangeSensor',
        'home_capabilities/Camera', 'home_capabilities/Navigation']
    assert index.semantic_interface_names == ['dustbot_capabilities/FrontCamera']
    assert index.provider_names == [
        'dustbot_capabilities/dustbot_bringup', 'dustbot_capabilities/dustbot_base',
        'dustbot_capabilities/dustbot_laser', 'dustbot_capabilities/dustbot_front_camera',
        'dustbot_capabilities/dustbot_vacuum', 'home_navigation/grid_navigation',
        'home_simulation/simulated_base']
    assert index.provider_paths['home_navigation/grid_navigation'] == os.path.join(
        WORKSPACE, 'src', 'home_navigation', 'providers', 'grid_navigation.yaml')


@pytest.mark.skipif(not CORPUS, reason='ROCON_URI_CORPUS is not set')
def test_the_specs_of_the_corpus() -> None:
    package_errors: List[Any] = []
    packages = package_index_from_package_path([CORPUS], package_errors)
    index, errors = spec_index_from_spec_file_index(spec_file_index_from_package_index(packages))
    assert (len(packages), len(index.interfaces), len(index.semantic_interfaces),
            len(index.providers)) == (6, 13, 2, 15)
    assert package_errors == errors == []


class TestSpecsThatAreLeftOut:

    def errors_beside_a_good_spec(self, tmp_path: Path, *specs: Tuple[str, str, str]
                                  ) -> List[Exception]:
        add_specs(tmp_path / 'bad', 'bad_package', *specs)
        add_specs(tmp_path / 'good', 'good_package', interface('Laser'),
                  provider('laser', 'good_package/Laser'))
        index, errors = index_of(tmp_path)
        assert {'good_package/Laser', 'good_package/laser'} <= set(index.names)
        self.index = index
        return errors

    @pytest.mark.parametrize('tag', [INTERFACE, SEMANTIC, PROVIDER])
    def test_a_file_that_cannot_be_read(self, tmp_path: Path, tag: str) -> None:
        names = ['missing.yaml', '', 'fifo.yaml', 'loop.yaml', 'package.xml/inside.yaml']
        folder = add_package(tmp_path / 'bad', 'bad_package', [(tag, name) for name in names])
        os.mkfifo(str(folder / 'fifo.yaml'))
        (folder / 'loop.yaml').symlink_to('loop.yaml')
        add_specs(tmp_path / 'good', 'good_package', interface())
        index, errors = index_of(tmp_path)
        assert index.names == ['good_package/Camera']
        assert all(isinstance(error, OSError) for error in errors)
        assert [getattr(error, 'filename', None) for error in errors] == [
            os.path.join(str(folder), name) for name in names]

    @pytest.mark.skipif(os.geteuid() == 0, reason='root can read everything')
    def test_a_file_without_permission(self, tmp_path: Path) -> None:
        folder = add_specs(tmp_path / 'bad', 'bad_package', interface())
        (folder / 'Camera.yaml').chmod(0)
        index, [error] = index_of(tmp_path)
        assert isinstance(error, PermissionError)

    def test_an_invalid_spec(self, tmp_path: Path) -> None:
        [error] = self.errors_beside_a_good_spec(
            tmp_path, (INTERFACE, 'Camera.yaml', 'name: Camera\nspec_version: 1\n'))
        assert isinstance(error, InvalidInterface)
        assert error.file_name == str(tmp_path / 'bad' / 'Camera.yaml')

    def test_a_spec_with_the_name_of_another_package(self, tmp_path: Path) -> None:
        [error] = self.errors_beside_a_good_spec(
            tmp_path, (INTERFACE, 'Camera.yaml', SPEC[INTERFACE] % 'a_package/Camera'))
        assert isinstance(error, InvalidSpec)
        assert str(error) == (
            "%s:1:7: name 'a_package/Camera' is not of package 'bad_package', which exports it"
            % (tmp_path / 'bad' / 'Camera.yaml'))

    def test_a_spec_exported_as_one_of_another_kind(self, tmp_path: Path) -> None:
        [error] = self.errors_beside_a_good_spec(
            tmp_path, (PROVIDER, 'Camera.yaml', SPEC[INTERFACE] % 'Camera'))
        assert isinstance(error, InvalidProvider)

    def test_what_stands_on_an_invalid_interface(self, tmp_path: Path) -> None:
        errors = self.errors_beside_a_good_spec(
            tmp_path, (INTERFACE, 'Camera.yaml', '[}'),
            semantic_interface('Front', 'bad_package/Camera'),
            provider('front_camera', 'bad_package/Front'))
        assert [type(error) for error in errors] == [
            InvalidInterface, InterfaceNameNotFoundException, InterfaceNameNotFoundException]

    @pytest.mark.parametrize('spec, text', [
        (provider('camera', 'good_package/Lazer'),
         "4:13: provider 'bad_package/camera' implements 'good_package/Lazer', which is "
         "not an interface that any package exports (did you mean 'good_package/Laser'?)"),
        (semantic_interface('Front', 'good_package/Nothing_like_it'),
         "4:12: semantic interface 'bad_package/Front' redefines 'good_package/Nothing_like_it', "
         'which is not an interface that any package exports'),
    ])
    def test_an_interface_that_is_missing(self, tmp_path: Path, spec: Tuple[str, str, str],
                                          text: str) -> None:
        [error] = self.errors_beside_a_good_spec(tmp_path, spec)
        assert isinstance(error, InterfaceNameNotFoundException)
        path = str(tmp_path / 'bad' / spec[1])
        assert (error.package, error.spec_type, error.file_name) == (
            'bad_package', 'provider' if spec[0] == PROVIDER else 'semantic_interface', path)
        assert str(error) == path + ':' + text

    def test_a_semantic_interface_cannot_be_redefined(self, tmp_path: Path) -> None:
        [error] = self.errors_beside_a_good_spec(
            tmp_path, semantic_interface('Front', 'good_package/Laser'),
            semantic_interface('FrontLeft', 'bad_package/Front'))
        assert isinstance(error, InterfaceNameNotFoundException)
        assert (error.spec_name, error.interface) == ('bad_package/FrontLeft', 'bad_package/Front')

    @pytest.mark.parametrize('second, spec_type', [
        ((INTERFACE, 'again.yaml', SPEC[INTERFACE] % 'Camera'), 'interface'),
        ((SEMANTIC, 'again.yaml', SPEC[SEMANTIC] % ('Camera', 'good_package/Laser')),
         'semantic_interface'),
        ((PROVIDER, 'again.yaml', SPEC[PROVIDER] % ('Camera', 'good_package/Laser')), 'provider'),
    ])
    def test_a_name_that_is_taken(self, tmp_path: Path, second: Tuple[str, str, str],
                                  spec_type: str) -> None:
        [error] = self.errors_beside_a_good_spec(tmp_path, interface('Camera'), second)
        assert isinstance(error, DuplicateNameException)
        assert (error.spec_name, error.package, error.spec_type) == (
            'bad_package/Camera', 'bad_package', spec_type)
        assert str(error) == (
            "%s:1:7: 'bad_package/Camera' is already the name of an interface, in '%s'"
            % (tmp_path / 'bad' / 'again.yaml', tmp_path / 'bad' / 'Camera.yaml'))
        assert self.index.interface_paths['bad_package/Camera'].endswith('Camera.yaml')

    def test_the_same_name_in_two_packages_is_no_fault(self, tmp_path: Path) -> None:
        assert self.errors_beside_a_good_spec(tmp_path, interface('Laser')) == []

    @settings(max_examples=60, deadline=None)
    @given(st.lists(st.tuples(st.sampled_from([INTERFACE, SEMANTIC, PROVIDER]), st.one_of(
        st.sampled_from([SPEC[INTERFACE] % 'A', SPEC[SEMANTIC] % ('B', 'a_package/A'),
                         SPEC[PROVIDER] % ('c', 'a_package/A'),
                         SPEC[PROVIDER] % ('d', 'a_package/B')]),
        st.text(st.characters(blacklist_categories=['Cs']))))))
    def test_every_file_is_indexed_or_reported(self, specs: List[Tuple[str, str]]) -> None:
        with tempfile.TemporaryDirectory() as folder:
            files: Dict[str, List[str]] = {INTERFACE: [], SEMANTIC: [], PROVIDER: []}
            for number, (tag, content) in enumerate(specs):
                path = os.path.join(folder, '%d.yaml' % number)
                Path(path).write_text(content, encoding='utf-8')
                files[tag].append(path)
            index, errors = spec_index_from_spec_file_index({'a_package': files})
        assert len(index.names) + len(errors) == len(specs)
        refused = (InvalidSpec, DuplicateNameException, InterfaceNameNotFoundException)
        assert all(isinstance(error, refused) for error in errors)


class TestSpecIndex:

    @pytest.fixture
    def index(self) -> SpecIndex:
        index = SpecIndex()
        index.add_interface(CapabilityInterface('Camera', 1), Path('Camera.yaml'), 'a')
        index.add_semantic_interface(
            SemanticCapabilityInterface('Front', 'a/Camera', 1), Path('Front.yaml'), 'b')
        index.add_provider(CapabilityProvider('one', 1, 'a/Camera'), Path('one.yaml'), 'c')
        index.add_provider(CapabilityProvider('two', 1, 'b/Front'), 'two.yaml', 'c')
        index.add_provider(CapabilityProvider('three', 1, 'a/Camera'), 'three.yaml', 'c')
        return index

    def test_names(self, index: SpecIndex) -> None:
        assert index.interface_names == ['a/Camera']
        assert index.semantic_interface_names == ['b/Front']
        assert index.provider_names == ['c/one', 'c/two', 'c/three']
        assert index.names == ['a/Camera', 'b/Front', 'c/one', 'c/two', 'c/three']
        assert list(index.specs) == index.names

    def test_specs_are_named_after_their_package(self, index: SpecIndex) -> None:
        assert {name: spec.name for name, spec in index.specs.items()} == {
            name: name for name in index.names}

    def test_paths_are_plain_strings(self, index: SpecIndex) -> None:
        assert index.interface_paths == {'a/Camera': 'Camera.yaml'}
        assert index.semantic_interface_paths == {'b/Front': 'Front.yaml'}
        assert index.provider_paths == {
            'c/one': 'one.yaml', 'c/two': 'two.yaml', 'c/three': 'three.yaml'}

    def test_the_specs_themselves_are_handed_out(self, index: SpecIndex) -> None:
        index.interfaces['a/Camera'].default_provider = 'c/one'
        index.semantic_interfaces['b/Front'].default_provider = 'c/two'
        assert index.interfaces['a/Camera'].default_provider == 'c/one'
        assert index.specs['b/Front'].default_provider == 'c/two'

    @pytest.mark.parametrize('attribute', [
        'specs', 'interfaces', 'semantic_interfaces', 'providers', 'names', 'interface_names',
        'semantic_interface_names', 'provider_names', 'interface_paths',
        'semantic_interface_paths', 'provider_paths'])
    def test_containers_are_fresh(self, index: SpecIndex, attribute: str) -> None:
        getattr(index, attribute).clear()
        assert getattr(index, attribute)

    def test_providers_of_an_interface(self, index: SpecIndex) -> None:
        assert index.providers_of('a/Camera') == ['c/one', 'c/three']
        assert index.providers_of('b/Front') == ['c/two']
        assert index.providers_of('no/Such') == []

    def test_removed_specs_are_gone(self, index: SpecIndex) -> None:
        index.remove_provider('c/one')
        index.remove_semantic_interface('b/Front')
        index.remove_interface('a/Camera')
        assert index.names == ['c/two', 'c/three']
        assert index.providers_of('a/Camera') == ['c/three']

    @pytest.mark.parametrize('remove, name', [
        ('remove_interface', 'b/Front'), ('remove_semantic_interface', 'a/Camera'),
        ('remove_provider', 'a/Camera'), ('remove_provider', 'c/none')])
    def test_what_is_not_there_cannot_be_removed(self, index: SpecIndex, remove: str,
                                                 name: str) -> None:
        with pytest.raises(KeyError, match=name):
            getattr(index, remove)(name)

    def test_a_removed_spec_can_be_added_again(self, index: SpecIndex) -> None:
        provider = index.providers['c/one']
        index.remove_provider('c/one')
        index.add_provider(provider, 'one.yaml', 'c')
        assert provider.name == 'c/one'
        assert index.providers_of('a/Camera') == ['c/three', 'c/one']

    def test_a_spec_is_not_added_by_the_name_of_another_package(self, index: SpecIndex) -> None:
        interface = CapabilityInterface('a/Laser', 1)
        with pytest.raises(InvalidSpec, match="^laser.yaml: name 'a/Laser' is not of package 'b'"):
            index.add_interface(interface, 'laser.yaml', 'b')
        index.add_interface(interface, 'laser.yaml', 'a')
        assert interface.name == 'a/Laser' and index.interfaces['a/Laser'] is interface

    @pytest.mark.parametrize('name, kind', [
        ('Camera', 'an interface'), ('Front', 'a semantic interface'), ('one', 'a provider')])
    def test_a_name_is_taken_by_one_of_any_kind(self, index: SpecIndex, name: str,
                                                kind: str) -> None:
        package = {'Camera': 'a', 'Front': 'b', 'one': 'c'}[name]
        with pytest.raises(DuplicateNameException) as raised:
            index.add_interface(CapabilityInterface(name, 1), 'again.yaml', package)
        assert str(raised.value) == (
            "again.yaml: '%s/%s' is already the name of %s, in '%s.yaml'"
            % (package, name, kind, name))

    @pytest.mark.parametrize('add, spec, error', [
        ('add_interface', CapabilityInterface('Camera', 1), DuplicateNameException),
        ('add_semantic_interface', SemanticCapabilityInterface('Camera', 'a/Camera', 1),
         DuplicateNameException),
        ('add_provider', CapabilityProvider('Camera', 1, 'a/Camera'), DuplicateNameException),
        ('add_semantic_interface', SemanticCapabilityInterface('Rear', 'a/Kamera', 1),
         InterfaceNameNotFoundException),
        ('add_provider', CapabilityProvider('four', 1, 'a/Kamera'),
         InterfaceNameNotFoundException)])
    def test_what_is_refused_is_left_alone(self, index: SpecIndex, add: str, spec: Any,
                                           error: Any) -> None:
        name, names = spec.name, index.names
        with pytest.raises(error) as raised:
            getattr(index, add)(spec, 'again.yaml', 'a')
        assert (raised.value.spec_name, raised.value.package, raised.value.spec_type) == (
            'a/' + name, 'a', spec.spec_type)
        assert str(raised.value).startswith('again.yaml: ')
        assert spec.name == name
        assert index.names == names
