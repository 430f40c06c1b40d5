"""The walk that finds packages, and what is read of their manifests."""
from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Iterator, List

import pytest
from capabilities.discovery import package_index_from_package_path
from made_packages import make_package

from rocon_uri.lint import check_packages
from rocon_uri.sources import packages
from rocon_uri.sources.located import Place
from rocon_uri.sources.packages import (
    PackageError, as_package, find_packages, package_folders, package_from_manifest)

ROOT_TAG = '<package format="2"><name>ours</name><export>%s</export></package>'


def read(folder: Path, manifest: str) -> List[str]:
    (folder / 'package.xml').write_text(manifest, encoding='utf-8')
    return package_from_manifest(str(folder / 'package.xml')).files('rocon_app')


@pytest.mark.parametrize('text, path', [
    ('a.rapp', 'a.rapp'),
    ('\n  rapps/a.rapp\n', 'rapps/a.rapp'),
    ('a&amp;b.rapp', 'a&b.rapp'),
    ('a<!-- of ours -->.rapp', 'a.rapp'),
    ('<![CDATA[a&b.rapp]]>', 'a&b.rapp'),
    ('${prefix}/a.rapp', 'a.rapp'),
    ('a<b/>.rapp', 'a<b>.rapp'),
])
def test_the_text_of_an_export_is_what_the_parser_says(tmp_path: Path, text: str, path: str
                                                       ) -> None:
    manifest = ROOT_TAG % '<rocon_app>%s</rocon_app>' % text
    assert read(tmp_path, manifest) == [str(tmp_path / path)]


def test_the_text_of_a_package_of_catkin_is_the_same(tmp_path: Path) -> None:
    make_package(tmp_path, 'ours', [('rocon_app', 'a&amp;b<!-- c -->.rapp')])
    [package] = package_index_from_package_path([str(tmp_path)]).values()
    assert as_package(package).files('rocon_app') == [str(tmp_path / 'ours' / 'a&b.rapp')]


def test_an_export_knows_its_place_and_its_attributes(tmp_path: Path) -> None:
    (tmp_path / 'package.xml').write_text(ROOT_TAG % '\n  <rocon_uri rules="${prefix}/a.yaml"/>')
    package = package_from_manifest(str(tmp_path / 'package.xml'))
    [export] = package.exports
    assert (export.tag, export.line, export.column) == ('rocon_uri', 2, 3)
    assert export.attributes == {'rules': '${prefix}/a.yaml'}
    assert package.files('rocon_uri', 'rules') == [str(tmp_path / 'a.yaml')]
    assert package.files('rocon_uri', 'other') == []


@pytest.mark.parametrize('manifest, problem', [
    ('<?xml version="1.0" encoding="foo"?>' + ROOT_TAG % '', "the encoding 'foo'"),
    ('<package><name>a</name><name>b</name></package>', 'exactly one "name"'),
    ('<package><name>a/b</name></package>', 'naming conventions'),
    ('<package format="9"><name>a</name></package>', "format version '9'"),
    ('<package><name>a</name>', 'not XML: no element found'),
])
def test_a_faulty_manifest_is_refused_in_one_line(tmp_path: Path, manifest: str, problem: str
                                                  ) -> None:
    with pytest.raises(PackageError) as caught:
        read(tmp_path, manifest)
    assert problem in caught.value.problem
    assert str(caught.value).isprintable()
    assert caught.value.line == 1


@pytest.mark.parametrize('manifest, place', [
    ('<package>\n  <name>a</name>\n  <name>b</name>\n</package>', (3, 3)),
    ('<package>\n  <version>1</version>\n</package>', (1, 1)),
    ('<package>\n  <version>1</version>\n  <name>a b</name>\n</package>', (3, 3)),
    ('<?xml version="1.0"?>\n<robot/>', (2, 1)),
    ('<?xml version="1.0"?>\n <package format="9"/>', (2, 2)),
])
def test_a_faulty_manifest_says_where(tmp_path: Path, manifest: str, place: Place) -> None:
    with pytest.raises(PackageError) as caught:
        read(tmp_path, manifest)
    assert caught.value.place == place


