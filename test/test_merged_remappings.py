"""The remappings of a capability that runs, through all that it depends on."""
from types import SimpleNamespace

import pytest

from capabilities.instances import CapabilityInstance
from capabilities.merged_remappings import merged_remappings, with_dependencies
from capabilities.specs.provider import CapabilityProvider


def provider(topics=None, **kinds):
    return CapabilityProvider('p', 1, 'p/I', remappings={'topics': topics or {}, **kinds})


@pytest.mark.parametrize('below_first, merged', [
    ([], {}),
    ([{'a': 'b'}], {'a': 'b'}),
    ([{'distance': 'robot/front/distance'}, {'front/distance': 'distance'}],
     {'front/distance': 'robot/front/distance'}),
    ([{'c': 'd'}, {'b': 'c'}, {'a': 'b'}], {'a': 'd'}),
    ([{'a': 'b'}, {'c': 'd'}], {'a': 'b', 'c': 'd'}),
    ([{'x': 'y'}, {'one': 'x', 'two': 'x'}], {'one': 'y', 'two': 'y'}),
    ([{'a': 'b'}, {'b': 'c'}], {'a': 'b', 'b': 'c'}),       # what is above changes nothing below
    ([{'a': 'b'}, {'a': 'a'}], {'a': 'b'}),
])
def test_chains_are_followed_and_names_between_are_left_out(below_first, merged):
    assert merged_remappings([provider(topics) for topics in below_first])['topics'] == merged


def test_each_kind_is_for_itself():
    merged = merged_remappings([provider({'a': 'b'}), provider({}, services={'c': 'a'})])
    assert merged == {'topics': {'a': 'b'}, 'services': {'c': 'a'}, 'actions': {}, 'parameters': {}}


def test_dependencies_come_first_and_once():
    def instance(name, *dependencies):
        one = CapabilityInstance(
            SimpleNamespace(name=name, implements=name, dependencies=()), '/x.yaml')
        one.dependencies = list(dependencies)
        return one
    base = instance('base')
    layer = [instance('left', base), instance('right', base)]
    for number in range(40):        # layers of diamonds, which are 2 ** 40 paths
        layer = [instance('left %d' % number, *layer), instance('right %d' % number, *layer)]
    names = [one.name for one in with_dependencies(layer[0])]
    assert len(names) == len(set(names)) == 2 + 2 * 40
    assert names[0] == 'base' and names[-1] == 'left 39'
