# SPDX-License-Identifier: Apache-2.0
"""Chapter 4: the semi-linear quadtree."""

import math

import matplotlib.pyplot as plt
import numpy as np

from page import COLOURS, panels
from results import Results, number, power

QUADTREE = "bench/quadtree HEIGHT --orders --side N"
STORES = {"semilinear": "Θ(l)", "pointers": "–", "linear": "Θ(l log m)", "hash": "–", "grid": "–"}
MESHES = ("complete", "fiftieth")


def path_times(results, mesh, store):
    """(steps, nanoseconds of a whole walk)."""
    found = {1: results(mesh, store, "neighbour_ns_per_node")}
    for (item, codec, quantity), value in results.values.items():
        if item == mesh and codec == store and quantity.startswith("path_"):
            if quantity.endswith("_ns_per_node"):
                found[int(quantity.split("_")[1])] = value
    lengths = np.array(sorted(found))
    each = np.array([found[l] for l in lengths])
    return lengths, lengths * each


def figure_paths(page, sides, results):
    picture, axes = panels()
    rows = []
    for axis, mesh in zip(axes, MESHES):
        for i, (store, law) in enumerate(STORES.items()):
            lengths, times = path_times(results[sides[-1]], mesh, store)
            axis.loglog(lengths, times / lengths, "o-", ms=3, color=COLOURS[i], label=store)
            long = lengths >= 8
            rows.append([store, mesh, law, number(power(lengths[long], times[long])),
                         number(times[0], 1), number(times[-1] / lengths[-1], 1)])
        axis.set(xlabel="nodes on the path l", ylabel="ns a node", title=f"{mesh} tree")
    axes[1].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    page.figure("Table 4.1, paths", "Time of traversal paths", picture,
                "Θ(l) for the semi-linear quadtree on dense trees, Θ(l log m) on sparse ones; "
                "Θ(l log m + 3 l n) and more for linear quadtrees.",
                f"on {sides[-1]}² samples; a path of l nodes costs less for each node as it grows, "
                "since its beginning is paid once and neighbours share cache lines.", QUADTREE)
    page.table("Table 4.1", "Orders fitted to paths of 8 nodes and more",
               ["store", "tree", "printed", "exponent over l", "ns, first node", "ns a node, 512"],
               rows, "as printed; the linear store is sorted codes, as Gargantini's.",
               "exponents of the time of whole paths over their length; 1 is linear. Samet's, "
               "Gargantini's and Schrack's own neighbour finding is not built.", QUADTREE)


def figure_depth(page, sides, results):
    picture, axes = panels()
    slopes = {}
    depths = np.log2(np.array(sides) - 1)
    for axis, mesh in zip(axes, MESHES):
        for i, store in enumerate(STORES):
            for quantity, style in (("neighbour", "o-"), ("path_512", "o:")):
                times = [results[s](mesh, store, f"{quantity}_ns_per_node") for s in sides]
                axis.semilogy(depths, times, style, ms=3, color=COLOURS[i],
                              label=store if quantity == "neighbour" else None)
                slopes[mesh, store, quantity] = power(depths, times)
        axis.set(xlabel="depth", ylabel="ns a node", title=f"{mesh} tree", xticks=depths)
    axes[1].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    words = "; ".join(f"{s} {slopes['complete', s, 'neighbour']:.1f} and "
                      f"{slopes['complete', s, 'path_512']:.1f}" for s in STORES)
    page.figure("Table 4.1, depth", "Time of a neighbour over the depth of the tree", picture,
                "Θ(2 n) for location codes of n digits on dense trees, Θ(log m + 2 n) on sparse "
                "ones; Θ(log m + 3 n) for Samet's and Gargantini's. On paths, the depth drops out.",
                f"exponents over the depth, of single neighbours and of paths of 512 (dotted), "
                f"complete tree: {words}. All stores leave the caches as trees grow, the grid "
                "without any search at all included: beyond its exponent lies what an algorithm "
                "costs.", QUADTREE)


def figure_views(page, sides, results):
    picture, axes = plt.subplots(figsize=(5.6, 3.4), layout="constrained")
    exponents = []
    data = results[sides[-1]]
    for i, mesh in enumerate(("complete", "quarter", "fiftieth")):
        percents = [p for p in range(1, 101) if not math.isnan(data(mesh, f"view_{p}", "ms"))]
        seen = np.array([data(mesh, f"view_{p}", "triangles") for p in percents])
        times = np.array([data(mesh, f"view_{p}", "ms") for p in percents])
        axes.loglog(seen, times, "o-", ms=3, color=COLOURS[i], label=f"{mesh} mesh")
        large = seen > seen[-1] / 200
        exponents.append(f"{power(seen[large], times[large]):.2f} ({mesh})")
    axes.set(xlabel="triangles seen", ylabel="ms")
    axes.legend()
    page.figure("Section 4.7", "Time of a view over what is seen", picture,
                "linear in the content of the field of view.",
                f"exponents over the larger half of windows, on {sides[-1]}² samples: "
                f"{', '.join(exponents)}. Small windows pay one bit for each vertex of the tree.",
                QUADTREE)


def write(page):
    sides = sorted(int(p.stem.split("_")[2]) for p in page.folder.glob("chapter_4_*.csv"))
    results = {s: Results(page.folder / f"chapter_4_{s}.csv") for s in sides}
    page.chapter(4, "The semi-linear quadtree", "Times of one thread; other programs on the "
                 "machine disturb single points.")
    figure_paths(page, sides, results)
    figure_depth(page, sides, results)
    figure_views(page, sides, results)
