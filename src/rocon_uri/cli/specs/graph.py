"""
Draw what depends on what: interfaces, semantic interfaces, providers and apps.

Examples:
  rocon_uri specs graph > specs.dot
  rocon_uri specs graph --output specs.svg

Writes the language of graphviz. A FILE that ends in .svg or .png needs graphviz.
Blue boxes are interfaces, green ones semantic interfaces, yellow ellipses
providers, the others apps (virtual ones dashed); what is named but does not exist
is red. With --running, what runs has a thick green outline.

Exit status: 0; 2 if the picture could not be made, or a folder was bad, though the
others are drawn
JSON: {"nodes": [{"id", "name", "kind", "running": BOOL}, ...], "edges":
[{"from", "to", "kind", "preferred"}, ...], "errors": [ERROR, ...]}, beside the
picture if there is a FILE; an id is the name, with a # before that of an app
"""
from __future__ import annotations

import argparse
import os
import subprocess

from rocon_uri.cli.display import print_json
from rocon_uri.cli.packages import (
    PackageReport, add_package_path, mention_faults, workspace)
from rocon_uri.cli.running import add_running, what_runs
from rocon_uri.sources.wording import quoted_path

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_package_path(parser)
    parser.add_argument('--output', metavar='FILE',
                        help='a file that ends in .dot, .svg or .png (default: standard output)')
    add_running(parser, 'draw what runs on a capability server in green')


def main(args: argparse.Namespace) -> int:
    from rocon_uri.spec_graph import dot_text, spec_graph   # here, since the other verbs do not
    report, exported = workspace(args)
    mention_faults(args, report, exported)
    graph = spec_graph(exported.spec_index, exported.rapps)
    running = what_runs(args, report) or {}
    text = dot_text(graph, {*running, *running.values()})
    if args.output is not None:
        _write(text + '\n', args.output, report)
    elif not args.json:
        print(text)
    if args.json:
        print_json({
            'nodes': [{'id': identity, 'name': node.name, 'kind': node.kind,
                       'running': node.name in running or node.name in running.values()}
                      for identity, node in graph.nodes.items()],
            'edges': [{'from': edge.start, 'to': edge.end, 'kind': edge.kind,
                       'preferred': edge.preferred} for edge in graph.edges],
            'errors': report.errors})
    return report.status


def _write(text: str, path: str, report: PackageReport) -> None:
    extension = os.path.splitext(path)[1].lower()
    content = text.encode('utf-8', 'backslashreplace')
    if extension in ('.svg', '.png'):
        _draw(content, extension[1:], path, report)
    elif extension != '.dot':
        report.bad('%s ends in none of .dot, .svg and .png' % quoted_path(path))
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
