"""What the linter says of interactions: which are one, what they need, what they refer to."""
from __future__ import annotations

import pytest
from made_packages import make_package

from rocon_uri.lint import check_packages

HONK = '{name: "", role: Staff, compatibility: "rocon:/pc", display_name: %s, pairing: {rapp: %s}}'


def found(tmp_path, monkeypatch, text, **others):
    make_package(tmp_path, 'ours', [('rocon_app', 'honk.rapp'), ('rocon_app', 'wave.rapp')],
                 honk_rapp='{}', wave_rapp='{}', x_interactions=text, **others)
    monkeypatch.chdir(tmp_path)
    return [str(finding).partition('ours/x.interactions:')[2]
            for finding in check_packages(['.'], []) if 'x.interactions' in finding.file_name]


def first(**keys):
    """An interaction of the first form."""
    return {'name': 'web', 'role': 'Staff', 'compatibility': 'rocon:/pc', 'display_name': 'Menu',
            **keys}


def later(**keys):
    """An interaction of the later form."""
    return {'name': 'Menu', 'command': 'web', 'group': 'Staff', 'compatibility': 'rocon:/pc',
            **keys}


def test_two_without_a_name_that_are_paired_are_two(tmp_path, monkeypatch):
    text = '[%s, %s]' % (HONK % ('Honk', 'ours/honk'), HONK % ('Wave', 'ours/wave'))
    assert found(tmp_path, monkeypatch, text) == []


@pytest.mark.parametrize('name', ['name: "", ', 'name: null, ', 'name: , ', ''])
def test_a_name_may_be_missing_where_a_rapp_is_paired(tmp_path, monkeypatch, name):
    text = '[%s]' % (HONK % ('Honk', 'ours/honk')).replace('name: "", ', name, 1)
    assert found(tmp_path, monkeypatch, text) == []
    text = text.replace('pairing: {rapp: ours/honk}', 'max: 1')
    assert len(found(tmp_path / 'unpaired', monkeypatch, text)) == 1


@pytest.mark.parametrize('one, other, severity', [
    (first(), first(), 'error'),
    (first(), first(name='other', description='other'), 'error'),
    (first(), first(display_name='Other'), None),
    (first(), first(role='Guest'), None),
    (first(), first(namespace='/kitchen'), None),
    (first(), first(namespace='/'), 'error'),
    (first(), first(namespace=''), 'error'),
    (first(compatibility='rocon:/tablet'), first(), 'warning'),
    (first(), first(compatibility='rocon:/tablet'), 'warning'),
    (later(), later(), 'error'),
    (later(), later(command='other'), 'error'),
    (later(), later(name='Other'), None),
    (later(), later(group='Guest'), None),
    (later(), later(role='Guest'), 'error'),
    (later(), later(namespace='/kitchen'), None),
    (later(), later(compatibility='rocon:/tablet'), 'warning'),
    (later(group='Other'), later(group=None), 'error'),
    (later(group='Hidden'), later(hidden=True), 'error'),
    (later(), later(hidden=True), None),
    (later(), later(hidden=False), 'error'),
    (later(), later(hidden=1), 'error'),
    (first(), later(), None),
])
def test_which_two_entries_are_one(tmp_path, monkeypatch, one, other, severity):
    import json
    lines = found(tmp_path, monkeypatch, json.dumps([one, other]))
    assert [line.split(' ')[1].rstrip(':') for line in lines] == ([severity] if severity else [])
    assert all("duplicate interaction 'Menu'" in line and line.endswith(' [duplicate-interaction]')
               for line in lines)


@pytest.mark.parametrize('one, other, are_one', [
    ('group: A', 'group: A', True), ('group: A', 'group: B', False), ('group: ', 'group: ""', True),
    ('group: ', 'group: Other', False)])
def test_which_two_pairings_are_one(tmp_path, monkeypatch, one, other, are_one):
    text = '- pairings:\n' + ''.join(
        '  - {name: Talk, rapp: ours/honk, %s}\n' % keys for keys in (one, other))
    assert found(tmp_path, monkeypatch, text) == [
        "3:5: error: duplicate pairing 'Talk' [duplicate-interaction]"] * are_one


def without_group():
    """An interaction of the later form, whose group is said elsewhere."""
    entry = later()
    del entry['group']
    return entry


@pytest.mark.parametrize('where, group', [
    ([without_group()], 'Other'),
    ({'interactions': [without_group()]}, 'Other'),
    ({'group': 'A', 'interactions': [without_group()]}, 'A'),
    ([{'group': 'A', 'interactions': [without_group()]}], 'A'),
    ({'B': [without_group()]}, 'B'),
    ({'B': [{'interactions': [without_group()]}]}, 'B'),
    ({'group': 'A', 'B': [without_group()]}, 'A'),
    ({'group': 'A', 'interactions': [later(group='B')]}, 'B')])
def test_a_group_is_that_of_its_entries(tmp_path, monkeypatch, where, group):
    import json
    for name in 'A', 'B', 'Other':
        text = json.dumps([where if isinstance(where, dict) else {'interactions': where},
                           later(group=name)])
        lines = found(tmp_path / name, monkeypatch, text)
        assert ['duplicate interaction' in line for line in lines] == [True] * (name == group)


