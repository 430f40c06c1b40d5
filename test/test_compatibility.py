"""Compatible or not, how the resources of two URIs are related, and why."""
from __future__ import annotations

import os
import subprocess
import sys

import pytest

from rocon_uri import (PatternTooComplex, Relation, RoconURI, RoconURIValueError, Vocabulary,
                       explain, is_compatible, parse, relation)

APP = 'rocon:/kobuki|turtlebot2'
ROBOT = 'rocon:/kobuki/bob/noetic/focal'

# Deciding whether these meet takes more work than is allowed.
HARD = ['rocon:/*/(a|b)*a(a|b){200}', 'rocon:/*/(a|b)*b(a|b){201}']


def test_texts_and_uris_are_taken_alike():
    for a in (APP, parse(APP)):
        for b in (ROBOT, parse(ROBOT)):
            assert is_compatible(a, b) is True
            assert relation(a, b) is Relation.SUPERSET
            assert explain(a, b)
            assert not parse(a).isdisjoint(b)


@pytest.mark.parametrize('compare', [is_compatible, relation, explain, RoconURI.isdisjoint,
                                     RoconURI.issubset, RoconURI.issuperset])
def test_what_is_no_uri_is_an_error(compare):
    bad = [('http:/pr2', RoconURIValueError), ('rocon:/unheard_of', RoconURIValueError),
           (None, TypeError)]
    for text, error in bad:
        with pytest.raises(error):
            compare(parse('rocon:/pr2'), text)


# Any resource at all, and what is not registered

UNREGISTERED = 'rocon:/bender/bob/my_framework/my_system'


@pytest.mark.parametrize('anything', ['rocon:/', 'rocon:', 'rocon://', 'rocon:/*/*/*/*',
                                      'rocon:/#rocon_apps/talker', 'rocon:/pr2|*'])
def test_an_app_for_anything_runs_on_a_robot_nobody_registered(anything):
    everything = Vocabulary.open()
    for a in (anything, parse(anything)):
        for b in (UNREGISTERED, parse(UNREGISTERED, everything)):
            assert is_compatible(a, b) is is_compatible(b, a) is True
            assert explain(a, b).is_compatible is explain(b, a).is_compatible is True


@pytest.mark.parametrize('something', ['rocon:/pr2', 'rocon:/*/bob', 'rocon:/*/.*',
                                       'rocon:/*/*/ros', 'rocon:/*/*/*/linux'])
def test_an_app_for_something_asks_for_registered_values(something):
    for compare in (is_compatible, explain):
        for a, b in ((something, UNREGISTERED), (UNREGISTERED, something)):
            with pytest.raises(RoconURIValueError) as caught:
                compare(a, b)
            assert caught.value.value == 'bender'


@pytest.mark.parametrize('bad, field', [
    ('rocon:/b-ender', 'hardware_platform'), ('rocon:/bender/3bob', 'name'),
    ('rocon:/bender|', 'hardware_platform'), ('rocon:/bender/bob/ros/linux/x', 'uri'),
    ('rocon:/bender#a/b/c', 'rocon_app'), ('bender', 'uri'), ('', 'uri')])
def test_even_beside_anything_a_text_has_to_be_legal(bad, field):
    for a, b in (('rocon:/', bad), (bad, 'rocon:/')):
        with pytest.raises(RoconURIValueError) as caught:
            is_compatible(a, b)
        assert caught.value.field == field


@pytest.mark.parametrize('compare', [relation, RoconURI.isdisjoint, RoconURI.issubset,
                                     RoconURI.issuperset])
def test_only_is_compatible_takes_what_is_not_registered(compare):
    with pytest.raises(RoconURIValueError) as caught:
        compare(parse('rocon:/'), UNREGISTERED)
    assert caught.value.value == 'bender'


# Concerts and apps

