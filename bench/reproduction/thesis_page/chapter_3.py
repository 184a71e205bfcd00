# SPDX-License-Identifier: Apache-2.0
"""Chapter 3: the 4-8 mesh."""

import math

import matplotlib.pyplot as plt
import numpy as np

from page import COLOURS, GREY, INK, panels
from results import Results, number, power
from solids import FORESTS, draw_solid

DOMAINS = "build/bench/bench_thesis_domains"


def domain_size(l, log4n):
    """(3.3) over n: l in 1 … 2d, n = 4^log4n = 2 · 4^d."""
    n, i = 4.0**log4n, 2 * log4n - l
    if i <= 4:
        return i * 2.0 ** (1 - l) * n
    c1, c2 = 2.0 ** math.floor(log4n - (l + 4) / 2), 2.0**-l * n / 16
    return 128 * c2 + 4 * (c2 * (24 - 12 / c1 + 4 / 3 / c1**2) + 8 / 3 / c2 * c1**2 - 16 * c1)


def support_size(l, log4n):
    """(3.4)."""
    n, i = 4.0**log4n, 2 * log4n - l
    if i <= 4:
        return 2.0 ** (1 - l) * n - 2
    c1 = 2.0 ** math.floor(log4n - (l + 4) / 2)
    return 32 * (2.0 ** -(l + 4) * n / c1 + 1.5 * c1) - 16 * (log4n - l / 2) - 18


def figure_33(page):
    picture, axes = panels(3, 2.7, rows=3)
    for column, solid in zip(axes.T, ("tetrahedron", "octahedron", "icosahedron")):
        for axis, kind in zip(column, ("flat", "sphere", "relief")):
            draw_solid(axis, page.folder, solid, kind)
        column[0].set_title(solid)
    page.figure("Figure 3.3", "Platonic solids of triangles, and spheres made of them", picture,
                "the three solids; their subdivisions tessellate the sphere.",
                "4-8 meshes of two, two and ten patches (a colour each) at depth 2; the same on "
                "the sphere at depth 3; and the best meshes of at most 1600 triangles of fractal "
                "heights at depth 7, conforming across all patches.", FORESTS)


def figure_35(page, results):
    largest = results.items("d_")[-1]
    picture, axes = panels(3)
    for axis, d in ((axes[0], 20), (axes[1], largest)):
        steps, log4n = np.arange(1, 2 * d + 1), d + 0.5
        axis.semilogy(steps, [2.0 * 4**d] * len(steps), color=INK, lw=0.9, label="n")
        axis.semilogy(steps, [domain_size(l, log4n) for l in steps], label="|M$_v$|, (3.3)")
        axis.semilogy(steps, [support_size(l, log4n) for l in steps], label="support, (3.4)")
        axis.set(xlabel="connection step l", ylabel="triangles", title=f"(a) n = 2·4$^{{{d}}}$")
    steps = np.arange(1, 2 * largest + 1)
    found = {q: np.array([results(f"d_{largest}", f"l_{l}", q) for l in steps])
             for q in ("domain_most", "support_most")}
    axes[1].plot(steps, found["domain_most"], "o", ms=3.5, color=COLOURS[0], mfc="white")
    axes[1].plot(steps, found["support_most"], "o", ms=3.5, color=COLOURS[1], mfc="white")
    sizes = np.arange(1, 21) + 0.5
    formula = [np.array([f(1, s) for s in sizes]) for f in (domain_size, support_size)]
    axes[2].loglog(4.0**sizes, 4.0**sizes, color=INK, lw=0.9)
    for values in formula:
        axes[2].loglog(4.0**sizes, values)
    axes[2].set(xlabel="n", title="(b) l = 1, (3.9) and (3.10)")
    axes[0].legend()
    # The file has four digits.
    closed = {"domain_most": domain_size, "support_most": support_size}
    equal = sum(all(abs(found[q][l - 1] / f(l, largest + 0.5) - 1) < 1e-3
                    for q, f in closed.items()) for l in steps)
    growth = [power(4.0**sizes[8:], values[8:]) for values in formula]
    # A domain of odd step l is that of l = 1 in a mesh of n / 4^((l - 1) / 2) triangles, (3.5).
    odd = np.arange(5, 2 * largest - 6, 2)
    parts = 2 * 4.0 ** (largest - (odd - 1) / 2)
    counted = [power(parts, found[q][odd - 1]) for q in closed]
    same = [power(parts, [f(l, largest + 0.5) for l in odd]) for f in closed.values()]
    page.figure("Figure 3.5", "Sizes of merging domains", picture,
                "|M<sub>v</sub>| ∈ Θ(n) and its support ∈ Θ(√n), (3.12) and (3.15).",
                f"fitted exponents {growth[0]:.3f} and {growth[1]:.3f} over n = 2·4⁹ … 2·4²⁰; "
                f"{counted[0]:.3f} and {counted[1]:.3f} counted on meshes of {parts[-1]:,.0f} to "
                f"{parts[0]:,.0f} triangles, where the closed forms have {same[0]:.3f} and "
                f"{same[1]:.3f}. Circles: the largest domain of each step, counted on "
                f"{2 * 4**largest:,} triangles; {equal} of {len(steps)} steps give (3.3) and "
                "(3.4), the others are cut by the border, which the closed forms ignore. (3.9) and "
                "(3.10) are drawn as corrected in the errata.", DOMAINS)


