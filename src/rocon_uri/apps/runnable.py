"""
Can an app run on a robot, and if not, why not?

An app runs if its platform includes the robot, and if its launch file and each capability that it
requires can be started. The verdict has all reasons against it, not only the first.
"""
from __future__ import annotations

import os
from dataclasses import replace
from enum import Enum
from typing import Collection, Iterator, Mapping, NamedTuple, Optional, Tuple, Union

from capabilities.planning.faults import Fault, FaultKind
from capabilities.planning.plan import StartPlan
from capabilities.planning.providers import plan_for_capabilities
from capabilities.spec_index import SpecIndex
from rocon_uri.apps.app_file import (
    WHAT_RESOURCES_ARE, AppFile, interface_problem, launch_file_fault)
from rocon_uri.apps.rapp import Rapp
from rocon_uri.sources.resources import AMBIGUOUS, MISSING
from rocon_uri.compatibility import Explanation, explain
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.sources.launch_file import LaunchFiles
from rocon_uri.sources.wording import quoted
from rocon_uri.uri import RoconURI, parse
from rocon_uri.vocabulary import Vocabulary

__all__ = ['REASON_IDS', 'WITH_NEAR_MISSES', 'App', 'Reason', 'ReasonKind', 'Verdict',
           'platform_uri', 'runnable']

#: Either form of an app.
App = Union[Rapp, AppFile]

#: Of so many apps at once the reasons have near misses; with those of thousands it takes minutes.
WITH_NEAR_MISSES = 100


class ReasonKind(Enum):
    """What a reason against running an app is about."""

    #: it is virtual, a parent of others only
    VIRTUAL = 'virtual'
    #: what it runs on does not include the robot, or is not legal
    PLATFORM = 'platform'
    #: its own launch file cannot be started, or another file that it cannot do without is not there
    LAUNCH = 'launch'
    #: a capability that it requires cannot be had
    CAPABILITY = 'capability'
    #: a capability that it requires has a provider, which lacks something itself
    DEPENDENCY = 'dependency'


#: The ids that reasons may have, in a stable order.
REASON_IDS: Tuple[str, ...] = (ReasonKind.VIRTUAL.value, ReasonKind.PLATFORM.value,
                               *(kind.value for kind in FaultKind
                                 if kind is not FaultKind.NO_NODELET_MANAGER),
                               'launch-ambiguous', 'icon-ambiguous',
                               *('%s-%s' % (key, kind) for key in ('run', 'interface')
                                 for kind in (MISSING, AMBIGUOUS)), 'interface-unreadable')


class Reason(NamedTuple):
    """
    One thing that is against running an app. Its text is one line.

    >>> print(Reason(ReasonKind.VIRTUAL, 'virtual', 'it is virtual: it has no launch'))
    it is virtual: it has no launch
    """

    #: what it is about
    kind: ReasonKind
    #: which kind of thing it is, one of `REASON_IDS`
    id: str
    #: what is wrong; '' if a capability is the reason, since ``fault`` has the text
    problem: str = ''
    #: of the app and the robot, if their platforms were compared; its text is a table of fields
    explanation: Optional[Explanation] = None
    #: if a capability is the reason
    fault: Optional[Fault] = None

    def __str__(self) -> str:
        return self.problem if self.fault is None else self.fault.reason


class Verdict(NamedTuple):
    """
    Whether an app runs on a robot; true if it does.

    >>> from rocon_uri.apps.rapps import rapp_from_string
    >>> dance = rapp_from_string('launch: dance.launch', 'ours/dance')
    >>> print(Verdict(dance, (), StartPlan([], {}, {}, [])))
    ours/dance runs
    """

    #: what is judged
    app: App
    #: all reasons against it; empty if it runs
    reasons: Tuple[Reason, ...]
    #: what starts for it, as much of it as can be had
    plan: StartPlan
    #: the reasons that were left out, as the caller asked for
    ignored: Tuple[Reason, ...] = ()

    @property
    def providers(self) -> Tuple[str, ...]:
        """The providers of capabilities to start for it, in order; as many as can be had."""
        return tuple(self.plan.order)

    def __bool__(self) -> bool:
        return not self.reasons

    def __str__(self) -> str:
        if self:
            return '%s runs' % self.app.name
        return '%s does not run: %s' % (self.app.name, '; '.join(map(str, self.reasons)))


