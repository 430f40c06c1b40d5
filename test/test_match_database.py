"""match with a database in the place of a file."""
import json
from pathlib import Path

import pytest
import test_resource_index as of_index
from sources import ROOT

from rocon_uri.cli import main

pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')

FLEET = str(ROOT / 'examples' / 'fleet.txt')


@pytest.fixture
def stored(database_url):
    """The URL of a database with the fleet of the examples."""
    assert main(['match', '--in', FLEET, '--into', database_url]) == 0
    return database_url


@pytest.fixture
def ask(capsys):
    def ask(*arguments):
        status = main(['match', *arguments])
        printed = capsys.readouterr()
        return status, printed.out, printed.err
    return ask


def canonical(text):
    """What a file's answer says, in the texts that a database has."""
    from rocon_uri import parse
    lines = [line.rpartition(' ') for line in text.splitlines()]
    return [(front, str(parse(uri))) for front, _, uri in lines]


@pytest.mark.parametrize('arguments', [
    ['rocon:/robot/*/noetic'], ['rocon:/*/*_left'], ['rocon:/'], ['rocon:/pr2', 'rocon:/kobuki'],
    ['rocon:/warthog'], ['--requests-in', str(ROOT / 'examples' / 'apps.txt')]])
def test_it_answers_as_the_file_does(stored, ask, arguments):
    status, out, _ = ask(*arguments, '--in', FLEET)
    found = ask(*arguments, '--in', stored)
    assert found[0] == status
    assert canonical(found[1]) == canonical(out)


@pytest.mark.parametrize('arguments', [
    ['rocon:/pr2/*/*/focal'], ['rocon:/kobuki/bmper'], ['rocon:/pr2/bbo/jade/focal'],
    ['rocon://north/pc/x'], ['rocon:/husky/*/jade'], ['rocon:/pr2/*/*/focal', 'rocon:/kobuki/x'],
    ['rocon:/pr2/*/*/focal', '--json'], ['rocon:/pr2/x{2}', '--matrix']])
def test_what_is_nearest_is_said_as_of_a_file(stored, ask, arguments):
    status, _, err = ask(*arguments, '--in', FLEET)
    assert status == 1
    before, _, rest = err.partition(FLEET + ':')
    line, excluded = int(rest.partition(':')[0]), rest.partition(', excluded by ')[2]
    uri = Path(FLEET).read_text(encoding='utf-8').splitlines()[line - 1].split(' #')[0].strip()
    from rocon_uri import parse
    assert ask(*arguments, '--in', stored)[2] == "%s%s: '%s', excluded by %s" % (
        before, stored.split('?')[0].replace('postgres@', ''), parse(uri), excluded)


def test_an_empty_database_is_said_to_be_one(database_url, ask, tmp_path):
    (tmp_path / 'fleet.txt').write_text('')
    assert ask('--in', str(tmp_path / 'fleet.txt'), '--into', database_url)[0] == 0
    assert ask('rocon:/pr2', '--in', database_url) == (
        1, '', 'rocon_uri: note: nothing found: there are no resources\n')


def test_a_matrix(stored, ask):
    arguments = ['--matrix', '--requests-in', str(ROOT / 'examples' / 'apps.txt')]
    _, out, _ = ask(*arguments, '--in', FLEET)
    status, found, _ = ask(*arguments, '--in', stored)
    assert status == 0
    assert [line.split()[:-1] for line in found.splitlines() if ' rocon:' in line] == [
        line.split()[:-1] for line in out.splitlines() if ' rocon:' in line]


def test_json(stored, ask):
    status, out, _ = ask('rocon:/kobuki', '--in', stored, '--json')
    answer = json.loads(out)
    assert status == 0 and answer['resources']
    for resource in answer['resources']:
        assert resource['requests'] == ['rocon:/kobuki'] and resource['line'] is None
        assert resource['file'] == stored.split('?')[0].replace('postgres@', '')


