# SPDX-License-Identifier: Apache-2.0
"""Terrains that tests share. All are made here, and small."""

from pathlib import Path

import numpy as np
import pytest

SAMPLES = ("u1", "i1", "u2", "i2", "u4", "i4", "f4")
REPOSITORY = Path(__file__).resolve().parents[4]


def terrain(rows=45, columns=59, dtype="f4", seed=1):
    """Hills with some noise, over a good part of the type's range (of 32 bits: of 20); floats are
    multiples of 1/2."""
    y, x = np.mgrid[0:rows, 0:columns] / 16.0
    hills = np.sin(x) * np.cos(1.3 * y) + 0.3 * np.sin(3.1 * x + y)
    hills += np.random.default_rng(seed).normal(0, 0.01, hills.shape)
    hills = (hills - hills.min()) / np.ptp(hills)
    dtype = np.dtype(dtype)
    if dtype.kind == "f":
        return (np.round(2000 * hills) / 2).astype(dtype)
    limits = np.iinfo(dtype)
    low, high = max(limits.min, -(2**19)), min(limits.max, 2**19)
    return (low + hills * (high - low)).astype(np.int64).astype(dtype)


def moving(frames=21, rows=30, columns=35, dtype="i2"):
    """(time, rows, columns): a terrain with a hill that crosses it, and voids that come and go."""
    still = terrain(rows, columns, "i2") // 64
    y, x = np.mgrid[0:rows, 0:columns]
    cube = np.stack([still + 90 * np.exp(-((x - 2 * t) ** 2 + (y - 9) ** 2) / 30) for t in
                     range(frames)])  # fmt: skip
    cube = np.floor(cube)
    cube[3:9, 4:11, 8:20] = -9999
    return cube.astype(dtype)


def photograph(rows=40, columns=48, channels=3, dtype="u1"):
    layers = [terrain(rows, columns, dtype, seed) for seed in range(channels)]
    return layers[0] if channels == 1 else np.stack(layers, axis=2)


@pytest.fixture(scope="session")
def heights():
    return terrain()


@pytest.fixture(scope="session")
def texture():
    return photograph()


@pytest.fixture(scope="session")
def stream(heights, texture):
    """Heights and texture in 4000 bytes, with a place on the ground."""
    import tetrakis

    return tetrakis.encode(
        heights,
        texture,
        bytes=4000,
        unit="m",
        spacing=10,
        crs="EPSG:32611",
        geotransform=(4e5, 10, 0, 3.8e6, 0, -10),
        registration="area",
    )
