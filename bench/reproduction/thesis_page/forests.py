# SPDX-License-Identifier: Apache-2.0
"""Section 4.6 of chapter 4: forests of quadtrees."""

import matplotlib.pyplot as plt
import numpy as np

from page import COLOURS, GREY, panels
from results import number
from solids import FORESTS, bare, draw_grid, draw_solid

SIDES = "NESW"
SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "tetrakishexahedron")
TREES = ("one tree", "1x1", "2x2", "4x4", "straight pair", *SOLIDS[1:])
# Where the patches of the cube lie when it is unfolded: column and row.
NET = {0: (0, 1), 1: (1, 1), 2: (2, 1), 3: (3, 1), 4: (0, 0), 5: (0, 2)}


def draw_stored(axes, results, patch):
    draw_grid(axes, 0, 0, 4)
    for (item, codec, _), here in results.values.items():
        if item != "stored":
            continue
        p, x, y = map(int, codec.split("_"))
        if p == patch:
            axes.plot(x / 4, y / 4, "o", ms=8, mec=COLOURS[0], mfc="white" if here else COLOURS[0])
    axes.plot((0, 1, 0, 1), (0, 0, 1, 1), "s", ms=6, color=GREY)
    axes.set_ylim(1.08, -0.08)
    axes.set_title(f"{('northern', 'southern')[patch]} hemisphere")
    bare(axes)


def figure_48(page, results):
    picture, axes = panels(4, 2.6)
    draw_solid(axes[0], page.folder, "octahedron", "flat")
    draw_solid(axes[1], page.folder, "octahedron", "sphere")
    draw_stored(axes[2], results, 0)
    draw_stored(axes[3], results, 1)
    counts = [int(results("octahedron", f"depth_{d}", "vertices")) for d in range(1, 7)]
    equal = all(c == 2 * 4**d + 2 for d, c in enumerate(counts, 1))
    get = lambda q: int(results("octahedron", "layout", q))
    page.figure("Figure 4.8", "The octahedron of two quadtrees", picture,
                "a hemisphere a quadtree, no binary tree for borders; (4.2) and (4.4) lead from "
                "one to the other.",
                f"vertices of depths 1 to 6: {', '.join(map(str, counts))}"
                f"{', 2·4^d + 2 each' if equal else ''}; {get('border_trees')} border trees. "
                "White: stored in this hemisphere, filled: in the other, squares: corners. With "
                "(4.2) and (4.4) on both axes the patches close to a torus; the octahedron needs "
                f"{get('turned')} pairs that turn, (N,E), (E,N), (S,W) and (W,S). "
                f"{get('least_turned')} pairs would do, with border trees.", FORESTS)


def draw_adjacency(axes, sides):
    """The net of the cube, and the name of the pair at each side: own side, then the other's."""
    middle = {0: (0.5, 0.13), 1: (0.85, 0.5), 2: (0.5, 0.87), 3: (0.15, 0.5)}
    for patch, (column, row) in NET.items():
        draw_grid(axes, column, row, 1, "#555555")
        axes.text(column + 0.5, row + 0.5, str(patch), ha="center", va="center", fontsize=11)
        for s, (x, y) in middle.items():
            other = int(sides[4 * patch + s])
            straight = (s + 2) % 4 == other % 4
            axes.text(column + x, row + y, f"{SIDES[s]},{SIDES[other % 4]} {other // 4}",
                      ha="center", va="center", fontsize=6.5, rotation=90 if s % 2 else 0,
                      color=GREY if straight else COLOURS[1])
    axes.set_ylim(3.05, -0.05)
    bare(axes)


def figure_49(page, results):
    picture, axes = plt.subplots(1, 3, figsize=(9.2, 3.2), layout="constrained",
                                 width_ratios=(1, 1, 2.4))
    draw_solid(axes[0], page.folder, "tetrakishexahedron", "flat")
    draw_solid(axes[1], page.folder, "tetrakishexahedron", "sphere")
    draw_adjacency(axes[2], results.series("tetrakishexahedron", "sides", "side_")[1])
    get = lambda q: int(results("tetrakishexahedron", "layout", q))
    page.figure("Figure 4.9", "The tetrakishexahedron, and its adjacency", picture,
                "6 of the 12 edges need a rotation.",
                f"{get('turned')} of 12 (in colour; a side, the side behind it, and its patch), "
                f"the least of all {get('layouts')} ways to lay the faces. This layout, "
                f"that of globes in streams, needs {get('border_trees')} border trees; others need "
                f"{get('least_border_trees')}, at {get('turned_without_trees')} turns.", FORESTS)


def path_of(results, name):
    """(patch, column, row, code) of each node of a path."""
    steps = []
    while not np.isnan(results(name, f"step_{len(steps)}", "code")):
        steps.append([int(results(name, f"step_{len(steps)}", q))
                      for q in ("patch", "column", "row", "code")])
    return steps


