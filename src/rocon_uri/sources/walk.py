"""A walk through the folders below one."""
from __future__ import annotations

import os
from typing import Iterator, List, Tuple

__all__ = ['leads_to_folder', 'walk']


def walk(folder: str, follow_links: bool = False) -> Iterator[Tuple[str, List[str], List[str]]]:
    """
    Walk as `os.walk` does, which recurses before Python 3.12: a path can be 2,000 folders deep.

    The names are sorted. Hidden folders, and folders that cannot be read, are left out.

    :param str folder: where to begin
    :param bool follow_links: are folders walked that symbolic links lead to?
    :returns: iterator of (path, names of the folders, names of the files); who takes names of
        folders out of the list leaves out what is below them

    >>> [path for path, _, files in walk('examples/workspace') if 'defaults.yaml' in files]
    ['examples/workspace']
    """
    waiting = [folder]
    while waiting:
        path = waiting.pop()
        folders: List[str] = []
        files: List[str] = []
        links = set()
        try:
            with os.scandir(path) as entries:
                for entry in entries:
                    if not leads_to_folder(entry):
                        files.append(entry.name)
                    elif not entry.name.startswith('.'):
                        folders.append(entry.name)
                        if entry.is_symlink():
                            links.add(entry.name)
        except OSError:     # it has gone, or its path is too long
            continue
        folders.sort()
        yield path, folders, sorted(files)
        waiting += [os.path.join(path, name) for name in reversed(folders)
                    if follow_links or name not in links]


def leads_to_folder(entry: os.DirEntry[str]) -> bool:
    """Is an entry a folder, or a symbolic link to one?"""
    try:
        return entry.is_dir()
    except OSError:     # a symbolic link to itself
        return False
