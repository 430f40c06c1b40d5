"""The sections of a capability interface: topics, services, actions, parameters, by grouping."""
from __future__ import annotations

from typing import Dict, Iterator, List, Optional, Tuple

from capabilities.specs.common import NO_DESCRIPTION
from rocon_uri.sources.wording import quoted, shown, with_article

__all__ = ['GROUPINGS', 'SECTIONS', 'Interface', 'InterfaceElement']

#: the sections whose elements have a type, with the kind of their elements
SECTIONS = {'topics': 'topic', 'services': 'service', 'actions': 'action',
            'parameters': 'parameter'}
#: the groups that the elements of a section may be in
GROUPINGS = ('requires', 'provides')

_ELEMENT_KINDS = (*SECTIONS.values(), 'dynamic_parameter')


class InterfaceElement:
    """
    One topic, service, action or parameter of an interface.

    :param str name: its ROS name
    :param str element_kind: ``'topic'``, ``'service'``, ``'action'``, ``'parameter'`` or
        ``'dynamic_parameter'``; the attribute is ``kind``
    :param str element_type: ``package/Type``, or the type of a parameter; ``None`` if there is
        none; also the attribute ``type``
    :param str description: free text; ``None`` gives ``'No description given.'``
    :raises ValueError: if the kind is another

    >>> InterfaceElement('scan', 'topic', 'sensor_msgs/LaserScan').type
    'sensor_msgs/LaserScan'
    """

    __module__ = 'capabilities.specs.interface'     # where the specification has it

    def __init__(self, name: str, element_kind: str, element_type: Optional[str] = None,
                 description: Optional[str] = None) -> None:
        if element_kind not in _ELEMENT_KINDS:
            raise ValueError('%s is not a kind of interface element, expected %s' % (
                shown(element_kind), ', '.join(_ELEMENT_KINDS)))
        self.name = name
        self.kind = element_kind
        self.type = element_type
        self.description = NO_DESCRIPTION if description is None else description

    @property
    def element_type(self) -> Optional[str]:
        """The same as ``type``."""
        return self.type


class _Elements:
    """A property of an interface: the elements of a section, or those in one grouping of it."""

    def __init__(self, section: str, grouping: Optional[str] = None) -> None:
        self._section = section
        self._grouping = grouping
        self.__doc__ = 'The %s%s by name: a new dict of `InterfaceElement`.' % (
            section, ' in the grouping ``%s``' % grouping if grouping else '')

    def __get__(self, interface: Interface, owner: object = None) -> Dict[str, InterfaceElement]:
        if interface is None:       # it is looked up in the class
            return self
        return {name: element for section, name, element, grouping in interface.elements()
                if section == self._section and self._grouping in (None, grouping)}

    def __set__(self, interface: Interface, elements: object) -> None:
        raise AttributeError("can't set attribute")


