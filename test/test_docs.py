"""The documentation is true: Sphinx builds it, and its commands print what it says they print."""
import io
import os
import re
import shlex
import subprocess
import sys
import textwrap

import pytest
from sources import ROOT

PAGES = [ROOT / 'README.md', *sorted((ROOT / 'doc').glob('*.rst'))]


def commands():
    """Each command shown on a page, with the output below it."""
    for page in PAGES:
        for match in re.finditer(
                r'^( +)\$ (?:rosrun rocon_uri |scripts/)rocon_uri (.*)\n((?:\1(?!\$).*\n|\n)*)',
                page.read_text(encoding='utf-8'), re.MULTILINE):
            indent, command, output = match.groups()
            if '--package-path mine' in command:        # README's own app is tested with README
                continue
            output = re.sub('^' + indent, '', output, flags=re.MULTILINE)
            yield pytest.param(command, output.strip('\n'), id='%s: %s' % (page.name, command))


@pytest.mark.parametrize('command, output', list(commands()))
def test_a_command_prints_what_the_page_says(command, output):
    environment = dict(os.environ, ROS_PACKAGE_PATH='', ROCON_URI_RULES='')
    printed = subprocess.run(
        [sys.executable, 'scripts/rocon_uri'] + shlex.split(command), cwd=str(ROOT),
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        universal_newlines=True).stdout
    shown, cut, _ = output.partition('\n...')
    printed = printed.replace(str(ROOT), '~/catkin_ws/src/rocon_uri')
    if cut:
        assert printed.startswith(shown)
    else:
        assert printed.strip('\n') == shown


@pytest.mark.parametrize('page', PAGES[1:], ids=lambda page: page.name)
def test_the_examples_of_a_page_run(page):
    import doctest
    if page.name == 'databases.rst':
        pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')
    here = os.getcwd()
    os.chdir(str(ROOT))      # where its paths start
    try:
        failed, _ = doctest.testfile(str(page), module_relative=False, encoding='utf-8')
    finally:
        os.chdir(here)
    assert not failed


def test_the_page_of_json_says_what_the_command_says():
    from rocon_uri.cli import VERBS
    from rocon_uri.cli.json_forms import json_forms
    page = re.sub('(?m)^   ', '', (ROOT / 'doc' / 'json.rst').read_text(encoding='utf-8'))
    assert page.endswith('\n' + json_forms(VERBS) + '\n'), 'run doc/make_json.py'


def test_the_page_of_values_has_the_vocabulary_that_comes_with_the_package(tmp_path):
    import importlib.util
    spec = importlib.util.spec_from_file_location('make_vocabulary',
                                                  str(ROOT / 'doc' / 'make_vocabulary.py'))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.PAGE.read_text(encoding='utf-8') == module.vocabulary_page(), (
        'run doc/make_vocabulary.py')


def test_the_page_on_performance_shows_the_figures_that_were_written_down():
    import json
    import runpy
    sys.path.insert(0, str(ROOT / 'benchmark'))
    try:
        drawn = runpy.run_path(str(ROOT / 'benchmark' / 'picture.py'))
    finally:
        sys.path.pop(0)
    found = json.loads((ROOT / 'doc' / 'performance.json').read_text(encoding='utf-8'))
    picture = (ROOT / 'doc' / 'pictures' / 'performance.svg').read_text(encoding='utf-8')
    assert picture == drawn['picture'](found), 'run benchmark/picture.py'
    page = (ROOT / 'doc' / 'performance.rst').read_text(encoding='utf-8')
    assert drawn['machine_of'](found) in ' '.join(page.split())


def test_sphinx_builds_it_without_a_warning(tmp_path):
    pytest.importorskip('sphinx')
    pytest.importorskip('sqlalchemy', reason='SQLAlchemy is not installed')
    built = subprocess.run(
        [sys.executable, '-m', 'sphinx', '-q', '-W', '--keep-going', 'doc', str(tmp_path)],
        cwd=str(ROOT), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    assert built.returncode == 0, built.stdout
    assert (tmp_path / 'index.html').exists()
    pages = {path.name: path.read_text(encoding='utf-8') for path in tmp_path.glob('*.html')}
    assert 'The hardware, as' in pages['api.html']      # what only __slots__ says
    for name, text in pages.items():
        assert not re.search('&lt;[^&]*object(&gt;| at 0x)', text), name     # as a default
        for page, anchor in re.findall(r'href="(\w+\.\w+)(?:#([^"]*))?"', text):
            assert page in pages, (name, page)
            assert not anchor or 'id="%s"' % anchor in pages[page], (name, page, anchor)


@pytest.mark.parametrize('link', sorted(set(re.findall(
    r'\]\(([^)#]+\.rst)', PAGES[0].read_text(encoding='utf-8')))))
def test_a_page_that_readme_links_to_reads_well_without_sphinx(link):
    """As a code host renders it: no directive or role of Sphinx's own, no file that is included."""
    core = pytest.importorskip('docutils.core')
    path, messages = ROOT / link, io.StringIO()
    core.publish_doctree(path.read_text(encoding='utf-8'), source_path=str(path),
                         settings_overrides={'report_level': 2, 'warning_stream': messages,
                                             'halt_level': 5, 'file_insertion_enabled': False,
                                             'syntax_highlight': 'none'})       # needs Pygments
    assert messages.getvalue() == ''
    for page in re.findall(r'<(\w+\.rst)(?:#.*)?>`__', path.read_text(encoding='utf-8')):
        assert (path.parent / page).is_file(), page


@pytest.mark.parametrize('page, shown', [
    ('capability_specs', 'test/unit/specs/interfaces/RGBCamera.yaml'),
    ('capability_specs', 'test/unit/specs/providers/navigation_nav_stack.yaml'),
    ('capability_specs', 'test/specs/semantic_interfaces/FrontRGBCamera.yaml'),
    ('rocon_uris', 'msg/RoconURI.msg'),
    ('rocon_uris', 'the grammar')])
def test_a_page_shows_a_file_as_it_is(page, shown):
    from rocon_uri.grammar import EBNF
    text = EBNF if shown == 'the grammar' else (ROOT / shown).read_text(encoding='utf-8')
    text = textwrap.indent(text.strip('\n'), '   ')
    assert '\n\n%s\n' % text in (ROOT / 'doc' / (page + '.rst')).read_text(encoding='utf-8')
