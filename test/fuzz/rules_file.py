"""Rules files, two of a package and one that a machine names: read, folded in, and linted."""
from __future__ import annotations

import json
import tempfile
from pathlib import Path

import yaml
from fuzz.damage import damaged_yaml, files
from fuzz.findings import check_findings
from made_packages import PACKAGE_XML

from rocon_uri import RoconURIValueError, Vocabulary, is_compatible, parse
from rocon_uri.grammar import VOCABULARY_FIELDS
from rocon_uri.lint import check_package_index
from rocon_uri.sources.packages import find_packages
from rocon_uri.sources.ros_names import is_legal_base_name
from rocon_uri.sources.yaml_data import YamlError
from rocon_uri.sources.yaml_source import load
from rocon_uri.vocabulary import RULES_FOLDER, read_rules, vocabulary_of_packages

GOOD = [path.read_text() for path in files('robots.yaml')] + [
    json.dumps(json.loads(Path(RULES_FOLDER, name + '.json').read_text()))
    for name in VOCABULARY_FIELDS] + ['''\
- hardware_platform:
    robot: [bender, {crushinator: [big, small]}]
    pc:
- operating_system:
  - ubuntu: [{future: [zebra]}]
    linux:
- application_framework: {ros: [{ours: }], theirs: {more: [less]}}
''', '''\
- hardware_platform:
  - robot:
    - bender
- hardware_platform: {robot: [fry], phone: {smart_phone: [leela]}}
''']
TREES = [yaml.safe_load(text) for text in GOOD]
SCALARS = [*VOCABULARY_FIELDS, 'hardware_platfrom', 'robot', 'pc', 'phone', 'pr2', 'ros', 'noetic',
           'ubuntu', 'linux', 'focal', 'bender', 'fry', 'ours', 'name', 'concert_name', '*', 'a|b',
           'a/b', 'a b', '3d', '_', 'a' * 255, 'a' * 256, 'a' * 5000, '\0', '\xe9', '\U0001f916',
           '', ' ', 'yes', None, True, 0, 22.04, 10 ** 300, float('nan')]
BUNDLED = Vocabulary.bundled()
PATHS = ['a.yaml', 'b.yaml']


def make(rng):
    """The texts of the two files."""
    return [make_text(rng), make_text(rng)]


def make_text(rng):
    number = rng.randrange(len(GOOD))
    return damaged_yaml(rng, GOOD[number], TREES[number], SCALARS)


def check(texts):
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder, 'damaged')
        package.mkdir()
        (package / 'package.xml').write_text(PACKAGE_XML % ('damaged', '\n'.join(
            '<rocon_uri rules="${prefix}/%s"/>' % name for name in PATHS)))
        for name, text in zip(PATHS, texts):
            (package / name).write_bytes(text.encode('utf-8', 'surrogatepass'))
        one_by_one, refused = BUNDLED, []
        for name in PATHS:
            alone = read(BUNDLED, package / name)
            if alone is not None:
                check_vocabulary(alone)
                check_added(alone, load((package / name).read_bytes()))
            extended = read(one_by_one, package / name)
            refused += [name] * (extended is None)
            one_by_one = extended or one_by_one
        packages = find_packages([folder])
        together, faults = vocabulary_of_packages(packages)
        assert [Path(fault.file_name).name for fault in faults] == refused
        assert all(values(together, field) == values(one_by_one, field)
                   for field in VOCABULARY_FIELDS)
        findings = check_package_index(packages, {}).findings
        check_findings(findings, folder)
        assert [(Path(finding.file_name).name, finding.line, finding.column)
                for finding in findings] == [
                    (Path(fault.file_name).name, fault.line, fault.column) for fault in faults]


def read(vocabulary, path):
    """The vocabulary with the rules of a file, None if it is refused."""
    try:
        return read_rules(vocabulary, str(path))
    except YamlError as error:
        assert str(error).isprintable() and len(str(error)) < 1000
        assert error.line >= 1 and error.column >= 1
        return None


def values(vocabulary, field):
    """What each value and group of a field stands for."""
    found = vocabulary.field(field)
    return {name: found.leaves(name) for name in found}


def check_added(vocabulary, rules):
    """All that a file names is in the field that it names it for."""
    for below in rules if isinstance(rules, list) else [rules or {}]:
        for field in below if isinstance(below, dict) else ():      # one may stand alone
            assert set(names_in(below[field])) <= set(vocabulary.field(field))


def names_in(rules):
    """The values and groups anywhere in some rules."""
    if isinstance(rules, str):
        yield rules
    elif rules is not None:
        for below in rules:
            yield from names_in(below)
            if isinstance(rules, dict):
                yield from names_in(rules[below])


def check_vocabulary(vocabulary):
    """What was known before stands for no less, and each new value can be asked for."""
    for field in VOCABULARY_FIELDS:
        before, now = values(BUNDLED, field), values(vocabulary, field)
        assert all(set(now[below]) <= set(now[name])      # a value may have become a group
                   for name in before for below in before[name])
        for name in set(now) - set(before):
            assert is_legal_base_name(name)
            uri = 'rocon:/' + '/'.join(
                {'name': '*', field: name}.get(part, '*')
                for part in ('hardware_platform', 'name', 'application_framework',
                             'operating_system'))
            try:
                assert is_compatible(parse(uri, vocabulary), parse(uri, vocabulary))
            except RoconURIValueError as error:
                raise AssertionError(uri) from error
