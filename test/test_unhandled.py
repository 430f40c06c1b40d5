"""An exception that ends a thread, or is raised in a __del__, fails the run."""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

THREAD = '''
import threading
def test_that_passes():
    thread = threading.Thread(target=lambda: [].pop())
    thread.start()
    thread.join()
'''

FINALIZER = '''
class Thing:
    def __del__(self):
        raise ValueError('of a finalizer')
def test_that_passes():
    Thing()
'''

AT_THE_END = '''
import pytest
class Thing:
    def __del__(self):
        raise ValueError('of a finalizer')
@pytest.fixture(scope='session', autouse=True)
def thing():
    yield
    Thing()
def test_that_passes(thing):
    pass
'''


ENVIRONMENT = {name: value for name, value in os.environ.items() if name != 'PYTEST_ADDOPTS'}


@pytest.mark.parametrize('test, said', [
    (THREAD, 'pop from empty list'), (FINALIZER, 'of a finalizer'),
    (AT_THE_END, 'of a finalizer')])
def test_what_nobody_handles_fails_the_run(tmp_path, test, said):
    (tmp_path / 'conftest.py').write_text(
        (Path(__file__).parent / 'conftest.py').read_text())
    (tmp_path / 'test_it.py').write_text(test)
    done = subprocess.run(
        [sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', str(tmp_path)],
        cwd=str(tmp_path), env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        universal_newlines=True)
    assert done.returncode and said in done.stdout


def test_what_is_handled_does_not(tmp_path):
    (tmp_path / 'conftest.py').write_text(
        (Path(__file__).parent / 'conftest.py').read_text())
    (tmp_path / 'test_it.py').write_text(THREAD.replace('[].pop()', '[]'))
    subprocess.run([sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', str(tmp_path)],
                   cwd=str(tmp_path), env=ENVIRONMENT, stdout=subprocess.DEVNULL, check=True)
