"""
List the apps that a robot can run, and why not the others.

Examples:
  rocon_uri apps
  rocon_uri apps --robot rocon:/turtlebot2/bob/noetic/focal --all
  rocon_uri apps cafe_rapps/greet --robot rocon:/turtlebot2 --defaults defaults.yaml
  rocon_uri apps --all --ignore launch-missing
  rocon_uri apps --html fleet.html --robots-in fleet.txt

Reads all rapps, all .app files of app_manager and all capability specs that the
packages below PATH export, and assumes that the robot has their providers. An app
runs if its platform includes the robot, and if its launch file and all capabilities
that it requires can be started. If several providers implement a capability, FILE
says which to take: a YAML mapping from interfaces to providers, on its own or as
"defaults". A platform in a .app file that is not registered is compared with TYPE
as text. Each reason ends with its ID, which --ignore takes.

For each NAME prints whether the robot can run it, all that was judged, the
providers that start for it, and the names in each capability: what the interface
calls them, and what the robot and the app call them where that differs.

With --html, FILE becomes a page that filters, sorts and has the reasons behind each
cell. It needs no network, and has all apps; nothing else is printed.

Exit status: 0 if an app runs, or each NAME does; 1 if not; 2 if the robot, a NAME,
a folder or the FILE was bad, though the rest is judged, even for a robot that is
not registered. Files with faults are counted, and "rocon_uri specs check" shows
what is wrong; they spoil no answer. Faults that may be its cause are shown.
JSON: {"robot": URI, "apps": [{"name", "form": "rapp" or "app", "display",
"description", "compatibility", "platform", "file", "launch", "run", "runs": BOOL,
"virtual": BOOL, "providers": [NAME, ...], "running": {CAPABILITY: PROVIDER, ...},
"capabilities": [{"name", "provider", "names": [{"kind", "grouping", "name", "type",
"robot_name", "app_name"}, ...]}, ...],
"reasons": [{"kind", "text", "fields", "fault"}, ...]}, ...],
"errors": [ERROR, ...]}
with the ID of a reason as its kind, providers in the order in which to start
them, fields as those of check, and null for what does not
exist; apps that do not run are included only with --all or if they are named, and
capabilities only if they are named
"""
from __future__ import annotations

import argparse

from rocon_uri.cli.completion import app_names, offer, uris
from rocon_uri.cli.display import fields_as_json, painter, print_json
from rocon_uri.cli.given import say
from rocon_uri.cli.judged import add_defaults, named_apps, read_defaults, read_robot
from rocon_uri.cli.notes import Notes
from rocon_uri.cli.packages import (
    add_package_path, mention_faults, one_line, shortened, shown_path, workspace)
from rocon_uri.cli.running import add_running, what_runs
from rocon_uri.compatibility import LEGEND
from rocon_uri.sources import wording
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Dict, List, Optional
    from rocon_uri.apps.runnable import Reason, Verdict
    from rocon_uri.cli.given import GivenURI
    from rocon_uri.workspace import Workspace

__all__ = ['add_arguments', 'main']

_REASONS_SHOWN = 20     # of one app; a person has enough by then


def add_arguments(parser: argparse.ArgumentParser) -> None:
    offer(app_names, parser.add_argument(
        'names', metavar='NAME', nargs='*',
        help='package/name of an app: all about it (default: the list of all)'))
    offer(uris, parser.add_argument(
        '--robot', metavar='URI',
        help='what the robot is (default: this machine, as platform prints it)'))
    parser.add_argument('--robot-type', metavar='TYPE',
                        help='what app_manager calls the robot, for platforms in .app files that '
                             'are not registered (default: its hardware_platform)')
    add_package_path(parser)
    parser.add_argument('--all', action='store_true',
                        help='also the apps that it cannot run, and why')
    add_defaults(parser)
    parser.add_argument('--ignore', metavar='ID', type=_reason_id, action='append', default=[],
                        help='leave reasons of this kind out, for example if apps are '
                             'installed elsewhere (may be repeated)')
    parser.add_argument('--html', metavar='FILE',
                        help='write a page for a browser: robots by apps, with all reasons')
    parser.add_argument('--robots-in', metavar='FILE',
                        help='with --html: the robots, one URI a line (default: the --robot)')
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
    error = _wrong_use(args)
    if error:
        say('rocon_uri apps: error: ' + error)
        return 2
    from rocon_uri.cli.causes import is_rules_file, may_explain     # here, since it loads YAML
    report, exported = workspace(args)
    apps = named_apps(args.names, exported, report) if args.names else list(exported.apps())
    robot = None
    if args.html is None:
        robot = read_robot(args.robot, exported.vocabulary, report)
    defaults = read_defaults(args.defaults, exported.spec_index, report)
    if args.html is not None:
        from rocon_uri.cli.app_report import write_app_report
        mention_faults(args, report, exported,
                       lambda file: may_explain(file, args.names, apps, (), exported))
        found = write_app_report(args, apps, exported, defaults, report)
        if args.json:
            print_json({'robot': None, 'apps': [], 'errors': report.errors})
        return report.status or (0 if found else 1)
    from rocon_uri.apps.runnable import WITH_NEAR_MISSES, runnable   # here, since it loads YAML
    running = what_runs(args, report)
    verdicts = [] if robot is None else [
        runnable(app, robot.uri, exported.spec_index, defaults, exported.launch_files, args.ignore,
                 args.robot_type, near_misses=number < WITH_NEAR_MISSES)
        for number, app in enumerate(apps)]
    is_unregistered = robot is not None and robot.uri.vocabulary is not exported.vocabulary
    mention_faults(args, report, exported, lambda file: (
        is_unregistered and is_rules_file(file, exported)
        or bool(args.names) and may_explain(file, args.names, apps, verdicts, exported)))
    if args.json:
        print_json({'robot': robot and robot.as_json(),
                    'apps': [_as_json(verdict, running, exported if args.names else None)
                             for verdict in verdicts if verdict or args.all or args.names],
                    'errors': report.errors})
    elif robot is not None and args.names:
        from rocon_uri.cli.one_app import show_app
        for index, verdict in enumerate(verdicts):
            print('\n' * bool(index), end='')
            show_app(verdict, robot.text, exported, running)
    elif robot is not None:
        _show(robot, verdicts, args.all, running)
    if robot is not None:
        Notes().mention_one_slash(robot)
    return report.status or (0 if (all if args.names else any)(verdicts) else 1)


