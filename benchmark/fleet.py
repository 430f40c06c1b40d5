"""A fleet of robots: seven platforms, four frameworks, five systems, a name for each robot."""
import random

__all__ = ['FRAMEWORKS', 'PLATFORMS', 'SYSTEMS', 'WORDS', 'fleet']

PLATFORMS = ['pr2', 'kobuki', 'turtlebot2', 'pc', 'tablet', 'galaxy', 'jackal']
FRAMEWORKS = ['indigo', 'kinetic', 'melodic', 'noetic']
SYSTEMS = ['trusty', 'xenial', 'bionic', 'focal', 'bookworm']
WORDS = ['%s%s' % (first, second)
         for first in ('', 'arm_', 'old_', 'cybernetic_', 'dock_', 'west_', 'x', 'my_', 'lab_',
                       'b_')
         for second in ('alice', 'bob', 'carol', 'dude', 'eve', 'fetchy', 'gina', 'hal', 'iris',
                        'jim', 'kit', 'leo', 'marvin', 'nora', 'otto', 'pirate', 'quinn', 'rosie',
                        'sam', 'trudy')]


def fleet(size):
    """
    The same each time: in random order, one in a hundred with alternatives, one in a thousand
    with a pattern, of which half are globs and half are fifty different regular expressions.

    :param int size: how many robots
    :returns: list of str, their URIs
    """
    chosen = random.Random(size)
    texts = []
    for number in range(size):
        platform, framework, system = map(chosen.choice, (PLATFORMS, FRAMEWORKS, SYSTEMS))
        name = '%s_%06d' % (chosen.choice(WORDS), number)
        if number % 200 == 1:
            platform = '|'.join(chosen.sample(PLATFORMS, 2))
        elif number % 200 == 101:
            system = '|'.join(chosen.sample(SYSTEMS, 2))
        elif number % 2000 == 2:
            name += '_*'
        elif number % 2000 == 1002:
            name = '%s_(left|right)[0-9]*' % chosen.choice(WORDS[:50])
        texts.append('rocon:/%s/%s/%s/%s' % (platform, name, framework, system))
    chosen.shuffle(texts)
    return texts
