"""For editors and type checkers: the modules that `__init__.py` imports when they are used."""
from . import (
    checked as checked, encoding as encoding, launch_file as launch_file, located as located,
    manifest as manifest, packages as packages, resources as resources, ros_names as ros_names,
    submodules as submodules, walk as walk, wording as wording, yaml_data as yaml_data,
    yaml_events as yaml_events, yaml_scalars as yaml_scalars, yaml_source as yaml_source)
