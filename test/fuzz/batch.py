"""
One batch of inputs for a target: hypothesis makes them from a seed, in a process of its own.

A target is a module with two functions: ``make`` takes a `random.Random`, of which hypothesis
decides what it answers, and returns an input; ``check`` takes one and raises what is wrong.
"""
from __future__ import annotations

import logging
import multiprocessing
import random
import resource
import signal
import tempfile
import traceback

import hypothesis
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

TARGETS = ('uri', 'name_pattern', 'spec_file', 'rapp_file', 'app_file', 'interactions',
           'rules_file', 'launch_file', 'package_exports', 'message', 'server_requests',
           'directory')

LOGGERS = ('capabilities', 'catkin_pkg', 'rosout')      # of what is damaged they say a lot

SECONDS = 10            # of the processor, for one input
MEMORY = 2 << 30        # bytes of addresses, for the whole process


class TooSlow(Exception):
    """An input that takes longer than any should."""


class Drawn(random.Random):
    """What hypothesis draws, as random numbers; its own are not in the version of Ubuntu 20.04."""

    def __init__(self, draw):
        super().__init__()
        self._draw = draw

    def random(self):
        return self.getrandbits(24) / (1 << 24)     # of larger ones hypothesis prefers the small

    def getrandbits(self, bits):
        return self._draw(st.integers(0, (1 << bits) - 1))


def run_batch(target, seed, inputs):
    """
    Try some inputs, up to the first that shows a fault, and look for a smaller one that does.

    :param target: the module
    :param int seed: the same one gives the same inputs
    :param int inputs: how many
    :returns: (int, str): how many were tried, and the fault with the smallest input that shows it,
        '' for none
    """
    context = multiprocessing.get_context('fork')   # the process has what is imported here
    tried = context.Value('q', 0, lock=False)
    receiver, sender = context.Pipe(duplex=False)
    # what is tried is in a file, so that it is known whatever happens to the process
    with tempfile.TemporaryFile('w+', encoding='ascii') as last:
        process = context.Process(target=_run, args=(target, seed, inputs, tried, last, sender))
        process.start()
        sender.close()
        try:
            fault = receiver.recv()
        except EOFError:
            process.join()
            fault = 'the process ended with %d' % process.exitcode
        process.join()
        last.seek(0)
        return tried.value, fault and 'the input that shows it:\n%s\n%s' % (last.read(), fault)


def _run(target, seed, inputs, tried, last, sender):
    for name in LOGGERS:
        logging.getLogger(name).setLevel(logging.CRITICAL)

    @st.composite
    def an_input(draw):
        return target.make(Drawn(draw))

    @hypothesis.seed(seed)
    @settings(max_examples=inputs, deadline=None, database=None, report_multiple_bugs=False,
              phases=[Phase.generate, Phase.shrink], suppress_health_check=list(HealthCheck))
    @given(an_input())
    def check_one(made):
        last.seek(0)
        last.truncate()
        last.write(ascii(made))
        last.flush()
        tried.value += 1
        signal.setitimer(signal.ITIMER_PROF, SECONDS)   # a busy machine is no fault
        try:
            target.check(made)
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGPROF, _stop)
    try:
        check_one()
    except Exception:       # whatever it is, it is a fault
        sender.send(traceback.format_exc())
    else:
        sender.send('')


def _stop(signal_number, frame):
    raise TooSlow('more than %s s' % SECONDS)