class Interface:
    """
    The content of an interface.

    A topic, service, action or parameter may be in the grouping ``requires`` or ``provides``. That
    is information for people; nothing depends on it. Each property returns a new container, in the
    order in which the elements were added.

    >>> interface = Interface()
    >>> interface.add_topic('scan', InterfaceElement('scan', 'topic', 'sensor_msgs/LaserScan'),
    ...                     grouping='provides')
    >>> list(interface.topics), list(interface.required_topics)
    (['scan'], [])
    """

    topics = _Elements('topics')
    required_topics = _Elements('topics', 'requires')
    provided_topics = _Elements('topics', 'provides')
    services = _Elements('services')
    required_services = _Elements('services', 'requires')
    provided_services = _Elements('services', 'provides')
    actions = _Elements('actions')
    required_actions = _Elements('actions', 'requires')
    provided_actions = _Elements('actions', 'provides')
    parameters = _Elements('parameters')
    required_parameters = _Elements('parameters', 'requires')
    provided_parameters = _Elements('parameters', 'provides')

    def __init__(self) -> None:
        self._elements: Dict[str, Dict[str, Tuple[InterfaceElement, Optional[str]]]] = {
            section: {} for section in SECTIONS}
        self._dynamic_parameters: Dict[str, None] = {}     # a set that keeps the order

    @property
    def dynamic_parameters(self) -> List[str]:
        """The names of the dynamic parameters: a new list of str."""
        return list(self._dynamic_parameters)

    def add_topic(self, topic_name: str, interface_element: InterfaceElement,
                  grouping: Optional[str] = None) -> None:
        """
        Add a topic.

        :param str topic_name: its name
        :param InterfaceElement interface_element: what it is
        :param str grouping: ``'requires'``, ``'provides'`` or ``None``
        :raises ValueError: if the grouping is another, or the name is that of a grouping and there
            is none: a file cannot express that
        :raises RuntimeError: if the interface has a topic of that name
        :raises TypeError: if the name is not a str, or what it is not an InterfaceElement
        """
        self.add_element('topics', topic_name, interface_element, grouping)

    def add_service(self, service_name: str, interface_element: InterfaceElement,
                    grouping: Optional[str] = None) -> None:
        """Add a service. Parameters and errors are those of `add_topic`."""
        self.add_element('services', service_name, interface_element, grouping)

    def add_action(self, action_name: str, interface_element: InterfaceElement,
                   grouping: Optional[str] = None) -> None:
        """Add an action. Parameters and errors are those of `add_topic`."""
        self.add_element('actions', action_name, interface_element, grouping)

    def add_parameter(self, parameter_name: str, interface_element: InterfaceElement,
                      grouping: Optional[str] = None) -> None:
        """Add a parameter. Parameters and errors are those of `add_topic`."""
        self.add_element('parameters', parameter_name, interface_element, grouping)

    def add_dynamic_parameter(self, dynamic_parameter_name: str) -> None:
        """
        Add a dynamic parameter.

        :param str dynamic_parameter_name: its name
        :raises RuntimeError: if the interface has a dynamic parameter of that name
        :raises TypeError: if the name is not a str
        """
        _check_name('dynamic_parameter', dynamic_parameter_name)
        if dynamic_parameter_name in self._dynamic_parameters:
            raise RuntimeError('dynamic_parameter %s is already in the interface'
                               % shown(dynamic_parameter_name))
        self._dynamic_parameters[dynamic_parameter_name] = None

    def add_element(self, section: str, name: str, element: InterfaceElement,
                    grouping: Optional[str] = None) -> None:
        """
        Add an element to a section. Parameters and errors are those of `add_topic`.

        :param str section: ``'topics'``, ``'services'``, ``'actions'`` or ``'parameters'``
        :raises KeyError: if it is another
        """
        _check_name(SECTIONS[section], name)
        if not isinstance(element, InterfaceElement):
            raise TypeError('%s %s is %s, expected an InterfaceElement' % (
                SECTIONS[section], shown(name), shown(element)))
        if grouping is None and name in GROUPINGS:
            raise ValueError('a name cannot be %s outside of a grouping' % quoted(name))
        if grouping is not None and grouping not in GROUPINGS:
            raise ValueError("%s is not a grouping, expected 'requires', 'provides' or None"
                             % shown(grouping))
        if name in self._elements[section]:
            raise RuntimeError('%s %s is already in the interface' % (
                SECTIONS[section], shown(name)))
        self._elements[section][name] = element, grouping

    def elements(self) -> Iterator[Tuple[str, str, InterfaceElement, Optional[str]]]:
        """
        All elements that have a type: an iterator of (section, name, element, grouping).

        For example ``('topics', 'scan', <InterfaceElement>, 'provides')``.
        """
        for section, elements in self._elements.items():
            for name, (element, grouping) in elements.items():
                yield section, name, element, grouping


def _check_name(kind: str, name: object) -> None:
    """Refuse a name that a caller made of something else."""
    if not isinstance(name, str):
        raise TypeError('the name of %s is %s, expected text' % (with_article(kind), shown(name)))
