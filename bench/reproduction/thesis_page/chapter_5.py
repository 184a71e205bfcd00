# SPDX-License-Identifier: Apache-2.0
"""Chapter 5: decimation."""

import html
import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from chapter_2 import POLYLINE, curve
from page import COLOURS, panels
from results import Results, number, power

MESH = "build/bench/bench_thesis_meshes FOLDER"
POLICIES = {"general": "general decimation", "restricted": "restricted decimation",
            "local_decimation": "decimation by local error",
            "local_refinement": "refinement by local error"}
PRINTED_513 = {200: 14.9, 400: 18.46, 800: 22.2, 1600: 25.91, 3200: 29.81, 6400: 33.8}
PRINTED_51 = {2048: (0.003, 0.057), 8192: (0.011, 0.30), 32768: (0.05, 1.7),
              131072: (0.24, 11.4), 524288: (1.07, 48), 2097152: (4.81, 238)}


def figure_58(page, results):
    picture, axes = plt.subplots(figsize=(7.2, 3.4), layout="constrained")
    rises = {}
    for i, name in enumerate(("general", "restricted")):
        triangles = [t for t in results.items("trace_")
                     if not math.isnan(results(f"trace_{t}", name, "db"))]
        decibels = np.array([results(f"trace_{t}", name, "db") for t in triangles])
        rises[name] = int((np.diff(decibels) < -1e-9).sum())
        low = (np.array(triangles) >= 5) & (np.array(triangles) <= 300)
        axes.plot(np.array(triangles)[low], decibels[low], color=COLOURS[i], label=POLICIES[name])
    axes.set(xlabel="triangles", ylabel="dB (5.28)", xscale="log")
    axes.legend()
    page.figure("Figure 5.8", "Stability of the error", picture,
                "general decimation is very stable, restricted decimation is not at low rates.",
                "on the first terrain, up to 3000 triangles, steps that add triangles and lose "
                f"quality: {rises['general']} of general and {rises['restricted']} of restricted "
                "decimation.", MESH)
    rows = [[POLICIES[p], *(f"{results('mean', p, q):,.0f}" for q in ("steps", "rises", "falls"))]
            for p in ("general", "restricted")]
    general = [results("mean", "general", q) for q in ("steps", "rises", "falls")]
    page.table("Section 5.4.2", "Rises of the error and falls of the slope",
               ["policy", "steps", "error rises", "slope λ falls"], rows,
               "overlaps let monotonicity fail in few cases (not counted); proposition 5.3 claims "
               "a monotone λ.",
               f"means over the terrains. The error rises with the triangles at "
               f"{100 * general[1] / general[0]:.2f} % of the steps of general decimation, and λ "
               f"falls at {100 * general[2] / general[0]:.1f} %.", MESH)


def figure_59(page, results):
    picture, axes = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
    heights = np.array([results("fig_5.9", f"knot_{k}", "height") for k in range(9)])
    entry = [results("fig_5.9", f"knot_{k}", "entry") for k in range(9)]
    shift = 0.35 * max(np.ptp(heights), 1)
    for i, segments in enumerate(range(8, 0, -1)):
        knots = [k for k in range(9) if entry[k] <= segments]
        axes.plot(knots, heights[knots] - i * shift, "o-", ms=3, color=plt.cm.Blues(0.9 - 0.08 * i))
    axes.set(yticks=[], xlabel="knot")
    page.figure("Figure 5.9", "Successive approximations of a polyline", picture,
                "seven interior knots go one by one along their tree, from top to bottom.",
                "the same by <code>cglobal</code>, on every 32nd sample of a row.", POLYLINE)


def figure_510(page, polylines, results):
    picture, axes = panels()
    for i, (name, style) in enumerate((("uoptimal", "-"), ("coptimal", "--"), ("cdecimate", "-"),
                                       ("crefine", "-"))):
        axes[0].plot(*curve(polylines, name), style, color=COLOURS[i], label=name)
    axes[0].set(xlabel="segments", ylabel="dB (2.3)", title="polylines", xscale="log")
    axes[0].legend()
    at = lambda p: results.series("mean", p, "db_at_")
    for i, (name, words) in enumerate(POLICIES.items()):
        axes[1].plot(*at(name), color=COLOURS[i], label=words)
    axes[1].set(xlabel="triangles", ylabel="dB (5.28)", title="meshes", xscale="log")
    axes[1].legend()
    values = {p: results("mean", p, "db_at_1600") for p in POLICIES}
    falling = all(np.diff(list(values.values())) < 0)
    order = "the same order" if falling else "another order"
    page.figure("Figure 5.10", "Global against local error", picture,
                "from the top: the optimum, global error on the tree, then decimation and "
                "insertion by local error (polylines alone).",
                f"{order}. On meshes of 1600 triangles: "
                + ", ".join(f"{values[p]:.2f} dB {w}" for p, w in POLICIES.items()) + ".",
                POLYLINE + "; " + MESH)


def figure_511(page, results):
    picture, axes = plt.subplots(figsize=(5.6, 3.4), layout="constrained")
    rates, decibels = results.series("mean", "general", "db_at_")
    axes.plot(rates / 131072, decibels)
    axes.set(xlabel="share of the triangles", ylabel="dB (5.28)", xscale="log")
    count = int(results("all", "terrains", "count"))
    points = ", ".join(f"{results('mean', 'general', f'db_at_{t}'):.1f} ({t})"
                       for t in (100, 400, 1600, 6400, 25600))
    page.figure("Figure 5.11", "Mean rate-distortion curve", picture,
                "the mean of 388 terrains of 257², to 50 dB; a plot without numbers.",
                f"the mean of {count} terrain{'s' if count > 1 else ''}, general decimation: dB "
                f"(triangles) {points}.", MESH)