def test_bad_lines_are_said_and_the_others_stored(database_url, ask, tmp_path):
    fleet = tmp_path / 'fleet.txt'
    fleet.write_text('rocon:/pr2/bob\nrocon:/turtelbot\n# none\nrocon:/kobuki\n', encoding='ascii')
    status, out, errors = ask('--in', str(fleet), '--into', database_url)
    assert (status, out) == (2, '')
    assert errors.startswith('%s:2: ' % fleet) and 'turtelbot' in errors
    assert ask('rocon:/', '--in', database_url)[:2] == (
        0, 'rocon:/pr2/bob/*/*\nrocon:/kobuki/*/*/*\n')


def test_patterns_that_are_too_complex(database_url, ask, tmp_path):
    fleet = tmp_path / 'fleet.txt'
    fleet.write_text('rocon:/pr2/a*\n%s\n' % of_index.TestUndecided.HARD, encoding='ascii')
    assert ask('--in', str(fleet), '--into', database_url)[0] == 0
    status, out, errors = ask(of_index.TestUndecided.REQUEST, '--in', database_url)
    assert (status, out) == (2, 'rocon:/pr2/a*/*/*\n')
    assert 'too complex to compare' in errors


@pytest.mark.parametrize('arguments, message', [
    (['rocon:/', '--in', 'sqlite:////no/such/fleet.db'], 'No such file'),
    (['rocon:/', '--in', 'sqlite://'], 'StaticPool'),
    (['rocon:/', '--in', 'mysql://bob:secret@host/fleet'], "'mysql' is not supported"),
    (['rocon:/', '--in', 'postgresql://bob:secret@host:port/fleet'], 'not a URL such as'),
    (['--in', FLEET, '--into', 'sqlite:////no/such/fleet.db'], 'unable to open'),
    (['--in', FLEET, '--into', 'fleet.db'], 'takes a URL such as sqlite:///fleet.db'),
    (['rocon:/', '--in', FLEET, '--into', 'sqlite:///fleet.db'], 'and nothing else'),
    (['--in', 'sqlite:///one.db', '--into', 'sqlite:///two.db'], 'and nothing else'),
    (['--into', 'sqlite:///two.db'], 'required: --in')])
def test_what_cannot_be_done(ask, arguments, message):
    status, out, errors = ask(*arguments)
    assert (status, out) == (2, '')
    assert message in errors and 'secret' not in errors
    assert len(errors.splitlines()) == 1


def test_a_database_that_is_away(ask):
    pytest.importorskip('psycopg2', reason='psycopg2 is not installed')
    for arguments in (['rocon:/', '--in'], ['--in', FLEET, '--into']):
        status, out, errors = ask(*arguments, 'postgresql://bob:secret@127.0.0.1:1/fleet')
        assert (status, out) == (2, '')
        assert errors.startswith('rocon_uri: postgresql://127.0.0.1:1/fleet: ')
        assert 'secret' not in errors


def test_a_connection_that_is_lost_meanwhile(
        postgresql, postgresql_url, ask, tmp_path, monkeypatch):
    from rocon_uri.resource_database import database
    url = postgresql_url
    fleet = tmp_path / 'fleet.txt'
    fleet.write_text(''.join('rocon:/pr2/bob_%d\n' % number for number in range(3000)),
                     encoding='ascii')
    assert ask('--in', str(fleet), '--into', url) == (0, '', '')
    read = database.read_resource

    def fail(text):
        if 'bob_1000/' in text:
            postgresql.execute('SELECT pg_terminate_backend(pid) FROM pg_stat_activity '
                               "WHERE datname LIKE 'fleet%'")
        return read(text)
    monkeypatch.setattr(database, 'read_resource', fail)
    status, out, errors = ask('rocon:/pr2', '--in', url)
    assert status == 2
    assert out.splitlines()[:1500] == ['rocon:/pr2/bob_%d/*/*' % number for number in range(1500)]
    assert errors.startswith('rocon_uri: postgresql:///fleet_')
    assert len(errors.splitlines()) == 1