@pytest.mark.parametrize('pairing, finding', [
    ('{rapp: ours/honk}', None),
    ('{name: Honk, rapp: ours/honk, remappings: [{remap_from: a, remap_to: b}]}', None),
    ('{rapp: ours/hnok}', "error: rapp 'ours/hnok' does not exist (did you mean 'ours/honk'?) "
                          '[unknown-app]'),
    ('{}', 'error: pairing has no rapp [missing-key]'),
    ('[ours/honk]', 'error: pairing is a list, expected a mapping [wrong-value]'),
    ('{rapp: ours/honk, raps: x}', "warning: unknown key 'raps' in pairing (did you mean 'rapp'?) "
                                   '[unknown-key]'),
    ('{rapp: ours/honk, remappings: [{remap_from: a, remap_to: b-c}]}',
     "error: remap_to 'b-c' is not a legal ROS name [illegal-name]"),
])
def test_a_pairing_in_an_entry_is_checked_like_another(tmp_path, monkeypatch, pairing, finding):
    text = ('[{name: a, display_name: A, role: Staff, compatibility: "rocon:/pc", pairing: %s}]'
            % pairing)
    assert [line.partition(' ')[2] for line in found(tmp_path, monkeypatch, text)] == (
        [finding] if finding else [])


@pytest.mark.parametrize('value, finding', [
    ('1', None), ('-1', None), ('0', None), ('null', None),
    ('-2', 'max is -2, expected a whole number from -1 on'),
    ('many', "max is 'many', expected a whole number from -1 on"),
    ('"1"', "max is '1', expected a whole number from -1 on"),
    ('1.5', 'max is 1.5, expected a whole number from -1 on'),
    ('true', 'max is true, expected a whole number from -1 on'),
])
def test_max_is_a_number(tmp_path, monkeypatch, value, finding):
    text = '[{name: A, command: a, compatibility: "rocon:/pc", max: %s}]' % value
    assert found(tmp_path, monkeypatch, text) == (
        ['1:%d: error: %s [wrong-value]' % (text.index('max: ') + 6, finding)] if finding else [])


@pytest.mark.parametrize('text, finding', [
    ('{display_name: A, name: a, compatibility: "rocon:/pc"}', 'an interaction has no role'),
    ('{display_name: A, name: a, role: Staff}', 'an interaction has no compatibility'),
    ('{display_name: A, role: Staff, compatibility: "rocon:/pc"}', 'an interaction has no name'),
    ('{name: A, group: B, compatibility: "rocon:/pc"}', 'an interaction has no command'),
    ('{name: A, group: B, command: "", compatibility: "rocon:/pc"}', None),
    ('{name: "", group: B, command: a, compatibility: "rocon:/pc"}', 'name is empty'),
])
def test_what_an_entry_cannot_do_without(tmp_path, monkeypatch, text, finding):
    lines = found(tmp_path, monkeypatch, '[%s]' % text)
    assert len(lines) == bool(finding) and all('error: ' + finding in line for line in lines)


@pytest.mark.parametrize('uri, column, meant', [
    ('rocon:/pc/kitkat', 38, "an operating_system (did you mean 'rocon:/pc/*/*/kitkat'?)"),
    ('rocon:/pc/kitkat#a/kitkat', 38,
     "an operating_system (did you mean 'rocon:/pc/*/*/kitkat#a/kitkat'?)"),
    ('rocon:/pc/jessie', None, ''), ('rocon:/pc/*/*/kitkat', None, '')])
def test_a_name_that_is_a_value_of_another_field(tmp_path, monkeypatch, uri, column, meant):
    lines = found(tmp_path, monkeypatch, '[{name: A, compatibility: "%s"}]' % uri)
    assert lines == ([] if column is None else [
        "1:%d: warning: compatibility: name 'kitkat' is %s [misplaced-name]" % (column, meant)])


@pytest.mark.parametrize('uri, column, problem', [
    ('rocon:/pcc', 35, "hardware_platform 'pcc' is not registered (did you mean 'pc'?); to "
                       'register it, add it to a rules file that a package exports or that '
                       'ROCON_URI_RULES names'),
    ('rocon:/pc?', 37, "only the name can have a '?', as part of a pattern")])
def test_advice_is_given_where_there_is_some(tmp_path, monkeypatch, uri, column, problem):
    assert found(tmp_path, monkeypatch, '[{name: A, compatibility: "%s"}]' % uri) == [
        '1:%d: error: compatibility: %s [invalid-uri]' % (column, problem)]


PAIRED = '''\
interactions:
- {name: Menu, command: web, compatibility: "rocon:/pc", required_pairings: [%s]}
pairings:
- {name: Talk, rapp: ours/honk, requires_interaction: %s}
'''


@pytest.mark.parametrize('names, finding', [
    (('Talk', 'Menu'), None),
    (('Tlak', 'Menu'), "2:78: error: pairing 'Tlak' does not exist in the interactions of the "
                       "package (did you mean 'Talk'?) [unknown-pairing]"),
    (('Talk', 'Mneu'), "4:55: error: interaction 'Mneu' does not exist in the interactions of the "
                       "package (did you mean 'Menu'?) [unknown-interaction]"),
    (('7', 'Menu'), '2:78: error: an item of required_pairings is 7, expected text [wrong-value]'),
    (('Talk, Else', 'Other'), None),        # in another file of the package
])
@pytest.mark.parametrize('where', ['a_interactions', 'y_interactions'])
def test_references_between_entries(tmp_path, monkeypatch, where, names, finding):
    other = PAIRED.replace('Menu', 'Other').replace('Talk', 'Else') % ('Else', 'Other')
    assert found(tmp_path, monkeypatch, PAIRED % names, **{where: other}) == (
        [finding] if finding else [])


def test_what_was_meant_is_said_of_a_few_references(tmp_path, monkeypatch):
    text = 'pairings: [%s]\ninteractions: [%s]\n' % (
        ', '.join('{name: pairing_%d, rapp: ours/honk}' % number for number in range(30)),
        ', '.join(str(later(name='Menu %d' % number, required_pairings=['pairimg_%d' % number]))
                  for number in range(30)))
    assert ['did you mean' in finding for finding in found(tmp_path, monkeypatch, text)] == (
        [True] * 20 + [False] * 10)
