"""The documentation is true: Sphinx builds it, and its commands print what it says they print."""
import os
import re
import shlex
import subprocess
import sys

import pytest

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGES = ['README.md'] + sorted(
    os.path.join('doc', name) for name in os.listdir(os.path.join(ROOT, 'doc'))
    if name.endswith('.rst'))


def commands():
    """Each command shown on a page, with the output below it."""
    for page in PAGES:
        with open(os.path.join(ROOT, page), encoding='utf-8') as lines:
            text = lines.read()
        for match in re.finditer(r'^( +)\$ rosrun rocon_uri rocon_uri (.*)\n((?:\1(?!\$).*\n|\n)*)',
                                 text, re.MULTILINE):
            indent, command, output = match.groups()
            output = re.sub('^' + indent, '', output, flags=re.MULTILINE)
            yield pytest.param(command, output.strip('\n'), id='%s: %s' % (page, command))


@pytest.mark.parametrize('command, output', list(commands()))
def test_a_command_prints_what_the_page_says(command, output):
    environment = dict(os.environ, ROS_PACKAGE_PATH='', ROCON_URI_RULES='')
    printed = subprocess.run(
        [sys.executable, 'scripts/rocon_uri'] + shlex.split(command), cwd=ROOT, env=environment,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True).stdout
    shown, cut, _ = output.partition('\n...')
    printed = printed.replace(ROOT, '~/catkin_ws/src/rocon_uri')
    if cut:
        assert printed.startswith(shown)
    else:
        assert printed.strip('\n') == shown


@pytest.mark.parametrize('page', [page for page in PAGES if page.endswith('.rst')])
def test_the_examples_of_a_page_run(page):
    import doctest
    here = os.getcwd()
    os.chdir(ROOT)      # where its paths start
    try:
        failed, _ = doctest.testfile(os.path.join(ROOT, page), module_relative=False,
                                     encoding='utf-8')
    finally:
        os.chdir(here)
    assert not failed


def test_sphinx_builds_it_without_a_warning(tmp_path):
    pytest.importorskip('sphinx')
    built = subprocess.run(
        [sys.executable, '-m', 'sphinx', '-q', '-W', '--keep-going', 'doc', str(tmp_path)],
        cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    assert built.returncode == 0, built.stdout
    assert (tmp_path / 'index.html').exists()