def runnable(app: App, robot_uri: Union[str, RoconURI], spec_index: SpecIndex,
             defaults: Optional[Mapping[str, str]] = None,
             launch_files: Optional[LaunchFiles] = None, ignore: Collection[str] = (),
             robot_type: Optional[str] = None, near_misses: bool = True) -> Verdict:
    """
    Can this app run on this robot?

    :param app: `Rapp`, with what it has from its parents, or `AppFile`
    :param robot_uri: the robot, RoconURI or str; it may have values that are not registered, which
        apps that run anywhere do not mind
    :param spec_index: `capabilities.discovery.SpecIndex` of the capabilities that the robot has
    :param defaults: mapping from names of interfaces to names of the providers to take for them
    :param launch_files: `LaunchFiles`, to read each launch file once for several apps
    :param ignore: collection of str, the ids of the reasons to leave out, of `REASON_IDS`
    :param robot_type: str, what the platform of an `AppFile` is compared with if it is not
        registered; None for the robot's hardware_platform
    :param bool near_misses: do the texts say what was probably meant by a capability that is not
        there? To find it takes 10 us for each of those of its package, whenever the text is shown.
    :returns: `Verdict`
    :raises RoconURIValueError: if the robot's URI is not legal

    >>> from capabilities.discovery import SpecIndex
    >>> from rocon_uri.apps.rapps import rapp_from_file_path
    >>> path = 'examples/workspace/cafe_rapps/rapps/radio/radio.rapp'
    >>> radio = rapp_from_file_path(path, 'cafe_rapps/radio')
    >>> bool(runnable(radio, 'rocon:/pr2/bob', SpecIndex()))
    True
    >>> from rocon_uri.apps.rapps import rapp_from_string
    >>> dance = rapp_from_string('{compatibility: "rocon:/pr2", launch: d.launch}', 'ours/dance')
    >>> print(runnable(dance, 'rocon:/kobuki', SpecIndex(), ignore=['launch-missing']))
    ours/dance does not run: 'rocon:/pr2' does not include this robot: hardware_platform is kobuki
    """
    # A fault in the robot's URI is not the app's.
    robot = parse(robot_uri, Vocabulary.open()) if isinstance(robot_uri, str) else robot_uri
    launch_files = launch_files or LaunchFiles()
    plan = plan_for_capabilities(
        spec_index, [capability.name for capability in app.required_capabilities], defaults,
        launch_files)
    own = (_rapp_reasons(app, robot_uri, launch_files) if isinstance(app, Rapp) else
           _app_file_reasons(app, robot, robot_type, launch_files))
    faults = plan.faults if near_misses else [replace(fault, known=()) for fault in plan.faults]
    reasons = (*own, *(Reason(kind=ReasonKind.CAPABILITY if fault.is_of_the_capability else
                              ReasonKind.DEPENDENCY, id=fault.kind.value, fault=fault)
                       for fault in faults))
    return Verdict(app=app, reasons=tuple(reason for reason in reasons if reason.id not in ignore),
                   plan=plan,
                   ignored=tuple(reason for reason in reasons if reason.id in ignore))


def platform_uri(app: App, vocabulary: Vocabulary) -> Optional[RoconURI]:
    """
    What an app runs on, as a URI.

    :param app: `Rapp` or `AppFile`
    :param Vocabulary vocabulary: what it is read with
    :returns: RoconURI; None if the app has none that is legal, or one that is compared as text

    >>> from rocon_uri.apps.rapps import rapp_from_string
    >>> rapp = rapp_from_string('compatibility: rocon:/pr2', 'ours/dance')
    >>> str(platform_uri(rapp, Vocabulary.bundled()))
    'rocon:/pr2/*/*/*'
    """
    if app.compatibility is None or isinstance(app, AppFile) and not app.is_registered(vocabulary):
        return None
    try:
        return parse(app.compatibility, vocabulary)
    except RoconURIValueError:
        return None


def _rapp_reasons(rapp: Rapp, robot: Union[str, RoconURI], launch_files: LaunchFiles
                  ) -> Iterator[Reason]:
    if not rapp.is_implementation:
        lacks = ' and no '.join(key for key in ('compatibility', 'launch')
                                if getattr(rapp, key) is None)
        yield Reason(kind=ReasonKind.VIRTUAL, id='virtual',
                     problem='it is virtual: it has no %s' % lacks)
    if rapp.compatibility is not None:
        yield from _platform_reasons(rapp.compatibility, robot)
    if rapp.launch is not None:
        fault = launch_files.look_at(rapp.launch, os.path.dirname(rapp.path)).fault
        if fault is not None:
            yield Reason(kind=ReasonKind.LAUNCH, id=fault.kind, problem=str(fault))


def _platform_reasons(compatibility: str, robot: Union[str, RoconURI]) -> Iterator[Reason]:
    vocabulary = None if isinstance(robot, str) else robot.vocabulary
    try:
        explanation = explain(parse(compatibility, vocabulary), robot)
    except RoconURIValueError as error:
        yield Reason(kind=ReasonKind.PLATFORM, id='platform', problem=str(error))
        return
    if not explanation:
        wrong = ', '.join('%s is %s' % (comparison.field, comparison.b)
                          for comparison in explanation.fields if not comparison.is_compatible)
        yield Reason(kind=ReasonKind.PLATFORM, id='platform',
                     problem="'%s' does not include this robot: %s" % (explanation.a.short, wrong),
                     explanation=explanation)


def _app_file_reasons(app: AppFile, robot: RoconURI, robot_type: Optional[str],
                      launch_files: LaunchFiles) -> Iterator[Reason]:
    if app.is_registered(robot.vocabulary):
        yield from _platform_reasons(str(app.compatibility), robot)
    else:       # app_manager knows no vocabulary, and compares texts
        types = robot.hardware_platform.list if robot_type is None else [robot_type]
        if app.platform not in types and types != ['*']:
            yield Reason(
                kind=ReasonKind.PLATFORM, id='platform',
                problem='platform %s is not that of this robot, %s (compared as text, since %s is '
                        'not registered)' % (quoted(app.platform), quoted('|'.join(types)),
                                             quoted(app.platform)))
    for key, found in app.resources.items():
        if found.kind is not None and (key != 'icon' or found.kind == AMBIGUOUS):
            yield Reason(
                kind=ReasonKind.LAUNCH, id='%s-%s' % (key, found.kind),
                problem='%s %s %s' % (WHAT_RESOURCES_ARE[key], quoted(found.name), found.problem))
        elif key == 'interface':
            problem = interface_problem(found)
            if problem is not None:
                yield Reason(kind=ReasonKind.LAUNCH, id='interface-unreadable',
                             problem='interface file %s %s' % (quoted(found.name), problem))
        elif key == 'launch':
            fault = launch_file_fault(found, launch_files)
            if fault is not None:
                yield Reason(kind=ReasonKind.LAUNCH, id=fault.kind, problem=str(fault))
