"""
One batch of inputs for a target: made from a seed, tried in a process of its own, within bounds.

A target is a module with two functions: ``make`` takes a `random.Random` and returns an input, made
of texts, bytes, numbers, tuples, lists and dicts; ``check`` takes one and raises what is wrong.
"""
from __future__ import annotations

import multiprocessing
import random
import resource
import signal
import time
import traceback
from collections import namedtuple

TARGETS = ('uri', 'name_pattern', 'spec_file', 'rapp_file', 'package_exports', 'message')

SECONDS = 10            # of the processor, for one input
MEMORY = 2 << 30        # bytes of addresses, for the whole process
SHRINKING_SECONDS = 60

#: What is wrong: a short text that is the same for the same fault, and a long one.
Fault = namedtuple('Fault', 'kind text')


class TooSlow(Exception):
    """An input that takes longer than any should."""


def run_batch(target, seed, inputs):
    """
    Try some inputs, up to the first that shows a fault.

    :param target: the module
    :param int seed: the same one gives the same inputs
    :param int inputs: how many
    :returns: (int, str): how many were tried, and the fault with the smallest input that shows it,
        '' for none
    """
    def made(number):
        return target.make(random.Random('%d %d' % (seed, number)))

    tried, fault = attempt(target.check, map(made, range(inputs)))
    if fault is None:
        return tried, ''
    smallest = shrunk(target.check, made(tried - 1), fault)
    _, fault = attempt(target.check, [smallest])
    return tried, 'the smallest input that shows it:\n%r\n%s' % (smallest, fault.text)


def attempt(check, inputs):
    """
    Try inputs in a process of its own, so that whatever they do to it is found.

    :returns: (int, `Fault`): how many were tried, and the fault of the last one or None
    """
    context = multiprocessing.get_context('fork')   # the process has what is imported here
    tried = context.Value('q', 0, lock=False)
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_attempt, args=(check, inputs, tried, sender))
    process.start()
    sender.close()
    try:
        fault = receiver.recv()
    except EOFError:
        process.join()
        fault = Fault(str(process.exitcode), 'the process ended with %d' % process.exitcode)
    process.join()
    return tried.value, fault


def _attempt(check, inputs, tried, sender):
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGPROF, _stop)
    try:
        for given in inputs:
            tried.value += 1
            signal.setitimer(signal.ITIMER_PROF, SECONDS)   # a busy machine is no fault
            check(given)
            signal.setitimer(signal.ITIMER_PROF, 0)
    except Exception as error:      # whatever it is, it is a fault
        signal.setitimer(signal.ITIMER_PROF, 0)
        place = traceback.extract_tb(error.__traceback__)[-1]
        kind = type(error).__name__ if isinstance(error, (TooSlow, MemoryError)) else (
            '%s in line %s' % (type(error).__name__, place.lineno))
        sender.send(Fault(kind, traceback.format_exc()))
    else:
        sender.send(None)


def _stop(signal_number, frame):
    raise TooSlow('more than %s s' % SECONDS)


def shrunk(check, given, fault):
    """An input from which nothing can be left out without losing the fault."""
    end = time.monotonic() + SHRINKING_SECONDS
    shrinking = True
    while shrinking:
        shrinking = False
        for smaller in smaller_ones(given):
            found = attempt(check, [smaller])[1]
            if found is not None and found.kind == fault.kind:
                given, shrinking = smaller, True
                break
            if time.monotonic() > end:
                return given
    return given


def smaller_ones(given):
    """Inputs that have less in them, those with the least first."""
    if isinstance(given, dict):
        for key in given:
            yield {other: given[other] for other in given if other != key}
        for key in given:
            for smaller in smaller_ones(given[key]):
                yield {**given, key: smaller}
    if isinstance(given, (str, bytes, list)):
        step = len(given)
        while step:
            for start in range(0, len(given), step):
                yield given[:start] + given[start + step:]
            step //= 2
    if isinstance(given, (list, tuple)):
        for index, item in enumerate(given):
            for smaller in smaller_ones(item):
                yield given[:index] + type(given)([smaller]) + given[index + 1:]
