"""The fleet report of ``apps --html``: robots by apps, with all reasons."""
from __future__ import annotations

from typing import Dict, Iterator, List

from rocon_uri.apps.runnable import (
    WITH_NEAR_MISSES, App, Reason, ReasonKind, platform_uri, runnable)
from rocon_uri.cli.fleet_report import Column, FleetReport, write_fleet
from rocon_uri.cli.given import GivenURI
from rocon_uri.cli.judged import read_robot
from rocon_uri.cli.packages import PackageReport, shown_path
from rocon_uri.workspace import Workspace

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

__all__ = ['write_app_report']


def write_app_report(args: argparse.Namespace, apps: List[App], exported: Workspace,
                     defaults: Dict[str, str], report: PackageReport) -> bool:
    """
    Write the page of --html.

    :param args: those of the verb
    :param apps: list of `App`, those that are judged; virtual ones are left out
    :param Workspace exported: what the robots have
    :param defaults: dict of the default providers by interface
    :param report: is told what is bad
    :returns: bool, is there a robot that can run an app?
    """
    apps = [app for app in apps if app.is_implementation]
    # a column without a URI is one whose platform does not matter
    is_ignored = ReasonKind.PLATFORM.value in args.ignore
    uris = [None if is_ignored else platform_uri(app, exported.vocabulary) for app in apps]
    fleet = FleetReport([Column(label=app.name, about=_about(app), uri=uri)
                         for app, uri in zip(apps, uris)],
                        'robots', 'apps')
    same: Dict[str, List[str]] = {}     # the reasons that are those of all robots, by file
    for robot in _robots(args, exported, report):
        against: List[List[str]] = []
        for app, uri in zip(apps, uris):
            if app.path not in same or uri is None and not is_ignored:
                reasons = runnable(app, robot.uri, exported.spec_index, defaults,
                                   exported.launch_files, args.ignore, args.robot_type,
                                   near_misses=len(same) < WITH_NEAR_MISSES).reasons
                same[app.path] = [_line(reason) for reason in reasons
                                  if uri is None or reason.kind is not ReasonKind.PLATFORM]
            against.append(same[app.path])
        fleet.add(robot.text, robot.uri, against)
    write_fleet(fleet, 'What robots can run', args.html, report)
    return fleet.found


def _robots(args: argparse.Namespace, exported: Workspace, report: PackageReport
            ) -> Iterator[GivenURI]:
    """The robots that are given; one that is not registered is reported, and judged."""
    if args.robots_in is not None:
        yield from report.read_file(args.robots_in, exported.vocabulary)
        return
    robot = read_robot(args.robot, exported.vocabulary, report)
    if robot is not None:
        yield robot


def _about(app: App) -> str:
    return ': '.join(text for text in (app.display, app.description) if text) + (
        ' (%s)' % shown_path(app.path))


def _line(reason: Reason) -> str:
    return '%s [%s]' % (reason, reason.id)
