"""
What happens when there is ten times as much, and ten times that: by which power the time grows.

With the power of 1, ten times as much takes ten times as long. The power is the slope of the line
through the three times, both axes logarithmic. The time is that of the processor, without the
collection of garbage, and the least of some rounds, in each of which every size has its turn.
"""
import logging
import math
import os
import tempfile

from fleet import fleet
from measure import once, with_unit
from packages_with_specs import make_packages

from capabilities.discovery import (
    package_index_from_package_path, spec_file_index_from_package_index,
    spec_index_from_spec_file_index)
from capabilities.planning.providers import find_cycles
from capabilities.spec_index import SpecIndex
from capabilities.specs.interface import capability_interface_from_string
from capabilities.specs.provider import capability_provider_from_string
from rocon_uri import ResourceIndex, parse
from rocon_uri.lint import check_packages
from rocon_uri.workspace import read_workspace

POWER = 1.1
ROUNDS = 5
SIZES = 10000, 100000, 1000000
REQUESTS = ('values', 'rocon:/robot/*/noetic/ubuntu'), ('a name', 'rocon:/*/cybernetic_*')
TOPICS = 'name: Camera\nspec_version: 1\nspec_type: interface\ninterface:\n  topics:\n%s'
CHAIN = 'name: p%d\nspec_version: 1\nspec_type: provider\nimplements: p/C%d\ndepends_on: [p/C%d]\n'


def figures():
    """What this part measures."""
    logging.getLogger('capabilities').addHandler(logging.NullHandler())
    yield growth('parse: texts', SIZES, fleet, parse_all)
    yield from of_an_index()
    yield from of_a_database()
    yield from of_specs()
    yield from of_packages()


def of_an_index():
    """Making one, and asking for what there is the more of, the larger it is."""
    yield growth('index: robots', SIZES, lambda size: list(map(parse, fleet(size))), ResourceIndex)
    indexes = {size: ResourceIndex(fleet(size)) for size in SIZES}
    for kind, request in REQUESTS:
        yield growth_of_matches('index: matches of ' + kind, indexes, request)


def of_a_database():
    """The same in SQLite."""
    try:
        from rocon_uri.resource_database import ResourceDatabase, open_engine, register
    except ImportError as error:
        print('left out: %s' % error)
        return

    def filled(texts):
        file, path = tempfile.mkstemp('.db', dir=folder)
        os.close(file)
        engine = open_engine('sqlite:///' + path)
        register(engine)
        database = ResourceDatabase(engine)
        database.add_all(texts)
        return database

    sizes = 1000, 10000, 100000
    with tempfile.TemporaryDirectory() as folder:
        yield growth('database: robots, in SQLite', sizes, fleet, filled, 3)
        databases = {size: filled(fleet(size)) for size in sizes}
        for kind, request in REQUESTS:
            yield growth_of_matches('database: matches of ' + kind, databases, request)


def of_specs():
    """One that has more and more in it, and more and more that need each other."""
    sizes = 50, 500, 5000
    yield growth('specs: topics of one', sizes, lambda size: TOPICS % ''.join(
        '    image_%d: {type: sensor_msgs/Image}\n' % number for number in range(size)),
        capability_interface_from_string)
    yield growth('specs: providers in a cycle', sizes, cycle, find_cycles)


def of_packages():
    """From packages to an index of specs and to findings."""
    sizes = 20, 200, 2000
    with tempfile.TemporaryDirectory() as folder:
        for size in sizes:
            make_packages(os.path.join(folder, str(size)), size)
            make_packages(os.path.join(folder, 'faulty', str(size)), size, 'package_%(next)d/Camra')
        yield growth('discovery: packages', sizes, lambda size: os.path.join(folder, str(size)),
                     discover, 3)
        yield growth('workspace: packages', sizes,
                     lambda size: [os.path.join(folder, str(size))], read_workspace, 3)
        yield growth('lint: packages', sizes,
                     lambda size: [os.path.join(folder, str(size))], check_packages, 3)
        yield growth('lint: packages with two faults', sizes,
                     lambda size: [os.path.join(folder, 'faulty', str(size))], check_packages, 3)


def parse_all(texts):
    """Read texts, none of which is known."""
    parse('rocon:/').vocabulary.uris_read.clear()
    for text in texts:
        parse(text)


def cycle(size):
    """The index of so many providers, each of which depends on what the next provides."""
    index = SpecIndex()
    for number in range(size):
        index.add_interface(capability_interface_from_string(
            'name: C%d\nspec_version: 1\nspec_type: interface\n' % number), 'file', 'p')
    for number in range(size):
        index.add_provider(capability_provider_from_string(
            CHAIN % (number, number, (number + 1) % size)), 'file', 'p')
    return index


def discover(folder):
    """An index of all specs in a folder."""
    return spec_index_from_spec_file_index(spec_file_index_from_package_index(
        package_index_from_package_path([folder])))


def growth_of_matches(name, indexes, request):
    """The figure of finding: what there is ten times as much of is what is found."""
    found = {size: index.count(request) for size, index in indexes.items()}
    by_found = {found[size]: index for size, index in indexes.items()}
    return growth(name, tuple(by_found), by_found.get, lambda index: sum(
        1 for _ in index.find(request)))


def growth(name, sizes, prepared, run, rounds=ROUNDS):
    """The figure of one thing, of which ``prepared(size)`` is what it is given."""
    given = [prepared(size) for size in sizes]
    times = [[once(run, one)[0] for one in given] for _ in range(rounds)]
    seconds = [min(column) for column in zip(*times)]
    return {'name': name, 'ratio': power(sizes, seconds), 'target': POWER,
            'sizes': sizes, 'times': seconds,
            'reference': 'the power of 1',
            'details': ', '.join('%s: %s' % (format(size, ','), with_unit(time))
                                 for size, time in zip(sizes, seconds))}


def power(sizes, seconds):
    """The slope of the line that is nearest to all of them, both axes logarithmic."""
    x, y = ([math.log(one) for one in values] for values in (sizes, seconds))
    middle_x, middle_y = sum(x) / len(x), sum(y) / len(y)
    return (sum((one - middle_x) * (other - middle_y) for one, other in zip(x, y))
            / sum((one - middle_x) ** 2 for one in x))