def _wrong_use(args: argparse.Namespace) -> str:
    if args.html is None:
        return '--robots-in needs --html' if args.robots_in is not None else ''
    if args.robots_in is not None and args.robot is not None:
        return 'give the robots with --robots-in or with --robot'
    if args.all or args.running:
        return '--html takes neither --all nor --running: the page has all apps, and not what runs'
    return ''


def _show(robot: GivenURI, verdicts: List[Verdict], show_all: bool,
          running: Optional[Dict[str, str]]) -> None:
    paint = painter()
    runs = [verdict for verdict in verdicts if verdict]
    virtual = [verdict for verdict in verdicts
               if not verdict and not verdict.app.is_implementation]
    others = [verdict for verdict in verdicts if not verdict and verdict.app.is_implementation]
    width = max((len(one_line(verdict.app.name)) for verdict in runs + others), default=0)
    print('%s can run %d of %d apps%s' % (
        paint(one_line(robot.text), 'bold'), len(runs), len(runs) + len(others),
        ':' if runs else ''))
    for verdict in runs:
        _show_line(verdict, width, 'green', show_all)
        if show_all and verdict.providers:
            print('      with %s' % ', '.join(verdict.providers))
        _show_running(verdict, running)
    if others and not show_all:
        print('cannot run %d: --all, or the NAME of one, shows why' % len(others))
    if show_all and others:
        print('and cannot run:')
        for verdict in others:
            _show_line(verdict, width, 'red', show_all)
            _show_running(verdict, running)
            for reason in verdict.reasons[:_REASONS_SHOWN]:
                _show_reason(reason)
            if len(verdict.reasons) > _REASONS_SHOWN:
                print('      and %d more' % (len(verdict.reasons) - _REASONS_SHOWN))
        if any(reason.explanation is not None for verdict in others for reason in verdict.reasons):
            print(paint('(%s)' % LEGEND, 'faint'))
    if show_all and virtual:
        print('Virtual, as parents of others: %s'
              % ', '.join(one_line(verdict.app.name) for verdict in virtual))


def _show_running(verdict: Verdict, running: Optional[Dict[str, str]]) -> None:
    for capability, provider in (_running_of(verdict, running) or {}).items():
        print('      %s %s' % (one_line(capability), 'does not run' if provider is None
                               else 'runs by %s' % one_line(provider)))


def _running_of(verdict: Verdict, running: Optional[Dict[str, str]]
                ) -> Optional[Dict[str, Optional[str]]]:
    """The provider that runs each capability of an app, None for none."""
    return None if running is None else {
        needed.name: running.get(needed.name) for needed in verdict.app.required_capabilities}


def _show_line(verdict: Verdict, width: int, style: str, show_file: bool) -> None:
    """Print the name of an app and what it is; its file too, if it is asked for or a .app."""
    app, paint = verdict.app, painter()
    name = one_line(app.name)
    about = shortened(': '.join(text for text in (app.display, app.description)
                                if text and text != app.name))
    if not show_file and app.form == 'app':
        about = ('%s (%s)' % (about, shown_path(app.path))).lstrip()
    print(('  ' + paint(name, style) + ' ' * (width - len(name) + 2) + about).rstrip())
    if show_file:
        print('      in ' + shown_path(app.path))


def _show_reason(reason: Reason) -> None:
    print('      %s %s' % (wording.printable(str(reason)), painter()('[%s]' % reason.id, 'faint')))
    if reason.explanation is not None:
        for line in str(reason.explanation).splitlines()[1:-1]:     # the table alone
            print('        ' + painter()(line, 'faint'))


def _as_json(verdict: Verdict, running: Optional[Dict[str, str]],
             exported: Optional[Workspace]) -> Dict[str, Any]:
    """An app; with its capabilities if it is said what is exported."""
    app = verdict.app
    answer: Dict[str, Any] = {
        'name': app.name, 'form': app.form,
        'display': app.display, 'description': app.description,
        'compatibility': app.compatibility, 'platform': getattr(app, 'platform', None),
        'file': app.path, 'launch': app.files.get('launch'), 'run': app.files.get('run'),
        'runs': bool(verdict), 'virtual': not app.is_implementation,
        'providers': list(verdict.providers), 'running': _running_of(verdict, running),
        'reasons': [{
            'kind': reason.id, 'text': str(reason),
            'fields': None if reason.explanation is None else fields_as_json(reason.explanation),
            'fault': None if reason.fault is None else reason.fault.to_dict(),
        } for reason in verdict.reasons],
    }
    if exported is not None:
        from rocon_uri.cli.one_app import seen_names
        answer['capabilities'] = [{
            'name': needed.name, 'provider': verdict.plan.providers.get(needed.name),
            'names': [name._asdict() for name in seen_names(needed, verdict.plan, exported)],
        } for needed in app.required_capabilities]
    return answer
