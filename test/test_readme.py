"""What README and the pages beside it claim."""
from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys

import pytest
from sources import ROOT, SOURCE

import rocon_uri

PAGES = [ROOT / name for name in ('README.md', 'CONTRIBUTING.md', 'SECURITY.md')]
README = PAGES[0].read_text(encoding='utf-8')


def section(title):
    return re.search(r'^## %s\n(.*?)(?=^## |\Z)' % title, README, re.MULTILINE | re.DOTALL).group(1)


def demonstrations():
    """The commands under "Try it", each with the output below it."""
    text = section('Try it')
    for match in re.finditer(r'^    \$ (.*)\n((?:    (?!\$).*\n)*)', text, re.MULTILINE):
        yield match.group(1), re.sub('^    ', '', match.group(2), flags=re.MULTILINE)


@pytest.mark.skipif(not (ROOT / 'src').is_dir(), reason='not in the source of rocon_uri')
@pytest.mark.parametrize('command, output', list(demonstrations()))
def test_the_demonstration_needs_nothing_but_python(command, output):
    script, *arguments = shlex.split(command)
    assert script == 'scripts/rocon_uri' and os.access(str(ROOT / script), os.X_OK)
    done = subprocess.run(
        [sys.executable, '-S', '-E', '-B', script, *arguments], cwd=str(ROOT),
        env={'PATH': os.environ['PATH'], 'LANG': 'C.UTF-8'}, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, universal_newlines=True)
    assert done.stdout == output


def test_there_are_demonstrations_of_a_yes_and_of_a_no():
    commands = [command for command, _ in demonstrations()]
    assert {command.split()[1] for command in commands} == {'check', 'match', 'parse'}


def test_the_lines_of_python_do_what_they_say(capsys):
    program = re.search(r'```python\n(.*?)```', section('Try it'), re.DOTALL).group(1)
    fleet = [rocon_uri.parse('rocon:/turtlebot2/' + name) for name in ('remocon_a1', 'bob')]
    values = [eval(line, {'rocon_uri': rocon_uri, 'fleet': fleet})
              for line in program.splitlines()[2:]]
    assert values[0] is True and values[2] is rocon_uri.Relation.SUBSET
    assert list(map(str, values[3])) == ['rocon:/turtlebot2/remocon_a1/*/*']
    assert 'not compatible' in capsys.readouterr().out


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_what_a_page_links_to_is_there(page):
    links = re.findall(r'\]\(([^)#]+)', page.read_text(encoding='utf-8'))
    for link in links:
        assert link.startswith('https://') or (ROOT / link).exists(), link
    assert links


def test_the_scripts_that_are_named_are_there():
    named = re.findall(r'\bbash ([a-z]+/[a-z]+)', ''.join(page.read_text() for page in PAGES))
    assert {'examples/run', 'examples/demo', 'test/run', 'test/long', 'test/wheel'} <= set(named)
    assert all((ROOT / name).is_file() for name in named)


def test_the_picture_shows_the_workspace_as_it_is():
    done = subprocess.run(
        [sys.executable, '-B', 'scripts/rocon_uri', 'specs', 'graph', '--json', '--package-path',
         'examples/workspace', '--robot', 'rocon:/turtlebot2/cybernetic_pirate/noetic/focal'],
        cwd=str(ROOT), env=dict(os.environ, PYTHONPATH=str(SOURCE)), check=True,
        stdout=subprocess.PIPE)
    picture = (ROOT / 'doc' / 'pictures' / 'cafe.svg').read_text(encoding='utf-8')
    shown = set(re.findall(r'<title>([^<]+)</title>', picture))
    nodes = {node['id'] for node in json.loads(done.stdout.decode())['nodes']}
    assert nodes == {title.replace('&#45;', '-') for title in shown
                     if '/' in title and '&gt;' not in title}
