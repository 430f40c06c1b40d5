"""
Show the URI of this machine.

Examples:
  rocon_uri platform
  rocon_uri platform --robot-type turtlebot2 --robot-name 'Cybernetic Pirate'

Type and name are made legal. The application framework is that of ROS_DISTRO, or
ros_other; a note says so if the /rosdistro of a running master is another one. The
operating system is the nearest one that is registered.

Exit status: 0; 2 for an unregistered type, though the URI is still printed, and
for an empty type or name
JSON: {"uris": [URI], "errors": [ERROR, ...]}
"""
from __future__ import annotations

import argparse
import os

from rocon_uri.cli.display import print_json
from rocon_uri.cli.given import GivenURI, Report, say
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.platform import (
    default_robot_name, default_robot_type, generate_platform_rocon_uri)
from rocon_uri.sources.wording import quoted
from rocon_uri.uri import parse
from rocon_uri.vocabulary import Vocabulary, complete

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import List

__all__ = ['add_arguments', 'main']

_PATIENCE = 0.2     # seconds; a master that has not answered by then is none


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('--robot-type', metavar='TYPE', default=default_robot_type,
                        help='the hardware platform (default: %(default)s)')
    parser.add_argument('--robot-name', metavar='NAME',
                        help='what it is called (default: the name of the host)')


def main(args: argparse.Namespace) -> int:
    report = Report(args.json)
    uris = []
    try:
        name = default_robot_name() if args.robot_name is None else args.robot_name
        text = generate_platform_rocon_uri(args.robot_type, name)
        uris.append(GivenURI(parse(text, Vocabulary.open()), text))
        report.read(text)
    except RoconURIValueError as error:
        report.bad_uri(error)
    if args.json:
        print_json({'uris': [given.as_json() for given in uris], 'errors': report.errors})
    else:
        for given in uris:
            print(given.text)
    for given in uris:
        _mention_master(given.uri.application_framework.string)
    return report.status


def _mention_master(taken: str) -> None:
    """Say it if a master runs that says another distribution than the environment."""
    ours = os.environ.get('ROS_DISTRO', '')
    theirs = _distribution_of_master()
    if theirs != ours and theirs in complete().field('application_framework'):
        say('rocon_uri: note: %s is taken, since ROS_DISTRO is %s; /rosdistro of the master is %s'
            % (quoted(taken), quoted(ours) if ours else 'not set', quoted(theirs)))


def _distribution_of_master() -> str:
    """The parameter /rosdistro of the master, '' if there is no master or none that answers."""
    from threading import Thread    # here, since they are slow to import
    from xmlrpc.client import ServerProxy
    answers: List[str] = []

    def ask() -> None:
        uri = os.environ.get('ROS_MASTER_URI') or 'http://localhost:11311'
        try:
            with ServerProxy(uri) as master:
                answer = master.getParam('/rocon_uri', '/rosdistro')
            answers.append(str(answer[2]).strip())      # type: ignore[index]
        except Exception:       # what answers there is not a master
            answers.append('')
    asking = Thread(target=ask, daemon=True)    # looking up a host has no limit of its own
    asking.start()
    asking.join(_PATIENCE)
    return answers[0] if answers else ''
