"""What packages export, one of them with a damaged manifest: found, indexed and linted."""
from __future__ import annotations

import os
import tempfile
from pathlib import Path

from capabilities.discovery import (
    DuplicateNameException, EXPORTS, InterfaceNameNotFoundException, PackageError,
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from capabilities.specs.common import InvalidSpec
from fuzz.damage import damaged, files
from fuzz.findings import check_findings
from made_packages import PACKAGE_XML, make_package

from rocon_uri.lint import ERROR, check_package_index
from rocon_uri.lint.checked_file import is_inside
from rocon_uri.apps.rapps import InvalidRapp, rapps_from_package_index
from rocon_uri.sources.packages import find_packages
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.vocabulary import vocabulary_of_packages


GOOD = {path.parent: path.read_bytes() for path in files('package.xml')}
TOKENS = [b'<', b'>', b'/>', b'</', b'"', b"'", b'&', b'&amp;', b'&#0;', b'&#x1F916;', b'&#10;',
          b'&a;', b'<!--', b'-->', b'<![CDATA[', b']]>', b'<?', b'?>',
          b'<?xml version="1.0" encoding="utf-16"?>', b'<!DOCTYPE package [<!ENTITY a "aaaa">]>',
          b'\xff', b'\xc3\xa9', b'\0', b'\x7f', b'\n', b' ', b'<export>', b'</export>',
          b'<package>', b'</package>', b'<name>', b'</name>', b'<version>', b'xmlns:x="x" ',
          b'<x:rocon_app>', b'condition="$ROS_VERSION == 1"', b'untouched', b'..', b'/',
          b'../../../etc/passwd', b'/etc/passwd', b'/dev/zero', b'a' * 5000, b'package.xml', b'.',
          b'<rocon_uri rules="${prefix}/rules/robots.yaml"/>', b'<rocon_uri rules="/etc/passwd"/>',
          b'<rocon_uri rules="${prefix}"/>', b'<rocon_uri rules=""/>', b'<rocon_uri/>',
          b'<rocon_app>no_such.rapp</rocon_app>', b'<rocon_app/>', b'<rocon_app><a/>x</rocon_app>',
          b'<depend>roscpp</depend>', b'<build_type>cmake</build_type>', b'format="3"',
          b'format="9"']
TOKENS += [b'<%s>' % tag.encode() for tag in EXPORTS] + [b'</%s>' % tag.encode() for tag in EXPORTS]
TOKENS += [b'<%s/>' % tag.encode() for tag in EXPORTS]

UNTOUCHED = [('capability_interface', 'Camera.yaml'), ('rocon_app', 'dance.rapp')]
RULES = '    <rocon_uri rules="${prefix}/robots.yaml"/>'


def make(rng):
    """(the folder of a good package, its manifest)"""
    folder = rng.choice(list(GOOD))
    return str(folder), damaged(rng, GOOD[folder], TOKENS)


def check(given):
    good_folder, manifest = given
    with tempfile.TemporaryDirectory() as workspace:
        make_package(Path(workspace), 'a_package', UNTOUCHED,
                     dance_rapp='{display: Dance, description: It dances}',
                     Camera_yaml='{name: Camera, spec_type: interface, spec_version: 1}',
                     robots_yaml='hardware_platform: [untouched]')
        manifest_path = Path(workspace, 'a_package', 'package.xml')
        manifest_path.write_text(PACKAGE_XML % ('untouched', '\n'.join(
            ['<%s>%s</%s>' % (tag, path, tag) for tag, path in UNTOUCHED] + [RULES])))
        package = Path(workspace, 'b_package')
        package.mkdir()
        for name in os.listdir(good_folder):
            if name != 'package.xml':
                (package / name).symlink_to(Path(good_folder, name))
        (package / 'package.xml').write_bytes(manifest)
        check_workspace(workspace)


def check_workspace(workspace):
    faults = []
    index = package_index_from_package_path(workspace, faults)
    specs, spec_faults = spec_index_from_spec_file_index(spec_file_index_from_package_index(index))
    rapps, rapp_faults = rapps_from_package_index(index)
    vocabulary, rules_faults = vocabulary_of_packages(find_packages([str(workspace)]))
    assert 'untouched/Camera' in specs.interfaces
    assert 'untouched/dance' in rapps
    assert 'untouched' in vocabulary.field('hardware_platform')
    for found, kinds in (
            (faults, PackageError), (rapp_faults, InvalidRapp),
            (rules_faults, (YamlError, OSError)),
            (spec_faults, (OSError, InvalidSpec, DuplicateNameException,
                           InterfaceNameNotFoundException))):
        assert all(isinstance(fault, kinds) for fault in found), found
        assert all(isinstance(fault, OSError) or str(fault).isprintable() for fault in found)
    findings = check_package_index(find_packages([workspace]), {}, faults).findings
    check_findings(findings, workspace)
    assert not any('a_package' in finding.file_name for finding in findings)
    assert len(faults) == 2 - len(index)
    wrong = sum(finding.severity == ERROR and finding.file_name.endswith('package.xml')
                for finding in findings)
    for package in index.values():
        folder = os.path.dirname(package.filename)
        paths = [os.path.normpath(os.path.join(folder, (export.content or '').strip()))
                 for export in package.exports if export.tagname in EXPORTS + ('rocon_app',)]
        assert wrong or all(is_inside(path, folder) and os.path.isfile(path) for path in paths)
        assert wrong or len(paths) == len(set(paths))
