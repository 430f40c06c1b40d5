"""For editors and type checkers: the modules that `__init__.py` imports when they are used."""
from . import (
    app_file as app_file, installed as installed, rapp as rapp, rapps as rapps, runnable as
    runnable)
