"""
List the capabilities that a server knows, and their providers.

Example:
  rocon_uri capabilities list

The default provider of a capability has a star.

Exit status: 0; 2 if no server answers
JSON: {"capabilities": [{"capability", "redefines", "default_provider",
"providers": [NAME, ...]}, ...], "errors": []}; null where there is none
"""
from __future__ import annotations

from rocon_uri.cli.display import painter, print_json

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Any, Dict, Iterator
    from rocon_uri.cli.running import RunningServer

__all__ = ['add_arguments', 'main']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """It takes nothing."""


def main(server: RunningServer, args: argparse.Namespace) -> int:
    capabilities = list(_capabilities(server))
    if args.json:
        print_json({'capabilities': capabilities, 'errors': []})
        return 0
    paint = painter()
    for capability in capabilities:
        redefines = capability['redefines']
        print(paint(capability['capability'], 'cyan')
              + (' (redefines %s)' % redefines if redefines else ''))
        for provider in capability['providers']:
            print('  %s %s' % ('*' if provider == capability['default_provider'] else ' ',
                               provider))
        if not capability['providers']:
            print('    ' + paint('no provider', 'red'))
    return 0


def _capabilities(server: RunningServer) -> Iterator[Dict[str, Any]]:
    interfaces = server.call('get_interfaces').interfaces
    redefined = {semantic: interface for interface in interfaces for semantic in
                 server.call('get_semantic_interfaces', interface).semantic_interfaces}
    for name in [*interfaces, *redefined]:
        answer = server.call('get_providers', name, False)
        yield {'capability': name, 'redefines': redefined.get(name),
               'default_provider': answer.default_provider or None,
               'providers': list(answer.providers)}
