"""What README and the pages beside it claim."""
from __future__ import annotations

import importlib
import json
import os
import re
import shlex
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from sources import ROOT, SOURCE

import rocon_uri

PAGES = [ROOT / name for name in ('README.md', 'CONTRIBUTING.md', 'SECURITY.md')]
README = PAGES[0].read_text(encoding='utf-8')


def section(title):
    return re.search(r'^## %s\n(.*?)(?=^## |\Z)' % title, README, re.MULTILINE | re.DOTALL).group(1)


def demonstrations(title='Try it'):
    """The commands of a section, each with the output below it."""
    text = section(title)
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


def python_with(folder, *modules):
    """The environment in which ``python3 -S`` has these modules, and no others but its own."""
    for module in modules:
        source = Path(importlib.import_module(module).__file__).parent
        (folder / module).symlink_to(source)
        for compiled in source.parent.glob('_%s*' % module):
            (folder / compiled.name).symlink_to(compiled)
    return dict(os.environ, PYTHONPATH=str(folder), ROS_PACKAGE_PATH='', ROCON_URI_RULES='')


@pytest.mark.skipif(not (ROOT / 'src').is_dir(), reason='not in the source of rocon_uri')
@pytest.mark.parametrize('command', [
    command for command, _ in demonstrations('A whole workspace')] + [
    re.sub(r'\S+\.svg', 'x.dot', line) for line in re.findall(
        r'^    scripts/(.*\S)', section('A whole workspace'), re.MULTILINE)])
def test_a_workspace_is_judged_and_drawn_with_pyyaml_alone(command, tmp_path):
    pytest.importorskip('yaml', reason='PyYAML is not installed')
    (tmp_path / 'modules').mkdir()
    (tmp_path / 'examples').symlink_to(ROOT / 'examples')
    done = subprocess.run(
        [sys.executable, '-S', '-B', str(ROOT / 'scripts' / 'rocon_uri'),
         *shlex.split(command.partition(' ')[2])], cwd=str(tmp_path),
        env=python_with(tmp_path / 'modules', 'yaml'), stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, universal_newlines=True)
    assert (done.returncode, done.stderr) == (0, '')


@pytest.fixture
def own_app(tmp_path):
    """A folder like the clone, with the app that README shows in it."""
    files = re.findall(r'`(mine/dance/\w+\.\w+)`[^`]*?:\n\n((?:    .*\n)+)',
                       section('An app of your own'))
    assert [name for name, _ in files] == [
        'mine/dance/' + name for name in ('package.xml', 'dance.rapp', 'dance.launch')]
    (tmp_path / 'mine' / 'dance').mkdir(parents=True)
    for name, text in files:
        (tmp_path / name).write_text(textwrap.dedent(text))
    for name in 'scripts', 'examples':
        (tmp_path / name).symlink_to(ROOT / name)
    return tmp_path


@pytest.mark.skipif(not (ROOT / 'src').is_dir(), reason='not in the source of rocon_uri')
def test_an_app_of_ones_own_is_judged_as_it_says(own_app):
    pytest.importorskip('yaml', reason='PyYAML is not installed')
    (own_app / 'modules').mkdir()
    environment = python_with(own_app / 'modules', 'yaml')
    shown = list(demonstrations('An app of your own'))
    assert len(shown) == 2
    for command, output in shown:
        done = subprocess.run(
            [sys.executable, '-S', '-B', *shlex.split(command)], cwd=str(own_app), env=environment,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        start, cut, _ = output.partition('...\n')
        assert done.stdout.startswith(start) if cut else done.stdout == output


def test_the_linter_finds_no_fault_in_an_app_of_ones_own(own_app):
    pytest.importorskip('catkin_pkg', reason='catkin_pkg is not installed')
    [arguments] = re.findall(r'`scripts/rocon_uri (specs check [^`]*)`', README)
    done = subprocess.run(
        [sys.executable, '-B', '-m', 'rocon_uri', *arguments.split()], cwd=str(own_app),
        env=dict(os.environ, PYTHONPATH=str(SOURCE)), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, universal_newlines=True)
    assert done.stdout == 'rocon_uri: no errors and no warnings in 1 package\n'


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


def test_readme_links_to_every_page_but_those_that_sphinx_fills():
    linked = set(re.findall(r'\]\(doc/(\w+)\.rst', README))
    pages = {path.stem for path in (ROOT / 'doc').glob('*.rst')}
    assert pages - linked == {'index', 'api', 'changelog'} and linked <= pages


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
