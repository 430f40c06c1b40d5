"""What makes bad input of good: texts and trees of data, damaged here and there."""
from __future__ import annotations

import copy
import os
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = [ROOT / 'examples', ROOT / 'test/specs', ROOT / 'test/unit', ROOT / 'test/workspace']
if os.environ.get('ROCON_URI_CORPUS'):
    FOLDERS.append(Path(os.environ['ROCON_URI_CORPUS']))

#: what has a meaning in YAML
YAML_TOKENS = [
    '{', '}', '[', ']', ': ', '? ', '- ', '&a ', '*a', '<<: *a', '!!str ', '!a ', '|\n', '"', "'",
    '#', '%', '---\n', '\n', '\n  ', '\t', '\0', '\x85', '\u2028', '\\', '~', 'yes', '=']


def files(*patterns):
    """The good files whose names are like one of these, of the project and of the corpus."""
    return sorted(path for folder in FOLDERS for pattern in patterns
                  for path in folder.rglob(pattern) if path.is_file())


def damaged(rng, text, tokens):
    """
    A text in which here and there something is left out, put in or repeated.

    :param random.Random rng: decides what
    :param text: str or bytes
    :param tokens: sequence of the same, what has a meaning in such texts
    """
    for _ in range(rng.choice((0, 1, 1, 1, 2, 2, 3, 4, 8))):
        start = rng.randint(0, len(text))
        end = min(len(text), start + rng.choice((0, 0, 1, 2, 5, 20)))
        change = rng.randrange(6)
        if change == 0:
            inserted = text[:0]
        elif change == 1:
            inserted = rng.choice(tokens) * rng.choice((2, 3, 30, 260))
        elif change == 2:
            other = rng.randint(0, len(text))
            inserted = text[other:other + rng.choice((1, 5, 20, 100))]
        else:
            inserted = rng.choice(tokens)
        text = text[:start] + inserted + text[end:]
    return text


def damaged_yaml(rng, text, tree, scalars):
    """
    A text of YAML that is damaged as a text or as data.

    :param random.Random rng: decides what
    :param str text: a good one
    :param tree: what it says
    :param scalars: sequence of what else to put in
    """
    if rng.random() < 0.5:
        return yaml.safe_dump(damaged_tree(rng, tree, scalars),
                              default_flow_style=rng.choice((None, True, False)))
    return damaged(rng, text, YAML_TOKENS + [
        scalar for scalar in scalars if isinstance(scalar, str)])


def damaged_tree(rng, tree, scalars):
    """
    Nested data in which here and there something is dropped, replaced, renamed, added or moved.

    :param random.Random rng: decides what
    :param tree: dict or list, is not changed
    :param scalars: sequence of what else to put in, as keys and as values
    """
    tree = copy.deepcopy(tree)
    for _ in range(rng.choice((0, 1, 1, 1, 2, 2, 3, 5))):
        nodes = [node for node in _nodes(tree) if isinstance(node, (dict, list)) and node]
        if not nodes:
            break
        node = rng.choice(nodes)
        key = rng.choice(list(node) if isinstance(node, dict) else range(len(node)))
        change = rng.choice(('drop', 'replace', 'rename', 'add', 'move'))
        if change == 'drop':
            del node[key]
        elif change == 'replace':
            node[key] = _value(rng, scalars)
        elif change == 'move':
            node[key] = copy.deepcopy(rng.choice(list(_nodes(tree))))
        elif isinstance(node, list):
            node.insert(key, _value(rng, scalars))
        else:
            node[rng.choice(scalars)] = (node.pop(key) if change == 'rename'
                                         else _value(rng, scalars))
    return tree


def _value(rng, scalars):
    kind = rng.randrange(8)
    if kind == 0:
        return [_value(rng, scalars) for _ in range(rng.randrange(3))]
    if kind == 1:
        return {rng.choice(scalars): _value(rng, scalars) for _ in range(rng.randrange(3))}
    return rng.choice(scalars)


def _nodes(tree):
    yield tree
    for below in tree.values() if isinstance(tree, dict) else (
            tree if isinstance(tree, list) else ()):
        yield from _nodes(below)
