"""
Times of several things taken in turn, so that what disturbs one disturbs the others too.

They are those of the processor: what other processes take on a busy machine is not in them.
"""
import gc
import time
import urllib.parse
from timeit import Timer

__all__ = ['best_times', 'once', 'uncached_urlsplit', 'with_unit']


def uncached_urlsplit():
    """
    What parsing and comparing is measured with.

    :returns: `urllib.parse.urlsplit`, the function below its cache if it has one
    """
    if hasattr(urllib.parse.urlsplit, '__wrapped__'):
        return urllib.parse.urlsplit.__wrapped__

    def urlsplit(text, clear=urllib.parse.clear_cache, split=urllib.parse.urlsplit):
        clear()
        return split(text)
    return urlsplit


def best_times(statements, names, number, repeat=15):
    """
    How long each statement takes at least, collection of garbage left out.

    :param statements: list of str
    :param names: dict, the names that are known in them
    :param int number: how often each is run in one go
    :param int repeat: how many goes, in each of which every statement has its turn
    :returns: list of float, seconds for one run
    """
    timers = [Timer(statement, timer=time.process_time, globals=names) for statement in statements]
    rounds = [[timer.timeit(number) / number for timer in timers] for _ in range(repeat)]
    return [min(times) for times in zip(*rounds)]


def once(function, *args, clock=time.process_time):
    """
    Call a function, with collection of garbage left out.

    :param function: callable
    :param args: what it is called with
    :param clock: callable, `time.process_time` or `time.perf_counter`
    :returns: (seconds, what it returns)
    """
    gc.collect()
    gc.disable()
    try:
        start = clock()
        result = function(*args)
        return clock() - start, result
    finally:
        gc.enable()


def with_unit(seconds):
    """
    A time that a person can read.

    :param float seconds: the time
    :returns: str
    """
    for unit, size in (('s', 1), ('ms', 1e-3), ('us', 1e-6)):
        if seconds >= size:
            return '%.3g %s' % (seconds / size, unit)
    return '%.3g ns' % (seconds / 1e-9)