@pytest.mark.parametrize('a, b, compatible, lies', [
    ('rocon://north/pr2', 'rocon://north/pr2', True, 'equal'),
    ('rocon://north/pr2', 'rocon://north/pr2/bob', True, 'superset'),
    ('rocon://north/pr2', 'rocon://south/pr2', False, 'disjoint'),
    ('rocon://north/pr2', 'rocon:/pr2', True, 'subset'),
    ('rocon://north', 'rocon:/', True, 'subset'),
    ('rocon://north', 'rocon://south', False, 'disjoint'),
    ('rocon://north', 'rocon:/pr2', True, 'overlap'),
    ('rocon:/pr2#a/b', 'rocon:/pr2#c', True, 'equal'),
    ('rocon:/pr2#a/b', 'rocon:/robot', True, 'subset'),
])
def test_the_concert_counts_where_both_name_one_and_the_app_never(a, b, compatible, lies):
    assert is_compatible(a, b) is is_compatible(b, a) is compatible
    assert relation(a, b).value == lies
    assert explain(a, b).is_compatible is compatible


def test_the_concert_is_explained_if_there_is_one():
    assert [row.field for row in explain(APP, ROBOT).fields] == [
        'hardware_platform', 'name', 'application_framework', 'operating_system']
    rows = explain('rocon://north/pr2', 'rocon://south/pr2').fields
    assert rows[0] == ('concert_name', 'north', 'south', False, '')
    assert [row.is_compatible for row in rows] == [False, True, True, True, True]
    assert explain('rocon://north', 'rocon:/').fields[0] == (
        'concert_name', 'north', '*', True, 'north')


# Any is more than all that is registered

@pytest.mark.parametrize('field', ['hardware_platform', 'application_framework',
                                   'operating_system'])
def test_any_is_more_than_everything_that_is_registered(field):
    anything = RoconURI()
    registered = anything.vocabulary.field(field)
    everything = RoconURI.from_fields(**{field: registered.children()})
    assert relation(everything, anything) is Relation.SUBSET
    assert relation(anything, everything) is Relation.SUPERSET
    assert everything.issubset(anything)
    assert not anything.issubset(everything)
    assert set(getattr(everything, field).expand()) == set(getattr(anything, field).expand())


# Vocabularies

def test_the_older_of_two_vocabularies_gives_way():
    older = Vocabulary.bundled()
    newer = older.extended({'hardware_platform': {'robot': ['bender']}})
    robot, bender = parse('rocon:/robot', older), parse('rocon:/bender', newer)
    assert is_compatible(robot, bender) is is_compatible(bender, robot) is True
    assert relation(bender, robot) is Relation.SUBSET
    assert bender.issubset(robot) and robot.issuperset(bender) and not robot.isdisjoint(bender)
    assert explain(robot, bender).fields[0].shared == 'bender'
    assert explain(robot, bender).a.vocabulary is newer


def test_what_the_newer_vocabulary_does_not_know_is_an_error():
    older = Vocabulary.bundled().extended({'hardware_platform': {'robot': ['bender']}})
    newer = Vocabulary.bundled().extended({'hardware_platform': {'robot': ['flexo']}})
    bender, flexo = parse('rocon:/bender', older), parse('rocon:/flexo', newer)
    for compare in (is_compatible, relation, explain):
        for a, b in ((bender, flexo), (flexo, bender)):
            with pytest.raises(RoconURIValueError) as caught:
                compare(a, b)
            assert caught.value.value == 'bender'
    assert is_compatible(bender, parse('rocon:/', newer))


def test_a_value_becomes_a_group_in_the_newer_vocabulary():
    older = Vocabulary.bundled()
    newer = older.extended({'hardware_platform': {'pr2': ['pr2_a', 'pr2_b']}})
    pr2, part = parse('rocon:/pr2', older), parse('rocon:/pr2_a', newer)
    assert is_compatible(pr2, part)
    assert relation(part, pr2) is Relation.SUBSET


