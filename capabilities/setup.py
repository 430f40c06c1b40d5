"""
What catkin installs of the Python package capabilities, which is in the folder src of rocon_uri.

That package lists it too, for pip, and for catkin where this one is left out.
"""
from pathlib import Path

from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

SOURCE = Path(__file__).resolve().parent.parent / 'src'

setup(**generate_distutils_setup(
    packages=find_packages(str(SOURCE), include=['capabilities', 'capabilities.*']),
    package_dir={'': '../src'},
    package_data={'': ['py.typed'], 'capabilities': ['*.launch', 'placeholder']},
))
