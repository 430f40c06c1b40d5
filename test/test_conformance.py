"""The conformance cases, and every compatibility string that robot makers have published."""
from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from rocon_uri import RoconURI, RoconURIValueError, explain, is_compatible, parse, relation
from rocon_uri.sources.yaml_source import load_file

CASES = json.loads((Path(__file__).parent / 'conformance' / 'rocon_uri.json').read_text())

# as they stand in the specification
PUBLISHED_EXAMPLES = '''
    rocon://turtlebot2/cybernetic_pirate
    rocon:/pr2/bob
    rocon:/turtlebot2/cybernetic_pirate#rocon_apps/im_here_to_make_you_lazy
    rocon:/pr2/bob#rocon_apps/look_menacing
    rocon:/*/*#rocon_apps/im_here_to_make_you_lazy
    rocon:/pr2/*#rocon_apps/look_menacing
    rocon:/note3/remocon_342ac3e813/hydro/jellybean
    rocon:/pc/bobs_remocon/hydro/precise
    rocon:/turtlebot2
    rocon:/turtlebot2|pr2
    rocon:/
    rocon:/note3/*/hydro/jellybean
    rocon:/pc/bobs_remocon/hydro/precise
'''.split()


def cases(section):
    return pytest.mark.parametrize('case', CASES[section], ids=lambda case: str(case)[:80])


def values(uri):
    return {'concert_name': uri.concert_name,
            'hardware_platform': uri.hardware_platform.list,
            'name': uri.name.string,
            'application_framework': uri.application_framework.list,
            'operating_system': uri.operating_system.list,
            'rocon_app': uri.rocon_app,
            'canonical': str(uri),
            'short': uri.short}


@cases('parse')
def test_is_read(case):
    text = case['uri']
    expected = {key: value for key, value in case.items() if key != 'uri'}
    assert values(parse(text)) == expected
    for same in (case['canonical'], case['short'], parse(text).to_rfc3986()):
        assert values(parse(same)) == expected


def test_every_published_example_is_a_case():
    assert set(PUBLISHED_EXAMPLES) <= {case['uri'] for case in CASES['parse']}


@cases('reject')
def test_is_refused(case):
    with pytest.raises(RoconURIValueError) as caught:
        parse(case['uri'])
    assert caught.value.field == case['field'], str(caught.value)
    assert caught.value.uri == case['uri']


@cases('compatible')
def test_compatible(case):
    a, b, expected = case
    for x, y in ((a, b), (b, a)):
        assert is_compatible(x, y) is expected
        assert explain(x, y).is_compatible is expected


@cases('relation')
def test_relation(case):
    a, b, expected = case
    assert relation(a, b).value == expected
    mirrored = {'subset': 'superset', 'superset': 'subset'}.get(expected, expected)
    assert relation(b, a).value == mirrored


@cases('names')
def test_names(case):
    name = RoconURI.from_fields(name=case['pattern']).name
    assert [text for text in case['admits'] if text not in name] == []
    assert [text for text in case['refuses'] if text in name] == []


def compatibility_strings(content):
    if isinstance(content, dict):
        if 'compatibility' in content:
            yield content['compatibility']
        content = list(content.values())
    if isinstance(content, list):
        for below in content:
            yield from compatibility_strings(below)


@pytest.mark.parametrize('pattern', ['*.rapp', '*.interactions'])
def test_every_compatibility_string_of_the_corpus_is_read(pattern):
    folder = os.environ.get('ROCON_URI_CORPUS')
    if not folder:
        pytest.skip('ROCON_URI_CORPUS is not set')
    found = {path: list(compatibility_strings(load_file(str(path))))
             for path in Path(folder).rglob(pattern)}
    assert any(found.values())
    for path, texts in found.items():
        for text in texts:
            assert parse(parse(text).short) == parse(text), path
