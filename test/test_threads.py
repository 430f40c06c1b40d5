"""Threads that read and compare while the vocabulary grows get right answers only."""
from __future__ import annotations

import os
import subprocess
import sys

from sources import SOURCE

# Each thread starts with what is bundled and meets a value that is not, at the same time.
CODE = '''
import faulthandler, sys, threading
faulthandler.dump_traceback_later(100, exit=True)       # where it stands still, it says so
from concurrent.futures import ThreadPoolExecutor
opened = []
sys.addaudithook(lambda event, arguments: opened.append(arguments[0])
                 if event == 'open' and 'robots.json' in str(arguments[0]) else None)
import rocon_uri
from rocon_uri import RoconURIValueError, Vocabulary, is_compatible, parse, relation
sys.setswitchinterval(1e-5)     # with less, a busy machine may do nothing but switch

def answer(function, *arguments):
    try:
        return str(function(*arguments))
    except RoconURIValueError as error:
        return error.field, error.value, str(error)

def questions(number):
    for text in ('rocon:/pr2/bob', 'rocon:/robot/*/ros', 'rocon://bender/bob', 'rocon:/bender|pr2',
                 'rocon://north/flexo', 'rocon:/nobody', 'rocon:/pr2|', 'rocon:/pr2/bob_[0-9]+',
                 'rocon:/pr2/unique_%d' % number, 'rocon:/mobile_device'):
        yield parse, text
        yield is_compatible, 'rocon:/robot', text
        yield is_compatible, text, 'rocon:/'
        yield relation, text, 'rocon:/robot|calculon'
        yield lambda: parse(text).hardware_platform.expand(),
        yield lambda: 'bender' in parse(text).hardware_platform,
        yield lambda: parse(text).short,

THREADS = 16
together = threading.Barrier(THREADS)

def ask(number):
    together.wait()
    return [[answer(*question) for question in questions(number)] for _ in range(5)]

with ThreadPoolExecutor(THREADS) as pool:
    answers = list(pool.map(ask, range(THREADS)))       # raises what a thread raises

for number in range(THREADS):
    expected = [answer(*question) for question in questions(number)]     # by one thread, afterwards
    for got in answers[number]:
        for ours, right, question in zip(got, expected, questions(number)):
            assert ours == right, (question, ours, right)
assert parse('rocon://bender/bob').name.string == 'bob'
assert answer(parse, 'rocon:/nobody')[1] == 'nobody'
assert len(opened) == 1, opened
'''


def test_threads_that_meet_the_first_unknown_value_together_agree(tmp_path):
    rules = tmp_path / 'robots.json'
    rules.write_text('{"hardware_platform": {"robot": ["bender", "flexo"], "phone": ["calculon"]}}')
    for _ in range(3):
        done = subprocess.run(
            [sys.executable, '-c', CODE], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            universal_newlines=True, timeout=120, env=dict(
                {name: value for name, value in os.environ.items()
                 if not name.startswith('COV_CORE')},       # tracing sixteen threads takes long
                PYTHONPATH=str(SOURCE), ROCON_URI_RULES=str(rules),
                ROS_PACKAGE_PATH=str(tmp_path)))
        assert done.returncode == 0, done.stdout
        assert done.stdout == ''
