"""
The client of a capability server. The capabilities that a program uses run while it lives.

::

    client = CapabilitiesClient()
    client.wait_for_services(10)
    client.use_capability('std_capabilities/RGBDSensor')
    ...
    client.free_capability('std_capabilities/RGBDSensor')

A client makes one bond with the server. When that breaks, because the program ends or dies, the
server frees all that the client used. All methods may be called in any thread.
"""
from __future__ import annotations

import atexit
import logging
import threading
from collections import Counter
from typing import Callable, Dict, Iterable, List, Optional, Set

import capabilities.needs_ros  # noqa: F401
import rospy
from capabilities.bonds import Bond, watch_from_now
from capabilities.lost import LostWatch
from capabilities.msg import CapabilityStatuses
from capabilities.srv import EstablishBond, FreeCapability, UseCapability

__all__ = ['CannotEstablishBondException', 'CapabilitiesClient', 'CapabilityNotInUseException',
           'CapabilityNotRunningException', 'ServiceNotAvailableException']

_SERVICES = {'establish_bond': EstablishBond, 'free_capability': FreeCapability,
             'use_capability': UseCapability}
_RETRY = 1.0        # seconds between two attempts to make the bond anew

_logger = logging.getLogger('rosout.capabilities')


class ServiceNotAvailableException(Exception):
    """
    A service of the server did not come up in time.

    :param str service_name: its name; the attribute has the same name
    """

    def __init__(self, service_name: str) -> None:
        super().__init__("service '%s' is not available" % service_name)
        self.service_name = service_name


class CannotEstablishBondException(Exception):
    """The bond with the server was not formed in time."""

    def __init__(self) -> None:
        super().__init__('no bond with the capability server could be established')


class CapabilityNotRunningException(Exception):
    """
    A capability was to be freed, but does not run.

    :param str interface: its name; the attribute has the same name
    """

    def __init__(self, interface: str) -> None:
        super().__init__("capability '%s' is not running" % interface)
        self.interface = interface


class CapabilityNotInUseException(Exception):
    """
    A capability was to be freed, but this client does not use it.

    :param str interface: its name; the attribute has the same name
    """

    def __init__(self, interface: str) -> None:
        super().__init__("capability '%s' is not used by this client" % interface)
        self.interface = interface


