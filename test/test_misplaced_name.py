"""A name that is probably meant as a value of another field is mentioned."""
from __future__ import annotations

import pytest

from rocon_uri import Vocabulary, parse
from rocon_uri.cli import main
from rocon_uri.misplaced_name import misplaced_name


@pytest.mark.parametrize('text, meant', [
    ('rocon:/pc/kitkat', 'rocon:/pc/*/*/kitkat'),
    ('rocon:/pr2/noetic', 'rocon:/pr2/*/noetic'),
    ('rocon:/*/ros', 'rocon:/*/*/ros'),
    ('rocon:/pc/ubuntu', 'rocon:/pc/*/*/ubuntu'),
    ('rocon://north/pr2/focal#ours/dance', 'rocon://north/pr2/*/*/focal#ours/dance'),
    ('rocon:/pc/one', 'rocon:/pc/*/one'),
])
def test_a_name_that_is_a_value_of_another_field(text, meant):
    assert "(did you mean '%s'?)" % meant in misplaced_name(parse(text))


def test_both_fields_that_have_it_are_named():
    assert misplaced_name(parse('rocon:/pc/groovy')) == (
        "name 'groovy' is an application_framework and an operating_system "
        "(did you mean 'rocon:/pc/*/groovy' or 'rocon:/pc/*/*/groovy'?)")


@pytest.mark.parametrize('text', [
    'rocon:/pc', 'rocon:/pc/bob', 'rocon:/pc/kit*', 'rocon:/pc/kit(kat)',
    'rocon:/pc/kitkat/noetic', 'rocon:/pc/kitkat/*/focal',
    'rocon:/pc/pr2', 'rocon:/pc/stretch',                       # platforms
    'rocon:/pc/tara', 'rocon:/pc/vera', 'rocon:/pc/gigi',       # of Linux Mint
    *('rocon:/pc/' + name for name in 'bo buzz rex woody lenny jessie sid duke jade foxy'.split()),
])
def test_other_names_are_left_alone(text):
    assert misplaced_name(parse(text)) is None


def test_it_goes_by_the_vocabulary_of_the_uri():
    ours = Vocabulary.bundled().extended({'operating_system': ['bob_os']})
    assert "'rocon:/pc/*/*/bob_os'" in misplaced_name(parse('rocon:/pc/bob_os', ours))
    assert misplaced_name(parse('rocon:/pc/bob_os')) is None


@pytest.mark.parametrize('arguments', [['parse', 'rocon:/pc/kitkat'],
                                       ['check', 'rocon:/pc/kitkat', 'rocon:/pc'],
                                       ['check', 'rocon:/pc', 'rocon:/pc/kitkat']])
def test_parse_and_check_mention_it(arguments, capsys):
    assert main(arguments) == 0
    assert capsys.readouterr().err == (
        "rocon_uri: note: in 'rocon:/pc/kitkat', name 'kitkat' is an operating_system "
        "(did you mean 'rocon:/pc/*/*/kitkat'?)\n")


def test_parse_mentions_one_of_a_kind_and_counts_the_others(tmp_path, capsys):
    path = tmp_path / 'fleet.txt'
    path.write_text('rocon:/pc/kitkat\nrocon:/pr2/kitkat\nrocon:/pc/focal\nrocon://pc/bob\n'
                    + ''.join('rocon://pc/bob_%d\n' % number for number in range(50)))
    assert main(['parse', '--quiet', 'rocon:/*/kitkat', '--in', str(path)]) == 0
    assert capsys.readouterr().err.splitlines() == [
        "rocon_uri: note: in 'rocon:/*/kitkat', name 'kitkat' is an operating_system "
        "(did you mean 'rocon:/*/*/*/kitkat'?)",
        "rocon_uri: note: in 'rocon:/pc/focal', name 'focal' is an operating_system "
        "(did you mean 'rocon:/pc/*/*/focal'?)",
        "rocon_uri: note: 'rocon://pc/bob' is read as 'rocon:/pc/bob', since pc is a "
        'hardware_platform, not a concert',
        "rocon_uri: note: name 'kitkat' is an operating_system, also in 2 other URIs",
        'rocon_uri: note: pc is a hardware_platform, not a concert, also in 50 other URIs']
