"""
Show what runs, who wants it, and what has failed.

Example:
  rocon_uri capabilities status

The first line of each capability has its state, the time of its last change, and
the pid of its roslaunch. The second line has its provider, who wants it (start,
uses, dependents), its exit code, and what is wrong.

Exit status: 0; 1 if one has failed or is degraded; 2 if no server answers
JSON: {"server", "ready": BOOL, "capabilities": [{"capability", "provider",
"state", "started": BOOL, "uses": NUMBER, "dependents": [NAME, ...], "pid",
"since": SECONDS, "exit_code", "text"}, ...], "errors": []}; null where there is
none
"""
from __future__ import annotations

import time

from rocon_uri.cli.display import painter, print_json
from rocon_uri.cli.packages import one_line

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Any, Dict, List
    from rocon_uri.cli.running import RunningServer

__all__ = ['add_arguments', 'as_json', 'main']

_STYLES = {'running': 'green', 'failed': 'red', 'degraded': 'red'}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """It takes nothing."""


def main(server: RunningServer, args: argparse.Namespace) -> int:
    status = server.call('get_status').status
    capabilities = [as_json(capability) for capability in status.capabilities]
    if args.json:
        print_json({'server': status.server, 'ready': status.ready,
                    'capabilities': capabilities, 'errors': []})
    else:
        _show(capabilities)
        if not status.ready:
            print('the server is not ready yet')
    return 1 if any(c['state'] in ('failed', 'degraded') for c in capabilities) else 0


def as_json(capability: Any) -> Dict[str, Any]:
    """A ``capabilities/CapabilityStatus`` as the help describes it."""
    return {'capability': capability.capability, 'provider': capability.provider,
            'state': capability.state, 'started': capability.started, 'uses': capability.uses,
            'dependents': list(capability.dependents), 'pid': capability.pid or None,
            'since': capability.since.to_sec(),
            'exit_code': None if capability.exit_code == -1 else capability.exit_code,
            'text': capability.text}


def _show(capabilities: List[Dict[str, Any]]) -> None:
    if not capabilities:
        print('nothing runs')
        return
    paint = painter()
    width = max([len(c['capability']) for c in capabilities] + [len('capability')])
    rows = [('capability', 'state', 'since', 'pid')]
    rows += [(c['capability'], c['state'], _clock(c['since']), str(c['pid'] or '-'))
             for c in capabilities]
    for (name, state, since, pid), capability in zip(rows, [None, *capabilities]):
        line = '%-*s  %-9s  %-8s  %s' % (width, one_line(name), state, since, pid)
        style = 'bold' if capability is None else _STYLES.get(state, 'cyan')
        print(paint(line, style))
        if capability is not None:
            print('    ' + '; '.join(_details(capability)))


def _clock(since: float) -> str:
    """The time of day, or the day where it was not today."""
    then = time.localtime(since)
    is_today = time.localtime()[:3] == then[:3]
    return time.strftime('%H:%M:%S' if is_today else '%b %d', then)


def _details(capability: Dict[str, Any]) -> List[str]:
    wanted = ['start'] * capability['started']
    if capability['uses']:
        wanted.append('%d use%s' % (capability['uses'], 's' * (capability['uses'] != 1)))
    wanted += capability['dependents']
    details = [capability['provider']]
    if wanted:
        details.append('wanted by ' + ', '.join(wanted))
    if capability['exit_code'] is not None:
        details.append('exit %d' % capability['exit_code'])
    if capability['text']:
        details.append(capability['text'])
    return [one_line(detail) for detail in details if detail]