class CapabilitiesClient:
    """
    A client of one server. It contacts the server only when a method is called.

    :param str capability_server_node_name: the name of the server's node
    :param on_lost: called as ``on_lost(interface, text)``, in a thread of the client's, once for
        each capability that it used and that failed, or was stopped by somebody else; the text
        says why
    :param bool strict: let `free_capability` raise the errors that it otherwise only logs
    :param bool reconnect: make the bond again when it has broken and the server is back; the
        earlier uses are not repeated

    ``use_capability`` and the others take ``timeout`` in seconds, the longest to wait for each
    service; None waits for ever.
    """

    def __init__(self, capability_server_node_name: str = '/capability_server',
                 on_lost: Optional[Callable[[str, str], object]] = None, strict: bool = False,
                 reconnect: bool = False) -> None:
        self._name = capability_server_node_name
        self._services: Dict[str, rospy.ServiceProxy] = {
            name: rospy.ServiceProxy('%s/%s' % (self._name, name), kind)
            for name, kind in _SERVICES.items()}
        self._bond: Optional[Bond] = None
        self._bond_id: Optional[str] = None
        self._strict = strict
        self._reconnect = reconnect
        self._uses: Counter[str] = Counter()
        self._lock = threading.RLock()          # for the attributes; not held while waiting
        self._bond_lock = threading.RLock()     # held while a bond is being made
        self._ended = threading.Event()
        self._lost = None if on_lost is None else LostWatch(on_lost, self._name)
        self._subscriber: Optional[rospy.Subscriber] = None
        atexit.register(self.shutdown)

    @property
    def _used_capabilities(self) -> Set[str]:
        """The names of the capabilities that this client uses."""
        with self._lock:
            return {name for name, uses in self._uses.items() if uses > 0}

    def wait_for_services(self, timeout: Optional[float] = None,
                          services: Optional[Iterable[str]] = None) -> bool:
        """
        Wait until services of the server are there.

        :param timeout: float, seconds for each service; None to wait for ever
        :param services: iterable of str, of ``'establish_bond'``, ``'free_capability'`` and
            ``'use_capability'``; None for all three
        :returns: bool, False if one did not come up in time
        :raises ValueError: for the name of another service
        """
        names: List[str] = list(_SERVICES if services is None else services)
        for name in names:
            if name not in _SERVICES:
                raise ValueError("'%s' is not a service of the client, expected %s" % (
                    name, ', '.join(_SERVICES)))
        for name in names:
            service = self._services[name]
            try:
                rospy.wait_for_service(service.resolved_name, timeout)
            except rospy.ROSException:
                _logger.warning("service '%s' did not come up in time", service.resolved_name)
                return False
        return True

    def establish_bond(self, timeout: Optional[float] = None) -> Optional[str]:
        """
        Make a bond with the server. An earlier bond is broken, and its uses are freed.

        :param timeout: float, seconds to wait for the service, and again for the bond; None to
            wait for ever
        :returns: str, the id of the bond, or None if it was not formed in time
        :raises rospy.ServiceException: if the server refuses
        """
        with self._bond_lock:
            self._break_bond()
            if not self.wait_for_services(timeout, ['establish_bond']):
                return None
            bond_id: str = self._call('establish_bond').bond_id
            bond = Bond('%s/bonds' % self._name, bond_id, lambda: self._broken(bond_id))
            bond.set_formed_callback(lambda: watch_from_now(bond))
            bond.start()
            if not bond.wait_until_formed(None if timeout is None else rospy.Duration(timeout)):
                bond.shutdown()
                return None
            with self._lock:
                self._bond, self._bond_id = bond, bond_id
            if self._lost is not None and self._subscriber is None:
                self._subscriber = rospy.Subscriber(self._name + '/status', CapabilityStatuses,
                                                    self._lost.status)
            return bond_id

    def use_capability(self, capability_interface: str, preferred_provider: Optional[str] = None,
                       timeout: Optional[float] = None) -> bool:
        """
        Use a capability; it is started if it does not run.

        :param str capability_interface: its name, ``package/Name``
        :param preferred_provider: str, the provider that is to run; None for the default one
        :param timeout: float, seconds to wait for each service; None to wait for ever
        :returns: bool, True
        :raises CannotEstablishBondException: if there is no bond yet, and none could be made
        :raises ServiceNotAvailableException: if the service did not come up in time
        :raises rospy.ServiceException: if the server refuses; the text says why
        """
        with self._bond_lock:
            if self._bond is not None and self._bond.is_broken():
                self._break_bond()
            if self._bond_id is None and self.establish_bond(timeout) is None:
                raise CannotEstablishBondException()
            bond_id = self._bond_id
        self._wait_for('use_capability', timeout)
        self._call('use_capability', capability_interface, preferred_provider or '', bond_id)
        with self._lock:
            self._uses[capability_interface] += 1
        if self._lost is not None:
            self._lost.used(capability_interface, preferred_provider)
        return True

    def free_capability(self, capability_interface: str, timeout: Optional[float] = None) -> bool:
        """
        Free a capability that was used; it is stopped if nobody else wants it.

        :param str capability_interface: its name, ``package/Name``
        :param timeout: float, seconds to wait for the service; None to wait for ever
        :returns: bool, True
        :raises CapabilityNotRunningException: if it does not run
        :raises CapabilityNotInUseException: if this client does not use it, and is strict
        :raises ServiceNotAvailableException: if the service did not come up in time
        :raises rospy.ServiceException: for any other error of the server, if this client is strict
        """
        self._wait_for('free_capability', timeout)
        with self._lock:
            is_used = self._uses[capability_interface] > 0
            if is_used:
                self._uses[capability_interface] -= 1
            is_last = self._uses[capability_interface] == 0
        if is_last and self._lost is not None:
            self._lost.freed(capability_interface)
        if not is_used:
            _logger.error("capability '%s' is not used by this client", capability_interface)
        try:
            self._call('free_capability', capability_interface, self._bond_id or '')
        except rospy.ServiceException as error:
            text = str(error)
            if 'Cannot free Capability' in text and 'because it is not running' in text:
                raise CapabilityNotRunningException(capability_interface) from None
            if self._strict and is_used:
                raise
            _logger.error("capability '%s' was not freed: %s", capability_interface, text)
        if self._strict and not is_used:
            raise CapabilityNotInUseException(capability_interface)
        return True

    def shutdown(self) -> None:
        """Break the bond, if there is one: the server frees all that this client used."""
        self._ended.set()
        atexit.unregister(self.shutdown)
        self._break_bond()
        if self._subscriber is not None:
            self._subscriber.unregister()

    def _wait_for(self, service: str, timeout: Optional[float]) -> None:
        if not self.wait_for_services(timeout, [service]):
            raise ServiceNotAvailableException(self._services[service].resolved_name)

    def _call(self, service: str, *arguments: object) -> rospy.Message:
        """Call a service by a proxy for this call only: threads that share one mix up answers."""
        name = self._services[service].resolved_name
        return rospy.ServiceProxy(name, _SERVICES[service])(*arguments)

    def _break_bond(self) -> None:
        """Break the bond on purpose; its capabilities count as freed, not as lost."""
        with self._lock:
            bond, self._bond, self._bond_id = self._bond, None, None
            self._uses.clear()
        if self._lost is not None:
            self._lost.freed_all()
        if bond is not None:
            bond.shutdown()

    def _broken(self, bond_id: str) -> None:
        """The bond was broken: by the server, by its end, or by a call of ``break_bond``."""
        with self._lock:
            if self._bond_id != bond_id:
                return
            if self._reconnect:
                self._bond_id = None
            self._uses.clear()
        if self._lost is not None:
            self._lost.lost_all('the bond with the capability server was broken')
        if self._reconnect and not self._ended.is_set():
            threading.Thread(target=self._make_anew, daemon=True).start()

    def _make_anew(self) -> None:
        """Make the bond again, as soon as the server is there."""
        while not self._ended.is_set() and not rospy.is_shutdown() and self._bond_id is None:
            try:
                self.establish_bond(_RETRY)
            except rospy.ServiceException:      # the server has just gone again
                pass
            self._ended.wait(_RETRY / 10)