@pytest.mark.parametrize('encoding', ['utf-8', 'UTF-8', 'ISO-8859-1', 'us-ascii'])
def test_a_manifest_is_utf_8_whatever_it_says(tmp_path: Path, encoding: str) -> None:
    manifest = '<?xml version="1.0" encoding="%s"?>' % encoding
    assert read(tmp_path, manifest + ROOT_TAG % '<rocon_app>\xe9</rocon_app>') == [
        str(tmp_path / '\xe9')]


@pytest.mark.parametrize('encoding, problem, place', [
    ('latin-1', 'not UTF-8 (Latin-1?): byte 0xe9 at offset 56', (1, 57)),
    ('utf-16', 'UTF-16, not UTF-8: byte 0xff at offset 0', (1, 1)),
    ('utf-16-be', 'UTF-16, not UTF-8: byte 0x00 at offset 0', (1, 1)),
])
def test_another_encoding_is_named_with_the_byte(
        tmp_path: Path, encoding: str, problem: str, place: Place) -> None:
    path = tmp_path / 'package.xml'
    path.write_bytes((ROOT_TAG % '<rocon_app>\xe9</rocon_app>').encode(encoding))
    with pytest.raises(PackageError) as caught:
        package_from_manifest(str(path))
    assert (caught.value.problem, caught.value.place) == (problem, place)


