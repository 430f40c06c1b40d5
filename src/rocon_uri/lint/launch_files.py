"""What can be wrong with a launch file that an app or a provider names."""
from __future__ import annotations

import os
from typing import List

from rocon_uri.lint.checked_file import CheckedFile
from rocon_uri.lint.finding import ERROR, Finding
from rocon_uri.sources.launch_file import MISSING, LaunchFiles
from rocon_uri.sources.located import Place

__all__ = ['check_launch_file']


def check_launch_file(name: str, place: Place, file: CheckedFile, launch_files: LaunchFiles,
                      if_in_package: str = ERROR) -> List[Finding]:
    """
    A launch file has to be one that can be started, by the facts that the verdict on apps has.

    :param str name: the launch file, as the file says it
    :param place: where in the file it does
    :param CheckedFile file: what names it, which gets the findings that are about the name
    :param LaunchFiles launch_files: what was read already
    :param str if_in_package: `ERROR` or `WARNING`, where it is there if it is taken to be relative
        to the package
    :returns: list of `Finding`, those that are about its content, in its own lines
    """
    folder = os.path.dirname(os.path.abspath(file.path))
    fault = launch_files.look_at(name, folder).fault
    if fault is None:
        return []
    if fault.line is not None:
        launch_file = CheckedFile(os.path.normpath(fault.path), file.package_folder)
        launch_file.error('launch file %s' % fault.problem, (fault.line, fault.column))
        return launch_file.findings
    is_in_package = fault.kind == MISSING and os.path.isfile(
        os.path.join(file.package_folder, name))
    file.add(if_in_package if is_in_package else ERROR, str(fault), place)
    return []