def theorem_31(page, results):
    sizes = np.array(results.items("d_"))
    log4n = sizes + 0.5
    get = lambda q, of="all": np.array([results(f"d_{d}", of, q) for d in sizes])
    picture, axes = panels(3)
    fits = {}
    for axis, quantity, title in ((axes[0], "domain_mean", "E|M$_v$|, triangles"),
                                  (axes[1], "support_mean", "E of the support, triangles"),
                                  (axes[2], "ancestors_mean", "ancestors")):
        axis.plot(log4n, get(quantity), "o-", ms=3.5, label="all vertices")
        fits[quantity] = np.polyfit(log4n[-4:], get(quantity)[-4:], 1)
        if quantity != "support_mean":
            axis.plot(log4n, np.polyval(fits[quantity], log4n), ":", color=GREY, label="line")
        axis.set(xlabel="log$_4$ n", title=title)
    finest = np.array([results(f"d_{d}", f"l_{2 * d}", "ancestors_mean") for d in sizes])
    axes[2].plot(log4n, finest, "s-", ms=3.5, label="last step, (3.24)")
    axes[2].plot(log4n, get("ancestors_most"), "^-", ms=3.5, label="most")
    axes[2].legend()
    for axis in axes:
        axis.set_ylim(bottom=0)
    rest = get("support_mean")
    page.figure("Theorem 3.1", "Means over all vertices, and (3.24), (3.25)", picture,
                "E|M<sub>v</sub>| ∈ Θ(log n), E of the support ∈ Θ(1), |S<sub>v</sub>| ∈ Θ(log n).",
                f"each fourfold n adds {fits['domain_mean'][0]:.1f} triangles to the mean domain "
                f"and {fits['ancestors_mean'][0]:.1f} to the mean number of ancestors (lines "
                f"fitted to the last four sizes); the support tends to a constant, {rest[-1]:.2f} "
                f"at d = {sizes[-1]}, {rest[-2]:.2f} before.", DOMAINS)
    rows = [[d, f"{2 * 4**d:,}", number(results(f"d_{d}", "all", "domain_mean")),
             number(results(f"d_{d}", "all", "support_mean")),
             number(results(f"d_{d}", "all", "ancestors_mean")),
             int(results(f"d_{d}", "all", "ancestors_most"))] for d in sizes]
    page.table("(3.16)–(3.25)", "Means by size of the mesh",
               ["d", "n", "E|M<sub>v</sub>|", "E of support", "E|A<sub>v</sub>|", "most ancestors"],
               rows, "orders only.", "counted over every vertex, those at the border included.",
               DOMAINS)


def octagon(axis, corner):
    """Points with |x|, |y| <= axis and |x| + |y| <= corner."""
    side = corner - axis
    points = np.array([(axis, side), (side, axis), (-side, axis), (-axis, side), (-axis, -side),
                       (-side, -axis), (side, -axis), (axis, -side), (axis, side)])
    return points.T