def draw_mesh(axes, path):
    triangles = np.loadtxt(path, delimiter=",", skiprows=1)
    corners = triangles.reshape(-1, 3, 3)
    # Heights to a quarter of the width: integer steps of the file have no scale of their own.
    span = max(np.ptp(corners[:, :, 2]), 1)
    solid = corners * (1, 1, 64 / span)
    normal = np.cross(solid[:, 1] - solid[:, 0], solid[:, 2] - solid[:, 0])
    normal *= np.sign(normal[:, 2:]) / np.linalg.norm(normal, axis=1, keepdims=True)
    light = np.clip(normal @ (np.array([-1, -1, 1.4]) / math.sqrt(3.96)), 0, 1)
    colours = plt.cm.gist_earth(0.3 + 0.6 * (corners[:, :, 2].mean(axis=1) - corners[:, :, 2].min())
                                / span)
    colours[:, :3] *= (0.45 + 0.55 * light)[:, None]
    axes.add_collection(PolyCollection(corners[:, :, :2], facecolors=colours, edgecolors=colours
                                       if len(triangles) > 1600 else "#00000030", linewidths=0.25))
    axes.set(xlim=(0, 256), ylim=(256, 0), aspect="equal", xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.grid(False)


def figure_513(page, results):
    terrains = []
    for item, codec, quantity in results.values:
        if codec == "general" and quantity == "db_at_200" and item != "mean":
            terrains.append(item)
    picture, axes = panels(3, 3.0, rows=2)
    for axis, (budget, printed) in zip(axes.flat, PRINTED_513.items()):
        draw_mesh(axis, page.folder / f"mesh_{budget}.csv")
        here = results(terrains[0], "general", f"db_at_{budget}")
        axis.set_title(f"{budget} triangles: {here:.1f} dB ({printed:.1f})")
    page.figure("Figure 5.13", "Progressive refinement of a mesh", picture,
                "14.9, 18.46, 22.2, 25.91, 29.81 and 33.8 dB (in brackets above).",
                f"{html.escape(terrains[0])}, general decimation; heights are drawn to one quarter "
                "of the width.", MESH)
    rows = [["thesis", *PRINTED_513.values()]]
    rows += [[html.escape(t), *(number(results(t, "general", f"db_at_{b}")) for b in PRINTED_513)]
             for t in terrains]
    page.table("Figure 5.13, all terrains", "dB by triangles", ["terrain", *PRINTED_513], rows,
               "one terrain of the Alps.", "each terrain on its own.", MESH)


def seconds(value):
    return "–" if math.isnan(value) else f"{value:.{2 if value >= 1 else 5}f}"


def table_51(page, results):
    sizes = results.items("n_")
    get = lambda n, q, of="general": results(f"n_{n}", of, q)
    rows = []
    for n in sizes:
        printed = PRINTED_51.get(n, (math.nan, math.nan))
        here = get(n, "initial_s") + get(n, "decimation_s")
        direct = get(n, "decimation_s", "direct")
        rows.append([f"{n:,}", *(("–" if math.isnan(p) else f"{p:g}") for p in printed),
                     seconds(get(n, "initial_s")), seconds(get(n, "decimation_s")),
                     seconds(get(n, "all_s", "local_decimation")), seconds(direct),
                     "–" if math.isnan(sum(printed)) else f"{sum(printed) / here:.0f}"])
    large = np.array([n for n in sizes if n >= 8192])
    ours = power(large, [get(n, "decimation_s") for n in large])
    theirs = np.array([(n, s[1]) for n, s in PRINTED_51.items() if n >= 8192])
    direct = np.array([(n, get(n, "decimation_s", "direct")) for n in sizes
                       if not math.isnan(get(n, "decimation_s", "direct"))])
    grows = f" The direct algorithm, which removes the same, grows with {power(*direct.T):.2f}." \
        if len(direct) > 1 else ""
    timed = np.array([n for n in large if not math.isnan(get(n, "all_s", "local_decimation"))])
    local = power(timed, [get(n, "all_s", "local_decimation") for n in timed])
    page.table("Table 5.1", "Time of decimation, seconds",
               ["n", "printed: initial", "decimation", "here: initial", "decimation",
                "by local error, all", "direct", "times faster"], rows,
               f"on a Pentium III of 500 MHz; exponent {power(*theirs.T):.2f} over n.",
               f"processor time on the machine that made this page; exponent {ours:.2f} over n, "
               f"where n log n has {power(large, large * np.log(large)):.2f}; the largest "
               f"meshes leave the caches.{grows} Decimation by local error, all of it, "
               f"grows with {local:.2f} (proposition 3.3: n log n). Sizes above the file's are "
               "mirrored.", MESH)


def write(page):
    polylines = Results(page.folder / "chapter_2.csv")
    results = Results(page.folder / "chapter_5.csv")
    page.chapter(5, "Decimation", "Meshes of 131 072 triangles over the central 257² samples.")
    figure_58(page, results)
    figure_59(page, polylines)
    figure_510(page, polylines, results)
    figure_511(page, results)
    figure_513(page, results)
    table_51(page, results)
