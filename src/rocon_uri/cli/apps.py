"""
List the apps that a robot can run, and why not the others.

Examples:
  rocon_uri apps
  rocon_uri apps --robot rocon:/turtlebot2/bob/noetic/focal --all
  rocon_uri apps --package-path ~/catkin_ws/src --defaults defaults.yaml
  rocon_uri apps --all --ignore launch-missing

Reads all rapps and capability specs that the packages below PATH export, and
assumes that the robot has their providers. An app runs if the robot's URI is
compatible with it, and if its launch file and all capabilities that it requires
can be started. If several providers implement a capability, FILE says which to
take: a YAML mapping from interfaces to providers, on its own or as "defaults".
Each reason ends with its ID, which --ignore takes.

Exit status: 0 if an app runs; 1 if none does; 2 if the robot, a folder or a file
was bad, though the rest is judged, even for a robot that is not registered
JSON: {"robot": URI, "apps": [{"name", "display", "description", "compatibility",
"file", "launch", "runs": BOOL, "virtual": BOOL, "providers": [NAME, ...],
"running": {CAPABILITY: PROVIDER, ...},
"reasons": [{"kind", "text", "fields", "fault"}, ...]}, ...],
"errors": [ERROR, ...]}
with the ID of a reason as its kind, providers in the order in which to start
them, fields as "rocon_uri check --help" describes them, and null for what does not
exist; apps that do not run are included only with --all
"""
from __future__ import annotations

import argparse

from rocon_uri.cli.display import fields_as_json, painter, print_json
from rocon_uri.cli.given import GivenURI
from rocon_uri.cli.packages import add_package_path, printable, shortened, workspace
from rocon_uri.cli.running import add_running, what_runs
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted
from rocon_uri.platform import (
    default_robot_name, default_robot_type, generate_platform_rocon_uri)
from rocon_uri.uri import parse

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, List, Optional
    from rocon_uri.apps.runnable import Reason, Verdict
    from rocon_uri.cli.packages import PackageReport
    from rocon_uri.vocabulary import Vocabulary

__all__ = ['add_arguments', 'main']

_REASONS_SHOWN = 20     # of one app; a person has enough by then


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('--robot', metavar='URI',
                        help='what the robot is (default: this machine, as platform prints it)')
    add_package_path(parser)
    parser.add_argument('--all', action='store_true',
                        help='also the apps that it cannot run, and why')
    parser.add_argument('--defaults', metavar='FILE',
                        help='which provider to take where there are several')
    parser.add_argument('--ignore', metavar='ID', type=_reason_id, action='append', default=[],
                        help='leave reasons of this kind out, for example if apps are '
                             'installed elsewhere (may be repeated)')
    add_running(parser, 'also which of the capabilities that an app requires run, and by which '
                        'provider')


def _reason_id(text: str) -> str:
    """The id of a reason; argparse reports any other text."""
    from rocon_uri.apps.runnable import REASON_IDS  # here, since it loads YAML
    if text not in REASON_IDS:
        raise argparse.ArgumentTypeError('%s is not the ID of a reason%s' % (
            quoted(text), did_you_mean(near_misses(text, REASON_IDS))
            or ', expected one of %s' % ', '.join(REASON_IDS)))
    return text


def main(args: argparse.Namespace) -> int:
    report, exported = workspace(args)
    robot = _read_robot(args.robot, exported.vocabulary, report)
    defaults = _read_defaults(args.defaults, report)
    if robot is None or defaults is None:
        return report.status
    from rocon_uri.apps.rapps import runnable    # here, since it loads YAML
    running = what_runs(args, report)
    verdicts = [runnable(rapp, robot.uri, exported.spec_index, defaults, exported.launch_files,
                         args.ignore)
                for rapp in exported.rapps.values()]
    if args.json:
        print_json({'robot': robot.as_json(),
                    'apps': [_as_json(verdict, running)
                             for verdict in verdicts if verdict or args.all],
                    'errors': report.errors})
    else:
        _show(robot, verdicts, args.all, running)
    robot.mention_one_slash()
    return report.status or (0 if any(verdicts) else 1)


def _read_robot(text: Optional[str], vocabulary: Vocabulary,
                report: PackageReport) -> Optional[GivenURI]:
    """The robot; one that is not registered is reported, and may run some apps nevertheless."""
    if text is None:
        text = generate_platform_rocon_uri(default_robot_type, default_robot_name())
    try:
        return GivenURI(parse(text, vocabulary), text)
    except RoconURIValueError as error:
        report.bad_uri(error)
    try:
        return GivenURI(parse(text, vocabulary.opened()), text)
    except RoconURIValueError:
        return None


