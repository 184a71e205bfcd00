# SPDX-License-Identifier: Apache-2.0
"""What a stream of several components holds, and by which name or number one is meant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, List, Optional, Sequence, Tuple, Union

from . import _components_library as c
from . import _values as values
from ._errors import TksUsageError

# A name, of a texture too if it has the name of heights; a number; or several of these.
ComponentLike = Union[str, int, Sequence[Union[str, int]]]
Chosen = Tuple[Union[str, int], ...]


@dataclass(frozen=True)
class Component:
    """One of the rasters that a stream holds (`Stream.components`)."""

    number: int
    """Its place in the stream, from 0."""
    name: Optional[str]
    kind: str
    """"heights", "texture", or "unknown": of a later version, which this one passes over."""
    shape: Optional[Tuple[int, int]]
    """(rows, columns) of what is coded: of a cube its faces, one below the other."""
    bytes: int
    """What there is of it."""
    taken: bool
    """It is what the stream gives as its heights, or as its texture."""


def from_struct(number: int, raw: c.Component) -> Component:
    return Component(
        number=number,
        name=(raw.name or b"").decode("utf-8", "replace") or None,
        kind=c.COMPONENT_KINDS[raw.kind],
        shape=(raw.height, raw.width) if raw.width > 0 else None,
        bytes=raw.available_bytes,
        taken=bool(raw.is_taken),
    )


def chosen(given: Optional[ComponentLike]) -> Chosen:
    """The names and numbers that were given."""
    if given is None:
        return ()
    several = isinstance(given, (list, tuple))
    return tuple(_one(each) for each in (given if several else [given]))  # type: ignore


def _one(given: Any) -> Union[str, int]:
    return given if isinstance(given, str) else values.unsigned(given, "component")


def numbers_of(asked: Union[str, int], held: List[Component]) -> List[int]:
    """Those of a name, or that of the number. Heights and a texture may have one name."""
    if isinstance(asked, int):
        return [asked]
    numbers = [one.number for one in held if one.name == asked]
    numbers = numbers or [one.number for one in held if str(one.number) == asked]
    if not numbers:
        raise TksUsageError(
            f"The stream has no component {values.told(asked)}: `components` lists those it has."
        )
    return numbers