def test_one_open_vocabulary_opens_the_other():
    bender = parse('rocon:/bender', Vocabulary.bundled().opened())
    assert not is_compatible(bender, 'rocon:/pr2')
    assert not is_compatible('rocon:/robot', bender)
    assert is_compatible(parse('rocon:/*/bob'), bender)
    assert relation(bender, 'rocon:/') is Relation.SUBSET
    assert relation(bender, 'rocon:/robot') is Relation.DISJOINT
    closed = parse('rocon:/robot|*', Vocabulary.bundled())      # a newer one
    assert is_compatible(bender, closed) and is_compatible(closed, bender)
    assert relation(bender, closed) is Relation.SUBSET
    pr2 = parse('rocon:/pr2', closed.vocabulary)
    assert not is_compatible(bender, pr2) and not is_compatible(pr2, bender)


# Explanations

def test_an_explanation_is_an_answer():
    yes, no = explain(APP, ROBOT), explain(APP, 'rocon:/pr2')
    assert yes and not no
    assert yes.is_compatible is True
    assert no.is_compatible is False
    assert yes.a == parse(APP) and yes.b == parse(ROBOT)
    assert yes.fields[0] == ('hardware_platform', 'kobuki|turtlebot2', 'kobuki', True, 'kobuki')
    assert yes.fields[0].shared == 'kobuki'


@pytest.mark.parametrize('a, b, field, shared', [
    ('rocon:/robot', 'rocon:/pr2|note3|kobuki', 'hardware_platform', 'kobuki|pr2'),
    ('rocon:/phone|tablet', 'rocon:/mobile_device', 'hardware_platform', 'mobile_device'),
    ('rocon:/mobile_device', 'rocon:/galaxy|mega|note3|phone_other', 'hardware_platform', 'phone'),
    ('rocon:/', 'rocon:/robot', 'hardware_platform', 'robot'),
    ('rocon:/kobuki|pr2', 'rocon:/', 'hardware_platform', 'kobuki|pr2'),
    ('rocon:/', 'rocon:/', 'hardware_platform', '*'),
    ('rocon:/pr2', 'rocon:/kobuki', 'hardware_platform', ''),
    ('rocon:/*/*/*/linux', 'rocon:/*/*/*/ubuntu', 'operating_system', 'ubuntu'),
    ('rocon:/*/bob', 'rocon:/*/b*', 'name', 'bob'),
    ('rocon:/*/*', 'rocon:/*/b*', 'name', 'b*'),
    ('rocon:/*/arm_*', 'rocon:/*/*_left', 'name', 'arm_left'),
    ('rocon:/*/bob', 'rocon:/*/alice', 'name', ''),
    ('rocon:/*/[a-m]+', 'rocon:/*/[n-z]+', 'name', ''),
])
def test_an_explanation_says_what_both_have_in_common(a, b, field, shared):
    for x, y in ((a, b), (b, a)):
        row, = (row for row in explain(x, y).fields if row.field == field)
        assert '|'.join(sorted(row.shared.split('|'))) == shared
        assert row.is_compatible is (shared != '')


def test_an_example_of_two_patterns_is_admitted_by_both():
    a, b = parse('rocon:/*/(ab|ba)*c'), parse('rocon:/*/[^c]{4,}.')
    row, = (row for row in explain(a, b).fields if row.field == 'name')
    assert row.shared in a.name and row.shared in b.name


def test_values_of_an_open_vocabulary_are_shared():
    everything = Vocabulary.bundled().opened()
    a, b = parse('rocon:/bender|flexo|pr2', everything), parse('rocon:/flexo|robot', everything)
    assert explain(a, b).fields[0].shared == 'pr2|flexo'