def _read_defaults(path: Optional[str], report: PackageReport) -> Optional[Dict[str, str]]:
    """The default providers by interface; None if the file is bad, which is reported."""
    if path is None:
        return {}
    from rocon_uri.sources.checked import Reading   # these load YAML
    from rocon_uri.sources.yaml_source import YamlError, read_file
    try:
        defaults = Reading(path, YamlError).load(
            read_file(path), 'the file', 'a mapping from interfaces to providers')
        if isinstance(defaults.get('defaults'), dict):
            defaults = defaults.mapping('defaults')
        return {defaults.key_text(key, 'the name of an interface'):
                defaults.text_at(key, 'the default provider of %s') for key in defaults}
    except (OSError, YamlError) as error:
        report.bad_file(error)
        return None


def _show(robot: GivenURI, verdicts: List[Verdict], show_all: bool,
          running: Optional[Dict[str, str]]) -> None:
    paint = painter()
    runs = [verdict for verdict in verdicts if verdict]
    virtual = [verdict for verdict in verdicts
               if not verdict and not verdict.rapp.is_implementation]
    others = [verdict for verdict in verdicts if not verdict and verdict.rapp.is_implementation]
    width = max((len(printable(verdict.rapp.name)) for verdict in runs + others), default=0)
    print('%s can run %d of %d apps%s' % (
        paint(printable(robot.text), 'bold'), len(runs), len(runs) + len(others),
        ':' if runs else ''))
    for verdict in runs:
        print('  ' + _line(verdict, width, 'green'))
        if show_all and verdict.providers:
            print('      with %s' % ', '.join(verdict.providers))
        _show_running(verdict, running)
    if show_all and others:
        print('and cannot run:')
        for verdict in others:
            print('  ' + _line(verdict, width, 'red'))
            _show_running(verdict, running)
            for reason in verdict.reasons[:_REASONS_SHOWN]:
                _show_reason(reason)
            if len(verdict.reasons) > _REASONS_SHOWN:
                print('      and %d more' % (len(verdict.reasons) - _REASONS_SHOWN))
    if show_all and virtual:
        print('Virtual, as parents of others: %s'
              % ', '.join(printable(verdict.rapp.name) for verdict in virtual))


def _show_running(verdict: Verdict, running: Optional[Dict[str, str]]) -> None:
    for capability, provider in (_running_of(verdict, running) or {}).items():
        print('      %s %s' % (printable(capability), 'does not run' if provider is None
                               else 'runs by %s' % printable(provider)))


def _running_of(verdict: Verdict, running: Optional[Dict[str, str]]
                ) -> Optional[Dict[str, Optional[str]]]:
    """The provider that runs each capability of an app, None for none."""
    return None if running is None else {
        needed.name: running.get(needed.name) for needed in verdict.rapp.required_capabilities}


def _line(verdict: Verdict, width: int, style: str) -> str:
    rapp = verdict.rapp
    about = ': '.join(text for text in (rapp.display, rapp.description) if text)
    name = printable(rapp.name)
    return (painter()(name, style) + ' ' * (width - len(name) + 2) + shortened(about)).rstrip()


def _show_reason(reason: Reason) -> None:
    print('      %s %s' % (printable(reason), painter()('[%s]' % reason.id, 'faint')))
    if reason.explanation is not None:
        for line in str(reason.explanation).splitlines()[1:]:   # without the verdict
            print('        ' + painter()(line, 'faint'))


def _as_json(verdict: Verdict, running: Optional[Dict[str, str]]) -> Dict[str, Any]:
    rapp = verdict.rapp
    return {
        'name': rapp.name, 'display': rapp.display, 'description': rapp.description,
        'compatibility': rapp.compatibility, 'file': rapp.path,
        'launch': rapp.files.get('launch'), 'runs': bool(verdict),
        'virtual': not rapp.is_implementation, 'providers': list(verdict.providers),
        'running': _running_of(verdict, running),
        'reasons': [{
            'kind': reason.id, 'text': str(reason),
            'fields': None if reason.explanation is None else fields_as_json(reason.explanation),
            'fault': None if reason.fault is None else reason.fault.to_dict(),
        } for reason in verdict.reasons],
    }
