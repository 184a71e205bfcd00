# SPDX-License-Identifier: Apache-2.0
"""Chapter 4: the semi-linear quadtree."""

import math

import matplotlib.pyplot as plt
import numpy as np

import forests
from page import COLOURS, panels
from results import Results, number, power

QUADTREE = "bench/quadtree HEIGHT --orders --side N"
# What table 4.1 prints of single neighbours and of paths of l nodes, on dense and sparse trees: n
# digits a code, m nodes. Stores without an author are not in it.
PRINTED = {
    "semilinear": {"complete": ("Θ(2n)", "Θ(l)"), "fiftieth": ("Θ(log m + 2n)", "Θ(l log m)")},
    "samet": dict.fromkeys(("complete", "fiftieth"), ("Θ(log m + 3n)", "Θ(l log m + 3ln)")),
    "gargantini": dict.fromkeys(("complete", "fiftieth"), ("Θ(log m + 3n)", "Θ(l log m + 3ln)")),
    "schrack": dict.fromkeys(("complete", "fiftieth"), ("Θ(log m + 2n)", "Θ(l log m + 2ln)")),
}
STORES = [*PRINTED, "pointers", "linear", "hash", "grid"]
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


def style(store):
    """Stores that table 4.1 does not have are thin."""
    return {"color": COLOURS[STORES.index(store)], "lw": 1.5 if store in PRINTED else 0.8}


def figure_paths(page, sides, results):
    picture, axes = panels()
    for axis, mesh in zip(axes, MESHES):
        for store in STORES:
            lengths, times = path_times(results[sides[-1]], mesh, store)
            axis.loglog(lengths, times / lengths, "o-", ms=3, label=store, **style(store))
        axis.set(xlabel="nodes on the path l", ylabel="ns a node", title=f"{mesh} tree")
    axes[1].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    page.figure("Table 4.1, paths", "Time of traversal paths", picture,
                "Θ(l) for the semi-linear quadtree on dense trees, Θ(l log m) on sparse ones; "
                "Θ(l log m + 3 l n) and more for linear quadtrees.",
                f"on {sides[-1]}² samples; a path of l nodes costs less for each node as it grows, "
                "since its beginning is paid once and neighbours share cache lines.", QUADTREE)


def figure_depth(page, sides, results):
    picture, axes = panels()
    depths = np.log2(np.array(sides) - 1)
    for axis, mesh in zip(axes, MESHES):
        for store in STORES:
            for quantity, line in (("neighbour", "o-"), ("path_512", "o:")):
                times = [results[s](mesh, store, f"{quantity}_ns_per_node") for s in sides]
                axis.semilogy(depths, times, line, ms=3, **style(store),
                              label=store if quantity == "neighbour" else None)
        axis.set(xlabel="digits n of a code", ylabel="ns a node", title=f"{mesh} tree",
                 xticks=depths)
    axes[1].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    page.figure("Table 4.1, depth", "Time of a neighbour over the depth of the tree", picture,
                "linear in the digits n, as log m is; on paths of the semi-linear quadtree the "
                "depth drops out.",
                "single neighbours, and nodes of paths of 512 (dotted). All stores leave the "
                "caches as trees grow, the grid without any search included: beyond its growth "
                "lies what an algorithm costs.", QUADTREE)


def table_41(page, sides, results):
    depths = np.log2(np.array(sides) - 1)
    last, ours, rows = results[sides[-1]], {}, []
    for mesh in MESHES:
        for store in STORES:
            lengths, times = path_times(last, mesh, store)
            long = lengths >= 8
            over = {q: power(depths, [results[s](mesh, store, f"{q}_ns_per_node") for s in sides])
                    for q in ("neighbour", "path_512")}
            printed = PRINTED.get(store, {}).get(mesh, ("–", "–"))
            each = times[-1] / lengths[-1]
            ours.setdefault(mesh, each)
            rows.append([store, mesh, printed[0], number(over["neighbour"], 1), number(times[0], 1),
                         printed[1], number(power(lengths[long], times[long])),
                         number(over["path_512"], 1), number(each, 1),
                         number(each / ours[mesh], 1)])
    page.table("Table 4.1", "Orders and times of neighbour finding",
               ["store", "tree", "neighbour", "over n", "ns", "path of l", "over l", "over n",
                "ns a node", "times ours"], rows,
               "the orders in the third and sixth column.",
               "exponents fitted to times: of single neighbours over the digits n, and of paths "
               "over their length l (from 8 nodes on; 1 is linear) and over n (nodes of paths of "
               f"512); times on {sides[-1]}² samples. The complete tree is dense, the tree of the "
               "best mesh of a fiftieth of all triangles sparse. Samet's tree of pointers climbs "
               "to the nearest common ancestor, Gargantini reflects digits "
               "and Schrack adds dilated integers to codes that lie in one sorted list. The others "
               "are what one would build today: pointers with coordinates, a sorted list a level, "
               "a hash map, and a grid that has a place for every node.", QUADTREE)


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
    sides = sorted(int(p.stem.split("_")[2]) for p in page.folder.glob("chapter_4_[0-9]*.csv"))
    results = {s: Results(page.folder / f"chapter_4_{s}.csv") for s in sides}
    page.chapter(4, "The semi-linear quadtree", "Times of one thread; other programs on the "
                 "machine disturb single points.")
    figure_paths(page, sides, results)
    figure_depth(page, sides, results)
    table_41(page, sides, results)
    forests.write(page, Results(page.folder / "chapter_4_forests.csv"))
    figure_views(page, sides, results)