def figure_37(page, results):
    picture, axes = panels(2, 3.8)
    halves = results.items("k_")
    for i, k in enumerate(halves[1:7]):
        axis, corner = (results(f"k_{k}", "octagon", q) for q in ("axis_reach", "sum_reach"))
        points = octagon(axis, corner)
        axes[0].plot(*points, color=plt.cm.Blues(0.35 + 0.1 * i), lw=1, label=f"k = {k}")
    points = octagon(1.5, 2)
    axes[0].fill(*points, color="#f0e6d6", zorder=0)
    axes[0].plot(*points, color=COLOURS[1], lw=1.6, label="limit")
    axes[0].plot([-0.5, 0.5, 0.5, -0.5, -0.5], [-0.5, -0.5, 0.5, 0.5, -0.5], color=INK, lw=0.8)
    axes[0].set(aspect="equal", title="domains in meshes refined k times; sides of the square of v")
    axes[0].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    axis = np.array([results(f"k_{k}", "octagon", "axis_reach") for k in halves])
    corner = np.array([results(f"k_{k}", "octagon", "sum_reach") for k in halves]) / math.sqrt(2)
    axes[1].semilogy(halves, 1.5 - axis, "o-", ms=3.5, label="3/2 − reach along an axis")
    axes[1].semilogy(halves, math.sqrt(2) - corner, "s-", ms=3.5,
                     label="√2 − reach along a diagonal")
    axes[1].set(xlabel="k", title="distance to the limit")
    axes[1].legend()
    page.figure("Figure 3.7", "Limit of a merging domain (proposition 3.2)", picture,
                "an irregular octagon with r = 3/2 along the axes and √2 along the diagonals "
                "(called r<sub>min</sub> and r<sub>max</sub>, though 3/2 is the larger).",
                f"reaches of {axis[-1]:.3f} and "
                f"{corner[-1]:.3f} after {halves[-1]} refinements; each halves the distance to "
                "the limit. A test asserts both limits.", DOMAINS)


def draw_lattice(axes, side):
    for x in range(side):
        for y in range(side):
            a = (x, x + 1) if (x + y) % 2 == 0 else (x + 1, x)
            axes.plot(a, (y, y + 1), color="#e3e3e3", lw=0.5, zorder=0)
    for i in range(side + 1):
        axes.plot((0, side), (i, i), color="#e3e3e3", lw=0.5, zorder=0)
        axes.plot((i, i), (0, side), color="#e3e3e3", lw=0.5, zorder=0)
    axes.set(aspect="equal", xticks=[], yticks=[], ylim=(side + 0.5, -0.5), xlim=(-0.5, side + 0.5))
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def points_of(results, item):
    return np.array([[*map(int, c.split("_")), v] for (i, c, q), v in results.values.items()
                     if i == item and q == "level"])


def figure_39(page, results):
    picture, axes = panels(2, 4.2)
    for axis in axes:
        draw_lattice(axis, 16)
    chain, start = points_of(results, "chain"), points_of(results, "chain_of")
    axes[0].scatter(chain[:, 0], chain[:, 1], c=chain[:, 2], cmap="viridis_r", s=30)
    for x, y, level in chain:
        axes[0].annotate(int(level), (x, y), xytext=(4, 4), textcoords="offset points", fontsize=7)
    axes[0].plot(*start[0, :2], "*", ms=11, color=COLOURS[1])
    axes[0].set_title(f"(a) the {len(chain)} ancestors of the star, with their steps")
    inner, outer = points_of(results, "inner"), points_of(results, "outer")
    axes[1].plot(*inner[:, :2].T, "o", ms=5, color=COLOURS[0])
    axes[1].plot(*outer[:, :2].T, "o", ms=5, mfc="white", color=COLOURS[0])
    axes[1].set_title("(b) a merging domain; white: a parent outside")
    get = lambda q: int(results("domain", "fig39", q))
    page.figure("Figure 3.9", "Ancestors", picture,
                "a vertex of a domain with one parent outside for each triangle of its support.",
                f"{get('support')} triangles, and {get('outer_parents')} parents outside, of "
                f"{get('outer')} vertices: v itself has two.", DOMAINS)


def write(page):
    results = Results(page.folder / "chapter_3.csv")
    page.chapter(3, "The 4-8 mesh", "Counts on complete meshes: no terrain is involved.")
    figure_33(page)
    figure_35(page, results)
    theorem_31(page, results)
    figure_37(page, results)
    figure_39(page, results)
