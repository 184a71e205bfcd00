# SPDX-License-Identifier: Apache-2.0
"""What notebooks show of a stream: a small picture and a table."""

from __future__ import annotations

import base64
import html
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

# Light from the upper left, as on maps.
_LIGHT = np.array([-1.0, -1.0, 1.5]) / np.linalg.norm([-1.0, -1.0, 1.5])


def relief(heights: NDArray[Any], spacing: float) -> NDArray[Any]:
    """Shaded heights, grey; white where there is none."""
    known = np.where(np.isnan(heights), np.nanmean(heights), heights) if _any(heights) else None
    if known is None or min(known.shape) < 2:
        return np.full(heights.shape, 255, "u1")
    south, east = np.gradient(known.astype("f8"))
    # Ground of any steepness gets shades: its slopes are told as multiples of their mean.
    scale = np.sqrt(np.mean(south**2 + east**2)) or spacing
    normal = np.stack([-east / scale, -south / scale, np.ones(known.shape)])
    shade = np.tensordot(_LIGHT, normal / np.linalg.norm(normal, axis=0), 1)
    grey = np.clip(40 + 215 * shade, 0, 255).astype("u1")
    return np.where(np.isnan(heights), np.uint8(255), grey)


def eight_bits(texels: NDArray[Any], white: int) -> NDArray[Any]:
    if texels.dtype == np.uint8:
        return texels
    return (np.minimum(texels.astype("u4"), white) * 255 // white).astype("u1")


def png(pixels: NDArray[Any]) -> bytes:
    """PNG (RFC 2083) of uint8 (rows, columns[, channels])."""
    channels = 1 if pixels.ndim == 2 else pixels.shape[2]
    rows = pixels.reshape(pixels.shape[0], -1)
    filtered = np.concatenate([np.zeros((rows.shape[0], 1), "u1"), rows], axis=1)
    kind = {1: 0, 2: 4, 3: 2, 4: 6}[channels]
    head = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, kind, 0, 0, 0)
    chunks = [(b"IHDR", head), (b"IDAT", zlib.compress(filtered.tobytes())), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        for name, body in chunks
    )


def page(picture: bytes, facts: dict[str, Any]) -> str:
    rows = "".join(
        f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
        f"<td style='text-align:left'>{html.escape(str(value))}</td></tr>"
        for name, value in facts.items()
        if value is not None
    )
    data = base64.b64encode(picture).decode()
    return (
        "<div style='display:flex;gap:1em;align-items:flex-start'>"
        f"<img alt='' src='data:image/png;base64,{data}'><table>{rows}</table></div>"
    )


def _any(heights: NDArray[Any]) -> bool:
    return bool(heights.size) and not bool(np.isnan(heights).all())
