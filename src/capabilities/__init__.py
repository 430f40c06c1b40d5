"""What robots can do: capability interfaces, their providers, and what runs them for others."""
import os
import sys

# In a devel space the messages are in another folder than the sources. pkgutil.extend_path would
# also take the ROS package of this name, a folder without Python code, where it meets that.
for _entry in sys.path:
    _folder = os.path.join(_entry, __name__)
    if _folder not in __path__ and os.path.isfile(os.path.join(_folder, '__init__.py')):
        __path__.append(_folder)
