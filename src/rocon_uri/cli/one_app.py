"""One app on a robot: the answer, the reasons, what starts, and the names that the app sees."""
from __future__ import annotations

from typing import Iterator, List, Mapping, NamedTuple, Optional, Tuple

from capabilities.merged_remappings import merged_remappings
from capabilities.planning.plan import StartPlan
from rocon_uri.apps.app_file import AppFile
from rocon_uri.apps.rapp import RequiredCapability
from rocon_uri.apps.runnable import ReasonKind, Verdict
from rocon_uri.cli.display import painter
from rocon_uri.cli.packages import one_line, shown_path
from rocon_uri.cli.rows import print_names, print_rows
from rocon_uri.compatibility import LEGEND, MARKS
from rocon_uri.sources import wording
from rocon_uri.sources.wording import quoted
from rocon_uri.vocabulary import Vocabulary
from rocon_uri.workspace import Workspace

__all__ = ['SeenName', 'seen_names', 'show_app']


class SeenName(NamedTuple):
    """A name of the interface of a capability, and what the two sides call it."""

    #: ``'topics'``, ``'services'``, ``'actions'`` or ``'parameters'``
    kind: str
    #: ``'requires'`` or ``'provides'``; None if the interface does not say
    grouping: Optional[str]
    #: what the interface calls it
    name: str
    #: its type; None for a parameter without one
    type: Optional[str]
    #: what it is called where the providers of the plan run
    robot_name: str
    #: what the app calls it
    app_name: str


def seen_names(needed: RequiredCapability, plan: StartPlan, exported: Workspace
               ) -> List[SeenName]:
    """
    What an app sees of a capability.

    :param RequiredCapability needed: what the app says of it
    :param StartPlan plan: what starts for the app
    :param Workspace exported: what the robot has
    :returns: list of `SeenName`; empty if the interface is not there or has no names
    """
    interface = exported.interface(needed.name)
    provider = plan.providers.get(needed.name)
    below = {provider}
    for name in reversed(plan.order):       # whatever depends on one comes after it
        if name in below:
            below.update(plan.dependencies[name])
    remapped = merged_remappings(exported.providers[name] for name in plan.order if name in below)
    if interface is None:
        return []
    # A provider that was named may implement a semantic interface, which renames what it redefines.
    implemented = interface if provider is None else exported.interface(
        str(exported.providers[provider].implements)) or interface
    return [SeenName(kind=kind, grouping=grouping, name=name, type=element.type,
                     robot_name=remapped.get(kind, {}).get(renamed, renamed),
                     app_name=needed.remappings.get(kind, {}).get(name, name))
            for (kind, name, element, grouping), (_, renamed, _, _)
            in zip(interface.elements(), implemented.elements())]


def show_app(verdict: Verdict, robot: str, exported: Workspace,
             running: Optional[Mapping[str, str]]) -> None:
    """
    Print all that there is to say about an app on a robot.

    :param Verdict verdict: of both
    :param str robot: the robot, as it was given
    :param Workspace exported: what the robot has
    :param running: the providers that run, by capability; None if nobody asked for them
    """
    app, paint = verdict.app, painter()
    print('%s: %s %s run %s' % (
        paint('yes', 'green') if verdict else paint('no', 'red'), one_line(robot),
        'can' if verdict else 'cannot', paint(one_line(app.name), 'bold')))
    for text in app.display, app.description:
        if text and text != app.name:
            print('  ' + one_line(text))
    print('  in ' + shown_path(app.path))
    judged = list(_judgements(verdict, exported.vocabulary))
    width = max((len(what) for _, what, _ in judged), default=0)
    print('%s  %s' % (paint('judged', 'bold'), paint('(%s)' % LEGEND, 'faint')))
    for fits, what, text in judged:
        print('  %s  %s  %s' % (paint(MARKS[fits], 'green' if fits else 'red'), what.ljust(width),
                                wording.printable(text)))
    for reason in verdict.reasons:
        if reason.explanation is not None:
            print(paint('platform', 'bold'))
            for line in str(reason.explanation).splitlines()[1:-1]:
                print('  ' + line)
    print_names('starts for it, in this order', verdict.providers)
    for needed in app.required_capabilities:
        _show_capability(needed, verdict.plan, exported, running)


def _judgements(verdict: Verdict, vocabulary: Vocabulary) -> Iterator[Tuple[bool, str, str]]:
    """
    What was judged, as (does it fit, what, text); what does not fit has the id of the reason.

    What does not fit and is ignored is not there.
    """
    app, plan = verdict.app, verdict.plan
    against = verdict.reasons + verdict.ignored
    fits = all(reason.kind is not ReasonKind.PLATFORM for reason in against)
    if fits and isinstance(app, AppFile):
        yield True, 'platform', '%s includes this robot%s' % (
            quoted(app.platform),
            ' (compared as text, since it is not registered)'
            if not app.is_registered(vocabulary) else
            ' (a group, which app_manager compares as text)' if app.is_group(vocabulary) else '')
    elif fits and app.compatibility is not None:
        yield True, 'platform', '%s includes this robot' % quoted(app.compatibility)
    faulty_files = {reason.id.partition('-')[0] for reason in against
                    if reason.kind is ReasonKind.LAUNCH}
    yield from ((True, key, shown_path(app.files[key]))
                for key in ('launch', 'run') if key in app.files and key not in faulty_files)
    faulty = {reason.fault.asked_for for reason in against if reason.fault is not None}
    yield from ((True, 'capability', '%s by %s' % (needed.name, plan.providers[needed.name]))
                for needed in app.required_capabilities
                if needed.name in plan.providers and needed.name not in faulty)
    yield from ((False, reason.id, str(reason)) for reason in verdict.reasons)


def _show_capability(needed: RequiredCapability, plan: StartPlan, exported: Workspace,
                     running: Optional[Mapping[str, str]]) -> None:
    heading = needed.name
    if needed.name in plan.providers:
        heading += ' by ' + plan.providers[needed.name]
    if running is not None:
        heading += ', which ' + ('runs by %s' % running[needed.name] if needed.name in running
                                 else 'does not run')
    rows = [(seen.grouping or '', seen.kind, seen.name, seen.type or '', ', '.join(
        where + name for where, name in (('on the robot ', seen.robot_name),
                                         ('in the app ', seen.app_name)) if name != seen.name))
            for seen in seen_names(needed, plan, exported)]
    print_rows(one_line(heading), rows)
    if not rows:
        print(one_line('%s: no topics, services, actions or parameters are known' % needed.name))
