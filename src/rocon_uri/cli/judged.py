"""What verbs that judge apps are given: the robot, the default providers, and the names of apps."""
from __future__ import annotations

from rocon_uri.cli.given import GivenURI, say
from rocon_uri.cli.packages import meant
from rocon_uri.exceptions import RoconURIValueError
from rocon_uri.platform import (
    default_robot_name, default_robot_type, generate_platform_rocon_uri)
from rocon_uri.sources.wording import NamesByPart, did_you_mean, quoted
from rocon_uri.uri import parse

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Dict, Iterable, List, Optional, Sequence
    from capabilities.spec_index import SpecIndex
    from rocon_uri.apps.runnable import App
    from rocon_uri.cli.packages import PackageReport
    from rocon_uri.vocabulary import Vocabulary
    from rocon_uri.workspace import Workspace

__all__ = ['add_defaults', 'named_apps', 'read_defaults', 'read_robot']


def add_defaults(parser: argparse.ArgumentParser) -> None:
    """Let a verb take ``--defaults``."""
    parser.add_argument('--defaults', metavar='FILE',
                        help='which provider to take where there are several')


def named_apps(names: Sequence[str], exported: Workspace, report: PackageReport) -> List[App]:
    """The apps of these names, of which two may have one; a name that is not there is reported."""
    apps = list(exported.apps())
    for name in names:
        if not any(app.name == name for app in apps):
            suggestions = meant(name, {app.name: None for app in apps})
            report.bad('no app has the name %s%s' % (quoted(name), did_you_mean(suggestions)),
                       suggestions=suggestions)
    return [app for name in dict.fromkeys(names) for app in apps if app.name == name]


def read_robot(text: Optional[str], vocabulary: Vocabulary,
               report: PackageReport) -> Optional[GivenURI]:
    """The robot; one that is not registered is reported, and may run some apps nevertheless."""
    if text is None:
        text = generate_platform_rocon_uri(default_robot_type, default_robot_name())
    try:
        return GivenURI(parse(text, vocabulary), text)
    except RoconURIValueError as error:
        report.bad_uri(error)
    try:
        return GivenURI(parse(text, vocabulary.opened()), text)
    except RoconURIValueError:
        return None


def read_defaults(path: Optional[str], spec_index: SpecIndex,
                  report: PackageReport) -> Dict[str, str]:
    """
    The default providers by interface; none if the file is bad, which is reported.

    What is probably a misspelt interface is mentioned. One of another package may stand there.
    """
    if path is None:
        return {}
    from rocon_uri.sources.checked import Reading   # these load YAML
    from rocon_uri.sources.yaml_source import YamlError, read_file
    try:
        defaults = Reading(path, YamlError).load(
            read_file(path), 'the file', 'a mapping from interfaces to providers')
        if isinstance(defaults.get('defaults'), dict):
            defaults = defaults.mapping('defaults')
        providers = {defaults.key_text(key, 'the name of an interface'):
                     defaults.text_at(key, 'the default provider of %s') for key in defaults}
    except (OSError, YamlError) as error:
        report.bad_file(error)
        return {}
    _mention_misspelt(providers, NamesByPart(
        [*spec_index.interface_names, *spec_index.semantic_interface_names]))
    return providers


def _mention_misspelt(names: Iterable[str], interfaces: NamesByPart) -> None:
    for name in names:
        meant = [] if name in interfaces else interfaces.near_misses(name)
        if meant:
            say('rocon_uri: note: a default for %s is not used: there is no such interface%s' % (
                quoted(name), did_you_mean(meant)))
