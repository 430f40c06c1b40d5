"""The parameters of the capability server, read once and checked."""
from __future__ import annotations

import logging
from typing import Callable, Dict, List, NamedTuple, Optional, Tuple

from rocon_uri.sources.ros_names import is_legal_resource_name
from rocon_uri.sources.wording import did_you_mean, near_misses, quoted

__all__ = ['InvalidConfiguration', 'Parameters', 'read_parameters']

#: gets a parameter by its name, or else the given default
Get = Callable[[str, object], object]

_logger = logging.getLogger('rosout.capabilities')


class InvalidConfiguration(Exception):
    """
    A configuration that the server does not start with.

    :param lines: iterable of str, what is at fault, one line each; the attribute is a list
    """

    def __init__(self, lines: List[str]) -> None:
        super().__init__('; '.join(lines))
        self.lines = list(lines)


class Parameters(NamedTuple):
    """
    The private parameters of the server.

    >>> read_parameters(lambda name, default: default).autostart
    []
    """

    #: only specs of these packages; empty for all
    package_whitelist: List[str]
    #: no specs of these packages
    package_blacklist: List[str]
    #: only specs of these names; empty for all
    whitelist: List[str]
    #: not these specs
    blacklist: List[str]
    #: the default provider by the name of the interface
    defaults: Dict[str, str]
    #: is an interface with several providers and no default an error?
    missing_default_provider_is_an_error: bool
    #: base name; None for that of the node and ``_nodelet_manager``
    nodelet_manager_name: Optional[str]
    #: show the output of all nodes?
    use_screen: bool
    #: log details for developers?
    debug: bool
    #: the capabilities to start
    autostart: List[str]
    #: keep the dependents of a capability that ended unasked, instead of stopping them?
    keep_dependents: bool
    #: end the server when the nodelet manager ends, instead of starting it again?
    ends_without_nodelet_manager: bool
    #: start a nodelet manager?
    nodelet_manager: bool


def read_parameters(get: Get, screen: bool = False) -> Parameters:
    """
    Read the parameters of the server.

    A list or a bool of another type is logged as an error, and its default taken.

    :param get: called with the name of a private parameter (``~whitelist``) and a default
    :param bool screen: the default of ``~use_screen``
    :returns: `Parameters`
    :raises InvalidConfiguration: if a default, a choice or a node name is not valid
    """
    defaults, faults = _defaults(get('~defaults', None))
    keep_dependents, more_faults = _choice(get, '~on_dependency_lost', ('stop', 'keep'))
    ends, still_more_faults = _choice(get, '~on_nodelet_manager_lost', ('restart', 'stop'))
    faults += more_faults + still_more_faults
    name = get('~nodelet_manager_name', None)
    if name is not None and not (
            isinstance(name, str) and is_legal_resource_name(name.lstrip('/'))):
        faults.append('parameter ~nodelet_manager_name is %s, which is not a legal node name'
                      % quoted(str(name)))
    if faults:
        raise InvalidConfiguration(faults)
    return Parameters(
        package_whitelist=_names(get, '~package_whitelist'),
        package_blacklist=_names(get, '~package_blacklist'),
        whitelist=_names(get, '~whitelist'),
        blacklist=_names(get, '~blacklist'),
        defaults=defaults,
        missing_default_provider_is_an_error=_flag(
            get, '~missing_default_provider_is_an_error', False),
        nodelet_manager_name=name if isinstance(name, str) else None,
        use_screen=_flag(get, '~use_screen', screen),
        debug=_flag(get, '~debug', False),
        autostart=_names(get, '~autostart'),
        keep_dependents=keep_dependents,
        ends_without_nodelet_manager=ends,
        nodelet_manager=_flag(get, '~nodelet_manager', True))


def _names(get: Get, parameter: str) -> List[str]:
    """A parameter that is a list of names."""
    value = get(parameter, None)
    if value is None:
        return []
    if isinstance(value, list) and all(isinstance(name, str) for name in value):
        return value
    _logger.error('parameter %s is not a list of names, and is ignored', parameter)
    return []


def _flag(get: Get, parameter: str, default: bool) -> bool:
    """A parameter that is true or false."""
    value = get(parameter, default)
    if isinstance(value, bool):
        return value
    _logger.error('parameter %s is neither true nor false, and is taken as %s', parameter,
                  str(default).lower())
    return default


def _choice(get: Get, parameter: str, choices: Tuple[str, str]) -> Tuple[bool, List[str]]:
    """Whether a parameter with two possible words is the second, and what is at fault."""
    value = get(parameter, choices[0])
    if value in choices:
        return value == choices[1], []
    return False, ['parameter %s is %s, expected %s%s' % (
        parameter, quoted(str(value)), ' or '.join(choices),
        did_you_mean(near_misses(str(value), choices)))]


def _defaults(value: object) -> Tuple[Dict[str, str], List[str]]:
    """The default providers, whose names may be keys or paths of keys; and what is at fault."""
    defaults: Dict[str, str] = {}
    faults: List[str] = []
    waiting: List[Tuple[str, object]] = [('', {} if value is None else value)]
    while waiting:
        name, value = waiting.pop(0)
        if isinstance(value, dict):
            waiting += [('%s/%s' % (name, str(key).strip('/')), below)
                        for key, below in value.items()]
        elif isinstance(value, str):
            defaults[name.lstrip('/')] = value
        else:
            faults.append('parameter ~defaults%s is not the name of a provider' % name)
    return defaults, faults
