"""
Draw what depends on what: interfaces, semantic interfaces, providers and apps.

Examples:
  rocon_uri specs graph > specs.dot
  rocon_uri specs graph --output specs.svg
  rocon_uri specs graph --robot rocon:/turtlebot2 --defaults FILE --output cafe.pdf
  rocon_uri specs graph --app cafe_rapps/greet --output greet.png

Writes the language of graphviz. A FILE that ends in .svg, .png or .pdf needs it.
The picture reads from left to right: app, capability, provider, and what the
provider depends on. Packages are frames. What does not work is red and says why;
what no app needs is grey. With --robot, what that robot can run is green, and apps
for other robots are red. With --running, what runs has a thick green outline.

Exit status: 0; 2 if the picture could not be made, or a folder, the robot, a NAME
or the FILE of --defaults was bad, though all else is drawn
JSON: {"nodes": [{"id", "name", "kind", "state": "", "runs", "fails" or "unused",
"fault", "problem", "running": BOOL}, ...], "edges":
[{"from", "to", "kind", "preferred"}, ...], "errors": [ERROR, ...]}, beside the
picture if there is a FILE; an id is the name, with a # before that of an app; a
fault is the ID of a reason of "rocon_uri apps", and the problem its text
"""
from __future__ import annotations

import argparse
import os
import subprocess

from rocon_uri.cli.completion import app_names, offer, uris
from rocon_uri.cli.display import print_json
from rocon_uri.cli.judged import add_defaults, named_apps, read_defaults, read_robot
from rocon_uri.cli.packages import (
    PackageReport, add_package_path, mention_faults, workspace)
from rocon_uri.cli.running import add_running, what_runs
from rocon_uri.sources.wording import quoted_path

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_package_path(parser)
    parser.add_argument('--output', metavar='FILE',
                        help='a file that ends in .dot, .svg, .png or .pdf (default: standard '
                             'output)')
    offer(uris, parser.add_argument(
        '--robot', metavar='URI', help='draw what this robot can run in green'))
    add_defaults(parser)
    offer(app_names, parser.add_argument(
        '--app', metavar='NAME', dest='names', action='append', default=[],
        help='draw this app only, with what it needs (may be repeated)'))
    add_running(parser, 'draw what runs on a capability server in green')


def main(args: argparse.Namespace) -> int:
    from rocon_uri.cli.causes import may_explain    # here, since the other verbs do not
    from rocon_uri.spec_graph import SpecGraph, spec_graph
    from rocon_uri.spec_picture import dot_text
    report, exported = workspace(args)
    apps = named_apps(args.names, exported, report)
    mention_faults(args, report, exported,
                   lambda file: may_explain(file, args.names, apps, (), exported))
    robot = None
    if args.robot is not None:
        robot = read_robot(args.robot, exported.vocabulary, report)
    graph = SpecGraph({}, [])
    defaults = read_defaults(args.defaults, exported.spec_index, report)
    if apps or not args.names:
        graph = spec_graph(exported, None if robot is None else robot.uri, defaults,
                           [app.name for app in apps])
    running = what_runs(args, report) or {}
    text = dot_text(graph, {*running, *running.values()})
    if args.output is not None:
        _write(text + '\n', args.output, report)
    elif not args.json:
        print(text)
    if args.json:
        print_json({
            'nodes': [{'id': identity, **node._asdict(),
                       'running': node.name in running or node.name in running.values()}
                      for identity, node in graph.nodes.items()],
            'edges': [{'from': edge.start, 'to': edge.end, 'kind': edge.kind,
                       'preferred': edge.preferred} for edge in graph.edges],
            'errors': report.errors})
    return report.status


def _write(text: str, path: str, report: PackageReport) -> None:
    extension = os.path.splitext(path)[1].lower()
    content = text.encode('utf-8', 'backslashreplace')
    if extension in ('.svg', '.png', '.pdf'):
        _draw(content, extension[1:], path, report)
    elif extension != '.dot':
        report.bad('%s ends in none of .dot, .svg, .png and .pdf' % quoted_path(path))
    else:
        try:
            with open(path, 'wb') as file:
                file.write(content)
        except OSError as error:
            report.bad('cannot write %s: %s' % (quoted_path(path), error.strerror))


def _draw(content: bytes, picture_format: str, path: str, report: PackageReport) -> None:
    try:
        done = subprocess.run(['dot', '-T' + picture_format, '-o', os.path.abspath(path)],
                              input=content, stderr=subprocess.PIPE)
    except FileNotFoundError:
        report.bad("a picture needs the program 'dot' of graphviz, which is not installed; "
                   'write a .dot file, or install graphviz')
        return
    if done.returncode:
        problem = ' '.join(done.stderr.decode('utf-8', 'replace').split())
        report.bad('cannot draw %s: %s' % (quoted_path(path), problem or 'dot has failed'))