def draw_path(axes, steps, places, colour, label):
    """Nodes of level 2, and lines between those that lie side by side in the picture."""
    at = np.array([(places[p][0] + (c + 0.5) / 4, places[p][1] + (r + 0.5) / 4)
                   for p, c, r, _ in steps])
    for a, b in zip(at, at[1:]):
        if np.abs(a - b).sum() < 0.3:
            axes.plot(*zip(a, b), color=colour, lw=1.6, zorder=2)
    axes.plot(*at.T, ".", ms=4, color=colour, zorder=3)
    axes.plot(*at[0], "o", ms=7, mfc="white", mec=colour, zorder=4)
    axes.plot(*at[-1], "o", ms=7, color=colour, zorder=3)
    if label:
        below = -15 if at[-1][1] < at[0][1] else 7  # the path leads upwards
        axes.annotate(label, at[0], xytext=(0, below), textcoords="offset points", fontsize=7.5,
                      color=colour, ha="center", zorder=5)


def figure_410(page, results):
    picture, axes = plt.subplots(1, 2, figsize=(9.2, 3.9), layout="constrained",
                                 width_ratios=(1, 1.5))
    square = {p: (p % 2, p // 2) for p in range(4)}
    for place in square.values():
        draw_grid(axes[0], *place, 4)
    for place in NET.values():
        draw_grid(axes[1], *place, 4)
    texts = []
    for i in range(1, 5):
        steps = path_of(results, f"grid_{i}")
        difference = int(results(f"grid_{i}", "all", "difference"))
        draw_path(axes[0], steps, square, COLOURS[i - 1], f"δ = {difference}".replace("-", "−"))
        sign = "−" if difference < 0 else "+"
        texts.append(f"{steps[0][3]} {sign} {abs(difference)} = {steps[-1][3]}")
    for i in range(1, 4):
        draw_path(axes[1], path_of(results, f"cube_{i}"), NET, COLOURS[i - 1], "")
    axes[0].set_title("(a) 2 × 2 patches")
    axes[1].set_title("(b) straight paths round the cube, unfolded")
    for axis, bottom in zip(axes, (2, 3)):
        axis.set_ylim(bottom + 0.05, -0.05)
        bare(axis)
    page.figure("Figure 4.10", "Traversals between the quadtrees of a forest", picture,
                "p<sub>t</sub> = p<sub>s</sub> + δ, without side information for a grid of "
                "patches.",
                f"codes of level 2 of four patches: {'; '.join(texts)}. Round the cube three paths "
                "of 15 steps keep straight over sides that turn (white: first node), and end "
                "beside the node that they left.", FORESTS)


def table_counts(page, results):
    rows = []
    for solid in SOLIDS:
        get = lambda q, of="layout": results(solid, of, q)
        patches = int(get("patches"))
        counts = [{int(get(q, f"depth_{d}")) for d in range(1, 7)}
                  for q in ("vertices_beyond", "euler")]
        rows.append([solid, patches, f"{int(get('vertices', 'depth_3')):,}",
                     *(", ".join(map(str, c)) for c in counts), int(get("layouts")),
                     int(get("turned")), int(get("least_turned")), int(get("border_trees")),
                     int(get("least_border_trees")), int(get("turned_without_trees"))])
    page.table("Section 4.6, counts", "Forests of solids",
               ["solid", "patches P", "vertices, d = 3", "beyond P·4<sup>d</sup>", "χ", "layouts",
                "turned pairs", "least", "border trees", "least", "turned with those"], rows,
               "octahedron: no border tree; tetrakishexahedron: 6 pairs turned.",
               "counted on complete meshes of depths 1 to 6; χ = vertices − edges + triangles. "
               "Layouts: patches with a middle begin at any corner, those of two triangles at "
               "either end of the diagonal. The last column is the least of layouts with the least "
               "border trees.", FORESTS)


def table_41_forests(page, results):
    rows = []
    for mesh in ("complete", "fiftieth"):
        one = results("one tree", mesh, "path_512_ns_per_node")
        for tree in TREES:
            get = lambda q: results(tree, mesh, q)
            rows.append([tree, mesh, number(get("nodes") / 1000, 0),
                         *(number(get(f"{q}_ns_per_node"), 1)
                           for q in ("neighbour", "crossing", "path_16", "path_512")),
                         number(get("path_512_ns_per_node") / one, 2), number(get("locate_ns"), 0),
                         number(get("located_levels"), 1), number(get("bytes_per_vertex"))])
    page.table("Table 4.1, forests", "Neighbours, paths and points on forests",
               ["forest", "mesh", "nodes / 1000", "neighbour, ns", "over a side",
                "path of 16, ns a node", "of 512", "times one tree", "point, ns", "its levels",
                "bytes a vertex"], rows,
               "exactly the same traversal properties as surfaces (4.6).",
               "one tree: steps of theorem 4.1 alone, torus and all. 1 × 1: the same tree, its "
               "sides glued to themselves; k × k: tori of patches; straight pair: a torus of two, "
               "no side of which turns. Nodes that a walk starts from are drawn at random, those "
               "of the fifth column at a side that it leaves. Point: the deepest node at a point, "
               "from the top.", FORESTS)


def write(page, results):
    figure_48(page, results)
    figure_49(page, results)
    figure_410(page, results)
    table_counts(page, results)
    table_41_forests(page, results)