@pytest.fixture
def deep(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with more folders below one another than Python recurses, and a file in the last."""
    monkeypatch.chdir(tmp_path)
    for _ in range(1100):
        os.mkdir('d')
        os.chdir('d')
    Path('dance.app').write_text('[')
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    for _ in range(1100):   # pytest removes it by recursion
        os.rename('d', 'e')
        if os.path.isdir('e/d'):
            os.rename('e/d', 'd')
            os.rmdir('e')


def test_packages_are_found_beside_folders_in_folders(deep: Path) -> None:
    make_package(deep, 'ours')
    assert list(find_packages([str(deep)])) == ['ours']


def test_a_package_may_have_folders_in_folders(deep: Path) -> None:
    make_package(deep, 'our', installed_installed='apps: [app: ours/dance]')
    os.rename('our/package.xml', 'package.xml')
    manifest = deep / 'package.xml'
    manifest.write_text(manifest.read_text().replace('>our<', '>ours<').replace(
        '<export>', '<depend>app_manager</depend><export><app_manager app_dir="our"/>'))
    assert [(finding.id, finding.file_name.count('d/')) for finding in check_packages([str(deep)])
            ] == [('not-yaml', 1100)]


def test_the_folder_with_nosubdirs_counts_and_those_below_do_not(tmp_path: Path) -> None:
    folder = make_package(tmp_path, 'ours')
    (folder / 'rospack_nosubdirs').touch()
    make_package(tmp_path / 'stack', 'theirs')
    (tmp_path / 'stack' / 'rospack_nosubdirs').touch()
    assert list(package_folders(str(tmp_path))) == [str(folder)]


def test_a_folder_that_is_removed_while_it_is_walked(tmp_path: Path) -> None:
    first, second = make_package(tmp_path, 'a'), make_package(tmp_path, 'b')
    make_package(tmp_path, 'c')
    errors: List[PackageError] = []
    walk = package_folders(str(tmp_path), errors)
    assert next(walk) == str(first)
    shutil.rmtree(str(second))
    assert list(walk) == [str(tmp_path / 'c')]
    assert errors == []


def test_a_package_that_is_removed_while_it_is_read(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    make_package(tmp_path, 'a')
    gone = make_package(tmp_path, 'b') / 'package.xml'

    def folders(path: str, errors: List[PackageError]) -> List[str]:
        found = list(package_folders(path, errors))
        gone.unlink()
        return found

    monkeypatch.setattr(packages, 'package_folders', folders)
    errors: List[PackageError] = []
    assert list(find_packages([str(tmp_path)], errors)) == ['a']
    assert list(map(str, errors)) == ['%s: cannot be read: No such file or directory' % gone]


def test_a_folder_that_cannot_be_read_is_a_fault(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    make_package(tmp_path, 'a')
    (tmp_path / 'locked').mkdir()

    def scandir(path: str) -> object:
        if path == str(tmp_path / 'locked'):
            raise PermissionError(13, 'Permission denied', path)
        return real_scandir(path)

    real_scandir = os.scandir
    monkeypatch.setattr(os, 'scandir', scandir)
    errors: List[PackageError] = []
    assert list(find_packages([str(tmp_path)], errors)) == ['a']
    assert list(map(str, errors)) == [
        '%s: folder cannot be read: Permission denied' % (tmp_path / 'locked')]
    assert list(find_packages([str(tmp_path)])) == ['a']
    [finding] = check_packages([str(tmp_path / 'locked')])
    assert str(finding).endswith(
        'locked: error: folder cannot be read: Permission denied [cannot-read]')


@pytest.mark.skipif(os.geteuid() == 0, reason='root reads everything')
def test_a_folder_that_its_user_may_not_read_is_a_fault(tmp_path: Path) -> None:
    tmp_path.chmod(0)
    errors: List[PackageError] = []
    try:
        assert find_packages([str(tmp_path)], errors) == {}
    finally:
        tmp_path.chmod(0o755)
    assert list(map(str, errors)) == ['%s: folder cannot be read: Permission denied' % tmp_path]


def test_a_manifest_that_catkin_refuses_exports_all_the_same(tmp_path: Path) -> None:
    manifest = make_package(tmp_path, 'ours', [('rocon_app', 'a.rapp')]) / 'package.xml'
    text = manifest.read_text()
    assert '<maintainer email="' in text
    manifest.write_text(text.replace('<maintainer email="', '<maintainer email="at home '))
    faults: List[PackageError] = []
    assert package_index_from_package_path([str(tmp_path)], faults) == {}
    assert [fault.file_name for fault in faults] == [str(manifest)]
    assert find_packages([str(tmp_path)])['ours'].files('rocon_app') == [
        str(tmp_path / 'ours' / 'a.rapp')]


@pytest.mark.skipif(not os.path.isdir('/usr/share'), reason='there is no /usr/share')
def test_only_the_folders_directly_in_usr_share_are_visited(
        monkeypatch: pytest.MonkeyPatch) -> None:
    visited: List[str] = []
    scandir = os.scandir
    monkeypatch.setattr(os, 'scandir', lambda path: visited.append(path) or scandir(path))
    folders = list(package_folders('/usr/share'))
    assert {os.path.dirname(folder) for folder in folders} <= {'/usr', '/usr/share'}
    assert {os.path.dirname(folder) for folder in visited} == {'/usr', '/usr/share'}


def test_a_package_in_an_earlier_folder_hides_that_in_a_later_one(tmp_path: Path) -> None:
    for name in 'under', 'over':
        make_package(tmp_path / name, 'ours')
    make_package(tmp_path / 'under', 'theirs')
    errors: List[PackageError] = []
    found = find_packages([str(tmp_path / 'over'), str(tmp_path / 'under')], errors)
    assert {name: package.folder for name, package in found.items()} == {
        'ours': str(tmp_path / 'over' / 'ours'), 'theirs': str(tmp_path / 'under' / 'theirs')}
    assert errors == []


def test_hidden_folders_are_skipped(tmp_path: Path) -> None:
    make_package(tmp_path / '.git', 'ours')
    make_package(tmp_path / 'a' / '.b' / 'c', 'theirs')
    make_package(tmp_path, '.hidden')
    make_package(tmp_path / 'a.b', 'seen')
    assert list(find_packages([str(tmp_path)])) == ['seen']
    assert list(find_packages([str(tmp_path / '.git')])) == ['ours']      # it was asked for


def test_a_path_that_no_folder_can_have(tmp_path: Path) -> None:
    assert find_packages(['a\0b', str(tmp_path / 'gone'), '']) == {}
