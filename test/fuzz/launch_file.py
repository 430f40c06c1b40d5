"""Launch files, and how a spec names them: looked at and linted, against what minidom reads."""
from __future__ import annotations

import os
import tempfile
from pathlib import Path
from xml.dom import minidom

import yaml
from fuzz.damage import damaged, files
from fuzz.findings import check_findings
from made_packages import make_package

from rocon_uri.lint import ERROR, check_package_index
from rocon_uri.sources.launch_file import (
    MISSING, NO_LAUNCH, NOT_XML, OUTSIDE, UNREADABLE, LaunchFiles)
from rocon_uri.sources.packages import find_packages

GOOD = [path.read_bytes() for path in files('*.launch')] + [
    b'<?xml version="1.0" encoding="utf-8"?>\n<launch>\n  <!-- \xc3\xa9 -->\n  <arg name='
    b'"capability_server_nodelet_manager_name"/>\n  <node name="a" pkg="p" type="t"/>\n</launch>\n',
    b'<!DOCTYPE launch [<!ENTITY robot "kobuki">]><launch><group ns="&robot;"/></launch>',
    '<?xml version="1.0" encoding="utf-16"?><launch><group/></launch>'.encode('utf-16')]
TOKENS = [b'<', b'>', b'/>', b'</', b'"', b"'", b'&', b'&amp;', b'&#0;', b'&#x1F916;', b'&robot;',
          b'<!--', b'-->', b'<![CDATA[', b']]>', b'<?', b'?>', b'<?xml version="1.0"?>',
          b'<?xml version="1.0" encoding="utf-16"?>', b'encoding="idna"', b'encoding="rot13"',
          b'encoding="iso-8859-1"', b'<!DOCTYPE launch [<!ENTITY a "aaaa">]>',
          b'<!ENTITY b "&a;&a;">', b'<!ENTITY c SYSTEM "/etc/passwd">', b'<!ENTITY % d "&#37;d;">',
          b'<launch>', b'</launch>', b'<launch/>', b'<group>', b'</group>', b'<a:launch>',
          b'xmlns="x"', b'<launch xmlns:a="x">', b'\xff', b'\xfe', b'\xef\xbb\xbf', b'\xc3\xa9',
          b'\0', b'\x7f', b'\n', b' ', b'a' * 5000, b'<a>' * 2000]
PIECES = [b'<launch>', b'</launch>', b'<launch/>', b'<group>', b'</group>', b'<robot/>', b'text',
          b'&amp;', b'&', b'<!-- -->', b'<a b="c"/>', b'<![CDATA[<launch>]]>', b'\n']
NAMES = ['launch/a.launch', 'a.launch', '../a.launch', '../launch/../launch/a.launch', 'b.launch',
         'launch/aa.launch', '/etc/passwd', '../../../../etc/passwd', 'launch', '.', '..',
         '../package.xml', 'link.launch', 'damaged/a.launch', 'damaged/launch/a.launch',
         '$(find damaged)/launch/a.launch', 'package://damaged/launch/a.launch']
NAME_TOKENS = ['/', '..', '.', 'launch', 'a', '.launch', '\0', '\n', '\ud800', '\xe9', ' ', '~',
               'a' * 300, '$(env HOME)', '\\', '\u202e']
KINDS = {MISSING, NO_LAUNCH, NOT_XML, OUTSIDE, UNREADABLE}


def make(rng):
    """(how the provider names it, what it contains)"""
    name = rng.choice(NAMES[:1] * 10 + NAMES)
    content = damaged(rng, rng.choice(GOOD), TOKENS)
    if rng.random() < 0.5:
        content = b'<launch>%s</launch>' % b''.join(rng.choices(PIECES, k=rng.randrange(6)))
    return damaged(rng, name, NAME_TOKENS) if rng.random() < 0.3 else name, content


def check(given):
    name, content = given
    with tempfile.TemporaryDirectory() as folder:
        package = make_package(
            Path(folder), 'damaged', [('capability_interface', 'Camera.yaml'),
                                      ('capability_provider', 'camera.yaml')],
            Camera_yaml='{name: Camera, spec_type: interface, spec_version: 1}',
            camera_yaml=yaml.safe_dump({
                'name': 'camera', 'spec_type': 'provider', 'spec_version': 1,
                'implements': 'damaged/Camera', 'launch_file': name.replace('\ud800', '')}))
        (package / 'launch').mkdir()
        for path in package / 'a.launch', package / 'launch' / 'a.launch', Path(folder, 'a.launch'):
            path.write_bytes(content)
        (package / 'link.launch').symlink_to(Path(folder, 'a.launch'))
        launch_files = LaunchFiles()
        found = launch_files.look_at(name, str(package))
        assert launch_files.look_at(name, str(package)) == found
        check_file(found, package)
        findings = check_package_index(find_packages([folder]), {}).findings
        check_findings(findings, folder)
        looked_at = [finding.id for finding in findings if finding.id in KINDS]
        named = LaunchFiles().look_at(name.replace('\ud800', ''), str(package)).fault
        if name.replace('\ud800', '').strip():
            assert looked_at == ([] if named is None else [named.kind])
            assert named is None or any(finding.severity == ERROR or finding.id == MISSING
                                        for finding in findings)


def check_file(found, package):
    """A fault is said on one line; what has none is inside the package, and one launch."""
    if found.fault is not None:
        fault = found.fault
        assert fault.kind in KINDS and str(fault).isprintable()
        assert fault.line is None or fault.line >= 1 and fault.column >= 1
        if fault.kind == NOT_XML and 'too large' not in fault.problem and (
                'encoding' not in fault.problem):
            assert not is_one_launch(Path(found.path).read_bytes())
        return
    assert os.path.realpath(str(package)) in map(str, Path(found.real_path).parents)
    assert is_one_launch(Path(found.path).read_bytes())


def is_one_launch(content):
    """Does minidom, with which roslaunch reads, find one launch, at the top?"""
    try:
        document = minidom.parseString(content)
    except Exception:       # of expat, of codecs, and of minidom's own
        return False
    return document.documentElement.tagName == 'launch' and len(
        document.getElementsByTagName('launch')) == 1
