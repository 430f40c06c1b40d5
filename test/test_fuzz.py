"""A short run of every target of test/fuzz; and what finds faults there does find them."""
from __future__ import annotations

import os
import signal
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest
from built import built
from fuzz import batch
from fuzz.batch import run_batch

INPUTS = {'uri': 400, 'name_pattern': 400, 'spec_file': 200, 'rapp_file': 60, 'app_file': 60,
          'interactions': 60, 'rules_file': 60, 'launch_file': 80, 'package_exports': 80,
          'message': 200, 'server_requests': 60,
          'directory': 60}


@pytest.mark.parametrize('name', batch.TARGETS)
def test_damaged_input_is_answered_as_documented(name):
    if name == 'message':
        pytest.importorskip('genpy', reason='messages need ROS')
    if name == 'server_requests':
        built('capabilities.srv')
    if name in ('rapp_file', 'app_file', 'interactions', 'rules_file', 'launch_file',
                'package_exports'):
        pytest.importorskip('catkin_pkg')
    tried, fault = run_batch(import_module('fuzz.' + name), 1, INPUTS[name])
    assert not fault, fault
    assert tried == INPUTS[name]


def target(check):
    """A target whose inputs are lists of digits."""
    return SimpleNamespace(check=check, make=lambda rng: [
        rng.choice('0123456789') for _ in range(rng.randrange(10))])


def raise_if_seven_comes_first(numbers):
    assert numbers[:1] != ['7'], 'seven first'


def die_of_seven(numbers):
    if numbers[:1] == ['7']:
        os.kill(os.getpid(), signal.SIGKILL)


def never_finish(numbers):
    while numbers[:1] == ['7']:
        pass


def take_memory(numbers):
    if numbers[:1] == ['7']:
        bytearray(batch.MEMORY)


@pytest.mark.parametrize('check, message', [
    (raise_if_seven_comes_first, 'AssertionError: seven first'),
    (never_finish, 'TooSlow: more than 0.1 s'),
    (take_memory, 'MemoryError')])
def test_a_fault_is_shown_by_the_smallest_input(check, message, monkeypatch):
    monkeypatch.setattr(batch, 'SECONDS', 0.1)
    tried, fault = run_batch(target(check), 5, 1000)
    assert 0 < tried < 1000
    assert fault.startswith("the input that shows it:\n['7']\n")
    assert message in fault


def test_an_input_that_ends_the_process_is_shown_as_it_was_made():
    tried, fault = run_batch(target(die_of_seven), 5, 1000)
    assert 0 < tried < 1000
    assert fault.startswith("the input that shows it:\n['7'")
    assert fault.endswith('the process ended with -9')


def test_no_fault_is_made_up():
    assert run_batch(target(lambda numbers: None), 5, 100) == (100, '')


def test_a_seed_gives_the_same_inputs_again():
    def faults(seed):
        return run_batch(target(raise_if_seven_comes_first), seed, 1000)
    assert faults(5) == faults(5)
    assert len({faults(seed)[0] for seed in range(5)}) > 1


def test_the_command_says_what_it_tried():
    done = subprocess.run(
        [sys.executable, str(Path(batch.__file__).parent), '--target', 'uri', '--seed', '3',
         '--seconds', '0'], stdout=subprocess.PIPE, universal_newlines=True)
    assert done.returncode == 0
    assert done.stdout.startswith('uri: 500 inputs in ')
    assert done.stdout.endswith(' s, seeds 3 to 3: no fault\n')
