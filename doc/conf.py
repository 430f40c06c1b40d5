"""How Sphinx builds the documentation: ``sphinx-build -W doc build/doc``."""
import os
import sys
import xml.etree.ElementTree

_here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(_here, '..', 'src'))

project = 'rocon_uri'
author = 'the rocon_uri authors'
copyright = author      # noqa: A001     # Sphinx wants it by this name
version = release = xml.etree.ElementTree.parse(
    os.path.join(_here, '..', 'package.xml')).findtext('version')

extensions = ['sphinx.ext.autodoc']
autodoc_member_order = 'bysource'
autodoc_default_options = {'members': True}
default_role = 'py:obj'
exclude_patterns = ['_build']
highlight_language = 'none'     # most blocks are output or URIs; others say what they are
html_theme = 'alabaster'
html_theme_options = {      # wide enough for 100 columns of code
    'body_max_width': 'auto', 'code_font_size': '0.8em', 'page_width': '1240px'}
html_static_path = ['_static']
