"""For editors and type checkers: the names that `__init__.py` imports when they are used."""
from . import (
    announcement as announcement, announcer as announcer, apps as apps, cli as cli,
    compatibility as compatibility, exceptions as exceptions, exported_rules as exported_rules,
    field as field, field_vocabulary as field_vocabulary, grammar as grammar, lint as lint,
    messages as messages, name_pattern as name_pattern, platform as platform, rapps as rapps,
    resource_database as resource_database, resource_directory as resource_directory,
    resource_index as resource_index, ros_names as ros_names, sources as sources, uri as uri,
    vocabulary as vocabulary, workspace as workspace, yaml_source as yaml_source)
from .compatibility import Relation as Relation, explain as explain, relation as relation
from .exceptions import (
    PatternTooComplex as PatternTooComplex, RoconURIValueError as RoconURIValueError)
from .field import Field as Field
from .platform import generate_platform_rocon_uri as generate_platform_rocon_uri
from .resource_index import ResourceIndex as ResourceIndex
from .uri import (
    RoconURI as RoconURI, default_uri_string as default_uri_string, is_compatible as
    is_compatible, parse as parse)
from .version import __version__ as __version__
from .vocabulary import Vocabulary as Vocabulary

__all__ = [
    'Field', 'PatternTooComplex', 'Relation', 'ResourceIndex', 'RoconURI',
    'RoconURIValueError', 'Vocabulary', 'default_uri_string', 'explain',
    'generate_platform_rocon_uri', 'is_compatible', 'parse', 'relation']
