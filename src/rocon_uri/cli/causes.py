"""Which files with faults may be why an answer is as it is: their faults are shown with it."""
from __future__ import annotations

import os
from typing import Collection, Iterable, List, Sequence

from capabilities.planning.faults import Fault, FaultKind
from rocon_uri.apps.runnable import App, ReasonKind, Verdict
from rocon_uri.sources.yaml_source import read_file
from rocon_uri.workspace import Workspace

__all__ = ['is_rules_file', 'may_cause', 'may_define', 'may_explain']


def may_define(name: str, file: str, exported: Workspace) -> bool:
    """
    Can a file that cannot be read be that of an app or a spec?

    :param str name: ``package/name``
    :param str file: its path
    :param Workspace exported: what the packages export
    :returns: bool
    """
    package, _, own_name = name.partition('/')
    if package not in exported.packages or not file.startswith(
            os.path.join(exported.packages[package].folder, '')):
        return False
    stem, extension = os.path.splitext(os.path.basename(file))
    return stem == own_name or extension in ('.yaml', '.yml')


def may_cause(fault: Fault, file: str, exported: Workspace) -> bool:
    """Can this file, which cannot be read, be why a capability cannot be had?"""
    if fault.kind is FaultKind.NO_INTERFACE:
        return may_define(fault.capability, file, exported)
    if fault.kind is FaultKind.UNKNOWN_PROVIDER:
        return may_define(str(fault.provider), file, exported)
    return fault.kind is FaultKind.NO_PROVIDER and any(
        file in package.files('capability_provider') for package in exported.packages.values()
    ) and _contains(file, fault.capability)


def may_explain(file: str, names: Sequence[str], apps: Collection[App],
                verdicts: Iterable[Verdict], exported: Workspace) -> bool:
    """
    Can what is wrong in a file be why apps that were asked for are missing, or do not run?

    :param str file: its path
    :param names: sequence of str, the apps that were asked for
    :param apps: collection of `App`, those of them that exist
    :param verdicts: iterable of `Verdict`, one for each
    :param Workspace exported: what the packages export
    :returns: bool
    """
    found = {app.name for app in apps}
    missing = [name for name in names if name not in found]
    if any(may_define(name, file, exported)
           for app_name in missing for name in _line_of(app_name, exported)):
        return True
    reasons = [reason for verdict in verdicts for reason in verdict.reasons]
    return any(reason.fault is not None and may_cause(reason.fault, file, exported)
               or reason.kind is ReasonKind.PLATFORM and reason.explanation is None
               and is_rules_file(file, exported) for reason in reasons)


def is_rules_file(file: str, exported: Workspace) -> bool:
    """Can this file register values?"""
    return any(file in package.files('rocon_uri', 'rules')
               for package in exported.packages.values())


def _line_of(name: str, exported: Workspace) -> List[str]:
    """The names of a rapp and its ancestors, as far as they can be read."""
    line = [name]
    while line[-1] in exported.own_rapps:
        parent_name = exported.own_rapps[line[-1]].parent_name
        if parent_name is None or parent_name in line:
            break
        line.append(parent_name)
    return line


def _contains(file: str, name: str) -> bool:
    try:
        return name.encode() in read_file(file)
    except OSError:
        return True     # nobody knows
