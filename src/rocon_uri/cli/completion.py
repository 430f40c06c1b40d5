"""What the shell offers for an argument, through argcomplete: URIs, and names of apps and specs."""
from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Callable, List
    from rocon_uri.workspace import Workspace

__all__ = ['app_names', 'offer', 'spec_names', 'uris']

_SCHEME = 'rocon:/'


def offer(completer: Callable[..., List[str]], *arguments: argparse.Action) -> None:
    """Let the shell offer what a function returns, for each of some arguments."""
    for argument in arguments:
        argument.completer = completer  # type: ignore[attr-defined]    # for argcomplete


def uris(prefix: str, **_: object) -> List[str]:
    """
    The URIs that go on from a text by one value.

    >>> uris('rocon:/turtlebot2|pr')
    ['rocon:/turtlebot2|pr2']
    >>> uris('roc')
    ['rocon:/']
    """
    if not prefix.startswith(_SCHEME):
        return [_SCHEME] if _SCHEME.startswith(prefix) else []
    from rocon_uri.grammar import VOCABULARY_FIELDS
    from rocon_uri.vocabulary import complete
    before, _slash, field = prefix.rpartition('/')
    position = before.count('/') - (2 if prefix.startswith('rocon://') else 0)
    fields = dict(zip((0, 2, 3), VOCABULARY_FIELDS))
    if position not in fields:
        return []
    written, bar, value = field.rpartition('|')
    return ['%s/%s%s%s' % (before, written, bar, registered)
            for registered in complete().field(fields[position]) if registered.startswith(value)]


def app_names(parsed_args: argparse.Namespace, **_: object) -> List[str]:
    """The names of the apps on the package path."""
    return [app.name for app in _workspace(parsed_args).apps()]


def spec_names(parsed_args: argparse.Namespace, **_: object) -> List[str]:
    """The names of the capability specs on the package path."""
    return _workspace(parsed_args).spec_index.names


def _workspace(args: argparse.Namespace) -> Workspace:
    import os
    from rocon_uri.workspace import read_workspace
    given = getattr(args, 'package_path', None)
    text = os.environ.get('ROS_PACKAGE_PATH', '') if given is None else os.pathsep.join(given)
    return read_workspace([folder for folder in text.split(os.pathsep) if folder])
