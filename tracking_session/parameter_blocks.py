# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which nodes a ROS parameter file is for, and what it says to each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
import re
from typing import Any

import yaml

LEAF = 'ros__parameters'
LONGEST = 1_000_000  # characters of a file
_WILDCARDS = {'/**': '(/[^/]+)*', '/*': '/[^/]+'}

Block = tuple[str, Mapping[Any, Any]]  # name or pattern of its nodes, its parameters


class Loader(yaml.SafeLoader):
    """YAML as rcl reads it: 1e5 and 1.0e5 are numbers; no aliases, which could grow a file."""

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Return the next node; an alias is refused."""
        if self.check_event(yaml.AliasEvent):
            raise yaml.YAMLError('aliases (*name) are not for parameter files')
        return super().compose_node(parent, index)


Loader.add_implicit_resolver(
    'tag:yaml.org,2002:float',
    re.compile(r'[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)[eE][-+]?[0-9]+$'),
    list('-+.0123456789'),
)


class BadParameterFile(ValueError):  # noqa: N818 (it is the file that is bad)
    """A parameter file that says nothing usable; names the file and what is wrong with it."""


def read_blocks(path: Path | str) -> list[Block]:
    """
    Return the blocks of a parameter file, in its order.

    Raises
    ------
    BadParameterFile
        If there is no such file or it has none.

    """
    try:
        document = yaml.load(_text_of(Path(path)), Loader)  # noqa: S506 (a SafeLoader)
    except (OSError, UnicodeDecodeError) as error:
        raise BadParameterFile(f'{path} cannot be read: {error}') from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:  # 2001-99-99 is a ValueError
        raise BadParameterFile(f'{path} is not YAML: {error}') from error
    if not isinstance(document, dict):
        raise BadParameterFile(f"{path}: expected '/**: {LEAF}: name: value'")
    blocks = list(_blocks(document, ''))
    if not blocks:
        raise BadParameterFile(f"{path}: no '{LEAF}:' in it; expected '/**: {LEAF}: name: value'")
    return blocks


def _text_of(path: Path) -> str:
    with path.open(encoding='utf-8') as file:
        text = file.read(LONGEST + 1)
    if len(text) > LONGEST:
        raise OSError(f'more than {LONGEST} characters')
    return text


def _blocks(tree: Mapping[Any, Any], name: str) -> Iterator[Block]:
    """Yield node name and parameters of each block; namespaces may be nested keys."""
    for key, below in tree.items():
        if not isinstance(below, dict):
            continue
        if key == LEAF:
            yield name, below
        else:
            yield from _blocks(below, f'{name}/{str(key).strip("/")}')


def blocks_for(node: str, blocks: Sequence[Block], path: Path | str) -> list[Mapping[Any, Any]]:
    """
    Return the parameters of the blocks that are for a node, given by its full name.

    Raises
    ------
    BadParameterFile
        If none is; says for whom they are.

    """
    mine = [block for name, block in blocks if _fits(name, node)]
    if not mine:
        others = ', '.join(sorted({name for name, _ in blocks}))
        raise BadParameterFile(
            f"{path}: its parameters are for {others}, none for {node}; '/**:' is for all"
        )
    return mine


def _fits(pattern: str, node: str) -> bool:
    """Whether a block's name, wildcards included, is that of the node."""
    parts = (f'/{part}' for part in pattern.strip('/').split('/'))
    expression = ''.join(_WILDCARDS.get(part, re.escape(part)) for part in parts)
    return re.fullmatch(expression, node) is not None


def missing_files(arguments: Sequence[str]) -> list[str]:
    """Return the parameter files on a command line that are not there."""
    files = [path for option, path in pairwise(arguments) if option == '--params-file']
    return [path for path in files if not Path(path).exists()]


def foreign_files(node: str, arguments: Sequence[str]) -> Iterator[str]:
    """Yield a line for each parameter file on a command line that says nothing to this node."""
    for option, path in pairwise(arguments):
        if option == '--params-file':
            try:
                blocks_for(node, read_blocks(path), path)
            except BadParameterFile as error:
                yield str(error)
