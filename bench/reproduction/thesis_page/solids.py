# SPDX-License-Identifier: Apache-2.0
"""Solids of square patches: their meshes as bench_thesis_forests wrote them, seen from the side."""

import csv
import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

PATCHES = plt.cm.tab10.colors
FORESTS = "build/bench/bench_thesis_forests --depth N --meshes OUT"


def turn(angle, tilt):
    """From the solid to the picture: right, up, and towards the eye."""
    a, t = math.radians(angle), math.radians(tilt)
    round_z = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
    to_eye = np.array([[1, 0, 0], [0, math.sin(t), math.cos(t)], [0, -math.cos(t), math.sin(t)]])
    return to_eye @ round_z


def triangles_of(folder, solid, kind):
    """(patch of each triangle, its corners)."""
    with open(folder / f"solid_{solid}.csv") as file:
        rows = [[float(c) for c in r[1:]] for r in csv.reader(file) if r[0] == kind]
    rows = np.array(rows)
    return rows[:, 0].astype(int), rows[:, 1:].reshape(-1, 3, 3)


def bare(axes):
    axes.set(aspect="equal", xticks=[], yticks=[])
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def draw_solid(axes, folder, solid, kind, view=(28, 24)):
    """Triangles on the near side, far ones first: a point of the solid is seen from its middle.
    Patches have a colour each, a relief those of its heights."""
    patch, corners = triangles_of(folder, solid, kind)
    shown = corners @ turn(*view).T
    normal = np.cross(shown[:, 1] - shown[:, 0], shown[:, 2] - shown[:, 0])
    normal *= np.sign(np.sum(normal * shown.mean(axis=1), axis=1))[:, None]
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    near = np.flatnonzero(normal[:, 2] > 0)
    near = near[np.argsort(shown[near, :, 2].mean(axis=1))]
    light = np.clip(normal[near] @ (np.array([-1, 1.2, 2]) / math.sqrt(6.44)), 0, 1)
    if kind == "relief":
        height = np.linalg.norm(corners.mean(axis=1), axis=1)
        low, high = height.min(), height.max()
        colours = plt.cm.gist_earth(0.25 + 0.65 * (height[near] - low) / (high - low))[:, :3]
    else:
        colours = np.array([PATCHES[p % len(PATCHES)] for p in patch[near]]) * 0.45 + 0.55
    colours = colours * (0.5 + 0.5 * light)[:, None]
    axes.add_collection(PolyCollection(shown[near][:, :, :2], facecolors=colours,
                                       edgecolors="#00000060", linewidths=0.3))
    axes.autoscale_view()
    bare(axes)


def draw_grid(axes, column, row, nodes, colour="#c8c8c8"):
    """The nodes of a patch that lies at column, row of the picture."""
    for k in range(nodes + 1):
        width = 1.1 if k in (0, nodes) else 0.5
        axes.plot((column, column + 1), (row + k / nodes,) * 2, color=colour, lw=width, zorder=1)
        axes.plot((column + k / nodes,) * 2, (row, row + 1), color=colour, lw=width, zorder=1)