@pytest.mark.parametrize('a, b, lines', [
    ('rocon:/kobuki/bob', 'rocon:/kobuki|pr2/bob*/noetic', [
        'compatible',
        '   field                  first   second      in common',
        'x  hardware_platform      kobuki  kobuki|pr2  kobuki',
        'x  name                   bob     bob*        bob',
        'x  application_framework  *       noetic      noetic',
        'x  operating_system       *       *           *',
        'x fits, . does not']),
    ('rocon:/*/bob*', 'rocon:/*/bob', [
        'compatible',
        '   field                  first  second  in common',
        'x  hardware_platform      *      *       *',
        'x  name                   bob*   bob     bob',
        'x  application_framework  *      *       *',
        'x  operating_system       *      *       *',
        'x fits, . does not']),
    ('rocon://north/pr2|fetch/bob/noetic|hydro/focal|jammy',
     'rocon:/kobuki|pr2/bob/noetic|foxy/focal|web', [
        'compatible',
        '   field                  first         second       in common',
        'x  concert_name           north         *            north',
        'x  hardware_platform      pr2|fetch     kobuki|pr2   pr2',
        'x  name                   bob           bob          bob',
        'x  application_framework  noetic|hydro  noetic|foxy  noetic',
        'x  operating_system       focal|jammy   focal|web    focal',
        'x fits, . does not']),
    ('rocon://north/kobuki/*_left/ros', 'rocon://south/pr2/arm_*/noetic', [
        'not compatible',
        '   field                  first   second  in common',
        '.  concert_name           north   south   nothing',
        '.  hardware_platform      kobuki  pr2     nothing',
        'x  name                   *_left  arm_*   e.g. arm_left',
        'x  application_framework  ros     noetic  noetic',
        'x  operating_system       *       *       *',
        'x fits, . does not']),
])
def test_an_explanation_reads_as_a_table(a, b, lines):
    assert str(explain(a, b)).split('\n') == lines


# Too much work

def test_a_question_that_is_too_hard_is_refused_where_it_is_asked():
    a, b = HARD
    for compare in (is_compatible, relation, explain):
        with pytest.raises(PatternTooComplex) as caught:
            compare(a, b)
        assert caught.value.field == 'name'
        assert '\n' not in str(caught.value)
    with pytest.raises(PatternTooComplex):
        parse(a).isdisjoint(b)


def test_an_explanation_leaves_names_undecided_where_another_field_decides():
    a, b = HARD
    verdict = explain(parse(a).replace(hardware_platform='pr2'),
                      parse(b).replace(hardware_platform='kobuki'))
    assert not verdict.is_compatible
    assert {c.field: c.is_compatible for c in verdict.fields} == {
        'hardware_platform': False, 'name': None, 'application_framework': True,
        'operating_system': True}
    assert 'too complex to say' in str(verdict)


def test_a_vocabulary_that_was_given_is_the_one_that_both_are_read_with():
    # whichever was made first; in a process of its own, where the default one is made last
    subprocess.run([sys.executable, '-c', '''
from rocon_uri import Relation, Vocabulary, is_compatible, parse, relation
ours = Vocabulary.bundled().extended({'hardware_platform': {'robot': ['ours']}})
for _ in range(2):      # the second time, the default one has been completed
    assert is_compatible(parse('rocon:/ours', ours), 'rocon:/robot')
    assert is_compatible('rocon:/robot', parse('rocon:/ours', ours.opened()))
    assert relation(parse('rocon:/ours', ours), 'rocon:/robot') is Relation.SUBSET
'''], check=True, env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))


def test_what_the_other_fields_decide_is_not_asked_of_the_names():
    a, b = HARD
    assert not is_compatible(parse(a).replace(hardware_platform='pr2'),
                             parse(b).replace(hardware_platform='kobuki'))
    assert not is_compatible(parse(a).replace(concert_name='north'),
                             parse(b).replace(concert_name='south'))
    assert relation(parse(a).replace(operating_system='osx'),
                    parse(b).replace(operating_system='web')) is Relation.DISJOINT
    assert is_compatible(a, a) and relation(a, a) is Relation.EQUAL
    assert is_compatible(a, 'rocon:/')
    assert not is_compatible(a, 'rocon:/*/aba')


def test_the_relations_there_are():
    assert [member.value for member in Relation] == [
        'equal', 'subset', 'superset', 'overlap', 'disjoint']
