"""
Show the URI of this machine.

Examples:
  rocon_uri platform
  rocon_uri platform --robot-type turtlebot2 --robot-name 'Cybernetic Pirate'

Type and name are made legal. The application framework is that of ROS_DISTRO, or
ros_other. The operating system is the nearest one that is registered.

Exit status: 0; 2 for an unregistered type, though the URI is still printed, and
for an empty type or name
JSON: {"uris": [URI], "errors": [ERROR, ...]}
"""
from __future__ import annotations

import argparse

from rocon_uri.cli.display import print_json
from rocon_uri.cli.given import GivenURI, Report
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.platform import (
    default_robot_name, default_robot_type, generate_platform_rocon_uri)
from rocon_uri.uri import parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['add_arguments', 'main']


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
    return report.status
