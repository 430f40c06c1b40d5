"""Whether a launch file can be started: there, inside its package, XML with one <launch>."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, List, Optional, Union
from xml.dom import minidom
from xml.parsers.expat import ExpatError

import pytest
from at_once import at_once
from hypothesis import given
from hypothesis import strategies as st

from rocon_uri.sources import launch_file
from rocon_uri.sources.launch_file import (
    MISSING, NO_LAUNCH, NOT_XML, OUTSIDE, UNREADABLE, LaunchFault, LaunchFiles)

GOOD = '<launch><node name="x" pkg="p" type="t"/></launch>'


@pytest.fixture
def ours(tmp_path: Path) -> Path:
    """The folder launch of a package ours; a package ours_two is beside it."""
    for name in 'ours', 'ours_two':
        (tmp_path / name / 'launch').mkdir(parents=True)
        (tmp_path / name / 'package.xml').write_text('<package/>')
        (tmp_path / name / 'launch' / 'good.launch').write_text(GOOD)
    return tmp_path / 'ours' / 'launch'


def fault(folder: Path, name: str) -> Optional[LaunchFault]:
    return LaunchFiles().look_at(name, str(folder)).fault


def fault_of(folder: Path, content: Union[str, bytes]) -> Optional[LaunchFault]:
    data = content.encode() if isinstance(content, str) else content
    (folder / 'x.launch').write_bytes(data)
    return fault(folder, 'x.launch')


def described(found: Optional[LaunchFault]) -> Any:
    return found and (found.kind, str(found))


# Where it is

@pytest.mark.parametrize('name, expected', [
    ('good.launch', None),
    ('./good.launch', None),
    ('../launch/good.launch', None),
    ('dnace.launch', (MISSING, "launch file 'dnace.launch' does not exist")),
    ('godo.launch', (
        MISSING, "launch file 'godo.launch' does not exist (did you mean 'good.launch'?)")),
    ('../launch/godo.launch', (
        MISSING, "launch file '../launch/godo.launch' does not exist (did you mean "
        "'../launch/good.launch'?)")),
    ('launch/good.launch', (    # as people write who take it to be relative to the package
        MISSING, "launch file 'launch/good.launch' does not exist (did you mean "
        "'good.launch'?)")),
    ('good.launch/x', (MISSING, "launch file 'good.launch/x' does not exist")),
    ('lanch/good.launch', (MISSING, "launch file 'lanch/good.launch' does not exist")),
    ('.', (UNREADABLE, "launch file '.' is not a file")),
    ('../../ours_two/launch/good.launch', (
        OUTSIDE, "launch file '../../ours_two/launch/good.launch' is outside the package")),
    ('../../nothing.launch', (
        OUTSIDE, "launch file '../../nothing.launch' is outside the package")),
    ('/etc/passwd', (OUTSIDE, "launch file '/etc/passwd' is outside the package")),
    ('a\0b', (UNREADABLE, "launch file 'a\\x00b' is not the name of a file")),
    ('\ud800', (UNREADABLE, "launch file '\\ud800' is not the name of a file")),
])
def test_it_is_a_file_inside_its_package(ours: Path, name: str, expected: Any) -> None:
    assert described(fault(ours, name)) == expected


def test_an_absolute_path_may_be_inside(ours: Path) -> None:
    assert fault(ours, str(ours / 'good.launch')) is None


def test_links_are_followed(ours: Path) -> None:
    (ours / 'in.launch').symlink_to('good.launch')
    (ours / 'out.launch').symlink_to('../../ours_two/launch/good.launch')
    (ours / 'dangling.launch').symlink_to('nothing')
    (ours / 'round.launch').symlink_to('round.launch')
    files = LaunchFiles()
    assert files.look_at('in.launch', str(ours)).fault is None
    assert files.look_at('in.launch', str(ours)).real_path == os.path.realpath(
        str(ours / 'good.launch'))
    assert [described(fault(ours, name)) for name in (
        'out.launch', 'dangling.launch', 'round.launch')] == [
        (OUTSIDE, "launch file 'out.launch' is outside the package"),
        (MISSING, "launch file 'dangling.launch' does not exist"),
        (UNREADABLE, "launch file 'round.launch' cannot be read: Too many levels of symbolic "
                     'links')]


def test_a_package_may_be_reached_by_a_link_or_consist_of_links(ours: Path, tmp_path: Path) -> None:
    (tmp_path / 'link').symlink_to('ours')
    assert fault(tmp_path / 'link' / 'launch', 'good.launch') is None
    installed = tmp_path / 'share' / 'ours'
    (installed / 'launch').mkdir(parents=True)
    for name in 'package.xml', 'launch/good.launch':
        (installed / name).symlink_to(tmp_path / 'ours' / name)
    assert fault(installed / 'launch', 'good.launch') is None


def test_what_is_in_no_package_is_outside_of_none(tmp_path: Path) -> None:
    (tmp_path / 'good.launch').write_text(GOOD)
    (tmp_path / 'specs').mkdir()
    assert fault(tmp_path / 'specs', '../good.launch') is None


def test_what_cannot_be_opened_or_is_no_file_is_not_read(ours: Path) -> None:
    os.mkfifo(str(ours / 'fifo.launch'))
    assert described(fault(ours, 'fifo.launch')) == (
        UNREADABLE, "launch file 'fifo.launch' is not a file")
    assert described(fault_of(ours, b'<launch>' + b' ' * 1048576)) == (
        UNREADABLE, "launch file 'x.launch' is larger than 1 MiB, which is all that is read")


@pytest.mark.skipif(os.geteuid() == 0, reason='root reads everything')
def test_a_file_without_permission_cannot_be_read(ours: Path) -> None:
    (ours / 'good.launch').chmod(0)
    assert described(fault(ours, 'good.launch')) == (
        UNREADABLE, "launch file 'good.launch' cannot be read: Permission denied")


def test_an_error_of_reading_is_a_fault(ours: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken_disk(path: str) -> bytes:
        raise OSError(5, 'Input/output error')
    monkeypatch.setattr(launch_file, 'read_file', broken_disk)
    assert described(fault(ours, 'good.launch')) == (
        UNREADABLE, "launch file 'good.launch' cannot be read: Input/output error")


# What is in it

@pytest.mark.parametrize('content, expected', [
    ('<?xml version="1.0"?><!-- all of it -->\n<launch/>\n<!-- -->', None),
    ('<!DOCTYPE launch [<!ENTITY robot "kobuki">]><launch><group ns="&robot;"/></launch>', None),
    ('', (NOT_XML, 'is not XML: no element found (line 1, column 1)')),
    ('roslaunch', (NOT_XML, 'is not XML: syntax error (line 1, column 1)')),
    ('<launch>\n  <node>\n</launch>', (NOT_XML, 'is not XML: mismatched tag (line 3, column 3)')),
    ('<launch/>\n<launch/>', (
        NOT_XML, 'is not XML: junk after document element (line 2, column 1)')),
    ('<launch>&robot;</launch>', (NOT_XML, 'is not XML: undefined entity (line 1, column 9)')),
    ('\n<robot/>', (NO_LAUNCH, "has '<robot>' at its top, expected <launch> (line 2, column 1)")),
    ('<robot><launch/></robot>', (
        NO_LAUNCH, "has '<robot>' at its top, expected <launch> (line 1, column 1)")),
    ('<launch>\n  <launch/></launch>', (
        NO_LAUNCH, 'has a second <launch> (line 2, column 3)')),
    ('<launch><group><launch/></group></launch>', (
        NO_LAUNCH, 'has a second <launch> (line 1, column 16)')),
])
def test_it_is_xml_with_one_launch_at_its_top(ours: Path, content: str, expected: Any) -> None:
    found = described(fault_of(ours, content))
    assert found == (expected and (expected[0], "launch file 'x.launch' " + expected[1]))


@pytest.mark.parametrize('encoding', ['utf-8', 'utf-8-sig', 'utf-16', 'iso-8859-1', 'cp1252'])
def test_encodings_that_expat_and_python_know_are_read(ours: Path, encoding: str) -> None:
    text = '<?xml version="1.0" encoding="%s"?><launch><!-- \u00e9 --></launch>'
    content = (text % encoding.replace('-sig', '')).encode(encoding)
    assert fault_of(ours, content) is None


@pytest.mark.parametrize('encoding', ['foo', 'rot13', 'undefined', 'idna', 'shift_jis'])
def test_other_encodings_are_a_fault(ours: Path, encoding: str) -> None:
    found = fault_of(ours, '<?xml version="1.0" encoding="%s"?><launch/>' % encoding)
    assert found is not None and found.kind == NOT_XML
    assert found.problem == "is not XML: encoding '%s' cannot be read" % encoding


@pytest.mark.parametrize('declarations', [
    '<!ENTITY a "ha"><!ENTITY b "&a;&a;">',         # a billion laughs
    '<!ENTITY b "&#38;c;"><!ENTITY c "&#38;b;">',   # in a circle
    '<!ENTITY b "%s">' % ('x' * 100000),            # one that is long, often
    '<!ENTITY %% b "%s">' % ('&#37;c;' * 100),
])
def test_entities_that_can_grow_are_refused(ours: Path, declarations: str) -> None:
    found = fault_of(ours, '<!DOCTYPE launch [%s]>\n<launch>%s</launch>' % (
        declarations, '&b;' * 100))
    assert found is not None and found.kind == NOT_XML
    assert found.problem == "is not XML that is read: entity 'b' can grow too large"


def test_files_that_entities_name_are_not_read(ours: Path) -> None:
    secret = ours / 'secret'
    secret.write_text('<launch/>')
    assert fault_of(ours, '<!DOCTYPE launch [<!ENTITY s SYSTEM "%s">]><launch>&s;</launch>'
                    % secret) is None


def test_it_may_be_deep(ours: Path) -> None:
    assert fault_of(ours, '<launch>%s%s</launch>' % ('<a>' * 50000, '</a>' * 50000)) is None


@given(st.binary(max_size=60).map(lambda rest: b'<launch>' + rest) | st.binary(max_size=60))
def test_whatever_is_in_it_there_is_one_answer(content: bytes) -> None:
    try:
        launch_file._check_xml(content)
    except launch_file._Refused as refused:
        line, column = refused.place
        assert refused.kind in (NOT_XML, NO_LAUNCH)
        assert line is not None and line >= 1 and column is not None and column >= 1


_PIECES = ['<launch>', '</launch>', '<launch/>', '<group>', '</group>', '<robot/>', 'text', '&amp;',
           '&', '<!-- -->', '<?xml version="1.0"?>', '<', ' ', '<a b="c"/>', '<![CDATA[<launch>]]>']


@given(st.lists(st.sampled_from(_PIECES), max_size=6).map(''.join))
def test_what_roslaunch_starts_is_no_fault_and_the_other_way_round(content: str) -> None:
    """It reads with minidom, and wants one launch; we want it at the top."""
    try:
        document = minidom.parseString(content.encode())
    except ExpatError:
        expected = NOT_XML
    else:
        top: Any = document.documentElement
        one = len(document.getElementsByTagName('launch')) == 1 and top.tagName == 'launch'
        expected = '' if one else NO_LAUNCH
    try:
        launch_file._check_xml(content.encode())
        found = ''
    except launch_file._Refused as refused:
        found = refused.kind
    # What is wrong in two ways is refused for what comes first.
    assert found == expected or (found, expected) == (NO_LAUNCH, NOT_XML)


@pytest.mark.parametrize('content, names_it', [
    ('<launch/>', False),
    ('<launch><arg name="capability_server_nodelet_manager_name"/></launch>', True),
    ('<launch>capability_server_nodelet_manager_name', True),       # a fault does not matter
])
@pytest.mark.parametrize('encoding', ['utf-8', 'utf-16'])
def test_whether_it_takes_the_name_of_the_nodelet_manager(
        ours: Path, content: str, names_it: bool, encoding: str) -> None:
    (ours / 'x.launch').write_bytes(content.encode(encoding))
    assert LaunchFiles().look_at('x.launch', str(ours)).names_nodelet_manager is names_it
    assert not LaunchFiles().look_at('none.launch', str(ours)).names_nodelet_manager


# What is remembered

@pytest.fixture
def reads(monkeypatch: pytest.MonkeyPatch) -> List[str]:
    """The files that are read."""
    paths: List[str] = []
    read_file = launch_file.read_file

    def counted(path: str) -> bytes:
        paths.append(os.path.basename(path))
        return read_file(path)
    monkeypatch.setattr(launch_file, 'read_file', counted)
    return paths


def test_a_file_is_read_again_only_when_it_has_changed(ours: Path, reads: List[str]) -> None:
    files = LaunchFiles()
    for _ in range(3):
        assert files.look_at('good.launch', str(ours)).fault is None
    assert reads == ['good.launch']
    (ours / 'good.launch').write_text('<robot/>')
    for _ in range(3):
        found = files.look_at('good.launch', str(ours)).fault
        assert found is not None and found.kind == NO_LAUNCH
    assert reads == ['good.launch'] * 2
    (ours / 'good.launch').unlink()
    found = files.look_at('good.launch', str(ours)).fault
    assert found is not None and found.kind == MISSING
    (ours / 'good.launch').write_text(GOOD)
    assert files.look_at('good.launch', str(ours)).fault is None


def test_what_is_moved_out_of_the_package_is_looked_at_again(ours: Path) -> None:
    files = LaunchFiles()
    assert files.look_at('good.launch', str(ours)).fault is None
    (ours / 'good.launch').rename(ours / '../../moved.launch')
    (ours / 'good.launch').symlink_to('../../moved.launch')
    found = files.look_at('good.launch', str(ours)).fault
    assert found is not None and found.kind == OUTSIDE


def test_what_is_remembered_needs_no_disk(ours: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files = LaunchFiles()
    good = files.look_at('good.launch', str(ours))
    missing = files.look_at('godo.launch', str(ours))
    remembered = files.remembered()

    def no_disk(*_: Any, **__: Any) -> Any:
        raise AssertionError('the disk is touched')
    for name in 'stat', 'lstat', 'open', 'listdir', 'readlink':
        monkeypatch.setattr(os, name, no_disk)
    assert remembered.look_at('good.launch', str(ours)) is good
    assert remembered.look_at('godo.launch', str(ours)) is missing
    assert 'did you mean' in str(missing.fault)
    assert remembered.look_at('other.launch', str(ours)) is None


def test_what_is_remembered_is_bounded(ours: Path, reads: List[str],
                                       monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(launch_file, '_MAX_FILES', 2)
    files = LaunchFiles()
    for name in 'abc':
        (ours / name).write_text(GOOD)
        files.look_at(name, str(ours))
    assert [files.remembered().look_at(name, str(ours)) is None for name in 'abc'] == [
        True, False, False]


def test_threads_may_share_it(ours: Path) -> None:
    files = LaunchFiles()

    def look() -> None:
        for number in range(200):
            name = 'good.launch' if number % 2 else 'godo.launch'
            found = files.look_at(name, str(ours)).fault
            assert (found is None) == (name == 'good.launch')
    at_once(look, 4)
