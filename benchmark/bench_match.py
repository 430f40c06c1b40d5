"""The verb match on a file of robots, beside a loop of parse and is_compatible over its lines."""
import contextlib
import os
import tempfile

from measure import once

from rocon_uri import is_compatible, parse
from rocon_uri.cli import main

LINES = 100000
FORM = 'rocon:/%s/cybernetic_%06d/noetic/focal'
REQUEST = 'rocon:/turtlebot2|pr2/%s/ros/ubuntu'

#: what is said of them, the requests, how many of them the loop compares, the target
CASES = [
    ('1 request that all fit, so that all are printed', [REQUEST % '*'], 1, 1.15),
    ('1 request for names', [REQUEST % 'cybernetic_*7'], 1, 1.15),
    ('1 request that nothing fits', ['rocon:/kobuki/*/ros'], 1, 1.15),
    ('8 requests that nothing fits', ['rocon:/kobuki/*/ros'] * 8, 8, 1.15),
    ('100 requests that nothing fits', ['rocon:/kobuki/*/ros'] * 100, 8, 1.15),
    ('100 requests for one name each', [REQUEST % ('cybernetic_%06d' % n) for n in range(100)], 8,
     1.15)]


def figures():
    """What this part measures."""
    with tempfile.TemporaryDirectory() as folder:
        for platform in ('turtlebot2', 'not_registered'):
            with open(os.path.join(folder, platform), 'w') as file:
                file.writelines(FORM % (platform, number) + '\n' for number in range(LINES))
        robots = [FORM % ('turtlebot2', number) for number in range(LINES)]
        for name, requests, compared, target in CASES:
            yield figure(name, os.path.join(folder, 'turtlebot2'), robots, requests, compared,
                         target)
        yield figure('a value that is not registered on every line, 1 request',
                     os.path.join(folder, 'not_registered'), robots, [REQUEST % '*'], 1, 1.15)


def figure(name, path, robots, requests, compared, target):
    """How long a line takes in the verb and in the loop, whichever of five goes is the fastest."""
    times = [(once(match, path, requests)[0], once(loop, robots, requests[:compared])[0])
             for _ in range(5)]
    seconds, reference = (min(column) / LINES for column in zip(*times))
    return {'name': 'match, %d lines, %s' % (LINES, name), 'ratio': seconds / reference,
            'target': target, 'seconds': seconds, 'reference_seconds': reference,
            'reference': 'a loop of parse and is_compatible with %d of them' % compared}


def match(path, requests):
    """Run the verb, and print to nowhere."""
    with open(os.devnull, 'w') as out, open(os.devnull, 'w') as err, \
            contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        main(['match', *requests, '--in', path])


def loop(robots, requests):
    """The same without the verb."""
    asked = list(map(parse, requests))
    for robot in robots:
        uri = parse(robot)
        for request in asked:
            is_compatible(request, uri)
