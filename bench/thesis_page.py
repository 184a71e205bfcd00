# SPDX-License-Identifier: Apache-2.0
"""bench/thesis runs this: thesis_page.py FOLDER GROUND. Draws FOLDER/index.html from the CSV files
that the benches left there. GROUND: what they were run on, in words."""

import base64
import csv
import html
import io
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

FOLDER, GROUND = Path(sys.argv[1]), sys.argv[2]
NOT_REPRODUCED = " (<span class='no'>not reproduced</span>)"
WIDTH = 9.2  # inches of a picture as wide as the page
INK, GREY = "#222222", "#9a9a9a"
COLOURS = ["#1f4e79", "#b5482a", "#4a7c3a", "#8a5fa8", "#b58a1c", "#3f8f8f", "#7a7a7a", "#c05a8a"]
STYLE = """
body{font:16px/1.55 Georgia,serif;color:#222;max-width:60rem;margin:2.5rem auto;padding:0 1.2rem}
h1,h2,h3,th,nav{font-family:system-ui,sans-serif}h1{font-size:1.7rem;margin-bottom:.2rem}
h2{font-size:1.3rem;margin-top:3rem;border-bottom:1px solid #ccc;padding-bottom:.2rem}
nav ol{columns:22rem 2;font-size:.9rem;padding-left:1.3rem}a{color:#1f4e79;text-decoration:none}
figure{margin:1.8rem 0}figure>img{max-width:100%;display:block}
figcaption{font-size:.9rem;color:#333;margin-top:.5rem}sub{line-height:0}
figcaption b{font-family:system-ui,sans-serif}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.85rem;margin:.6rem 0}
th{text-align:right;font-weight:600;border-bottom:1px solid #888;padding:.25rem .55rem}
td{text-align:right;padding:.2rem .55rem;border-bottom:1px solid #eee;white-space:nowrap;
font-variant-numeric:tabular-nums}th:first-child,td:first-child{text-align:left}
code{font-size:.85em;background:#f4f4f2;padding:.05rem .25rem}.no{color:#b5482a}.lead{color:#444}
"""
plt.rcParams.update({
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.7,
    "axes.prop_cycle": plt.cycler(color=COLOURS), "lines.linewidth": 1.4, "axes.grid": True,
    "grid.color": "#e6e6e6", "grid.linewidth": 0.6, "legend.frameon": False, "legend.fontsize": 8,
    "axes.titlesize": 9.5, "svg.fonttype": "path", "svg.hashsalt": "thesis",
})


class Results:
    """The rows of one CSV file: value(item, codec, quantity), and what items begin with a text."""

    def __init__(self, name):
        with open(FOLDER / name) as file:
            rows = list(csv.DictReader(file))
        self.values = {(r["item"], r["codec"], r["quantity"]): float(r["value"]) for r in rows}

    def __call__(self, item, codec, quantity):
        return self.values.get((item, codec, quantity), math.nan)

    def series(self, item, codec, prefix):
        """(numbers behind the prefix, values), in order of the numbers."""
        found = [(int(q[len(prefix):]), v) for (i, c, q), v in self.values.items()
                 if i == item and c == codec and q.startswith(prefix)]
        return np.array(sorted(found)).reshape(-1, 2).T

    def items(self, prefix):
        """Numbers behind the prefix of items."""
        return sorted({int(i[len(prefix):]) for i, _, _ in self.values if i.startswith(prefix)})


class Page:
    def __init__(self):
        self.body, self.contents = [], []

    def chapter(self, number, title, lead):
        heading = f"Chapter {number}: {title}"
        self.body.append(f'<h2 id="c{number}">{heading}</h2><p class="lead">{lead}</p>')
        self.contents.append((f"c{number}", f"<b>{heading}</b>"))

    def caption(self, name, title, thesis, ours, command):
        return (f"<figcaption><b>{name}: {title}.</b> <b>Thesis:</b> {thesis} <b>Here:</b> {ours} "
                f"<code>{html.escape(command)}</code></figcaption>")

    def figure(self, name, title, picture, thesis, ours, command):
        anchor = "f" + "".join(c for c in name if c.isalnum())
        self.contents.append((anchor, f"{name}: {title}"))
        data, width = io.BytesIO(), picture.get_figwidth() / WIDTH
        picture.savefig(data, format="svg", bbox_inches="tight", metadata={"Date": None})
        plt.close(picture)
        image = base64.b64encode(data.getvalue()).decode()
        self.body.append(f'<figure id="{anchor}"><img alt="{html.escape(name)}" '
                         f'style="width:{width:.0%}" src="data:image/svg+xml;base64,{image}">'
                         + self.caption(name, title, thesis, ours, command) + "</figure>")

    def table(self, name, title, head, rows, thesis, ours, command):
        anchor = "f" + "".join(c for c in name if c.isalnum())
        self.contents.append((anchor, f"{name}: {title}"))
        cells = "".join("<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in rows)
        heads = "".join(f"<th>{c}</th>" for c in head)
        self.body.append(f'<figure id="{anchor}"><div class="scroll"><table><tr>{heads}</tr>{cells}'
                         "</table></div>" + self.caption(name, title, thesis, ours, command)
                         + "</figure>")

    def write(self):
        links = "".join(f'<li><a href="#{a}">{t}</a></li>' for a, t in self.contents)
        files = ", ".join(f'<a href="{p.name}">{p.name}</a>' for p in sorted(FOLDER.glob("*.csv")))
        (FOLDER / "index.html").write_text(
            '<!doctype html><html lang="en"><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width">'
            f"<title>The thesis, made anew</title><style>{STYLE}</style>"
            "<h1>The thesis, made anew</h1>"
            "<p class='lead'>Tables and figures of L. Balmelli, <i>Rate-distortion optimal mesh "
            "simplification for communications</i> (EPFL 2000), chapters 2 to 5, measured with "
            f"this code on {html.escape(GROUND)}. The thesis's own terrain, of the Valais, is not "
            "to be had: numbers of decibels may differ, laws may not. docs/THESIS.md says where "
            "each section is implemented, and lists the errata.</p>"
            f"<nav><ol>{links}</ol></nav>{''.join(self.body)}"
            f"<h2>Data</h2><p>Drawn from {files}; the benches' own tables are in "
            "<a href='log.txt'>log.txt</a>.</p></html>")


def panels(columns=2, height=3.1, rows=1):
    return plt.subplots(rows, columns, figsize=(WIDTH, height * rows), layout="constrained")


def power(x, y):
    """The exponent of y over x, by least squares of the logarithms."""
    return np.polyfit(np.log(x), np.log(y), 1)[0]


def number(value, digits=2):
    return "–" if math.isnan(value) else f"{value:.{digits}f}"


def most(difference, rates):
    """'3.86 dB at 9': the largest difference and its rate."""
    i = int(np.nanargmax(difference))
    return f"{difference[i]:.2f} dB at {int(rates[i])}"


# Chapter 2

POLYLINE = "bench/polyline HEIGHT... --all-rates"
LAWS = {"uoptimal": 0.5, "urefine": 3, "udecimate": 5, "udecimate-global": 5, "crefine": 1,
        "cdecimate": 1, "cglobal": 5, "coptimal": 7}
TREES = {"crefine", "cdecimate", "cglobal", "coptimal"}


def operations(results, algorithm):
    """(m, operations)."""
    n = np.array([k for k in results.items("n_")
                  if not math.isnan(results(f"n_{k}", algorithm, "operations_share"))])
    share = np.array([results(f"n_{k}", algorithm, "operations_share") for k in n])
    m = n - 2.0
    return m, share * (n**3.0 if algorithm == "uoptimal" else m * np.log2(m))


def plot_operations(axes, results, algorithms):
    for i, name in enumerate(algorithms):
        m, counted = operations(results, name)
        axes.loglog(m, counted, "o-", ms=3, color=COLOURS[i], label=name)
        law = LAWS[name] * ((m + 2) ** 3 if name == "uoptimal" else m * np.log2(m))
        axes.loglog(m, law, ":", color=COLOURS[i], lw=1)
    axes.set(xlabel="internal knots m", ylabel="operations",
             title="(a) operations; dotted: the thesis's law")
    axes.legend()


def curve(results, algorithm):
    return results.series("mean", algorithm, "db_at_")


def plot_quality(axes, results, algorithms, title="(b) mean dB (2.3)"):
    for i, name in enumerate(algorithms):
        axes.plot(*curve(results, name), color=COLOURS[i], label=name)
    axes.set(xlabel="segments", ylabel="dB", title=title, xscale="log")
    axes.legend()


def difference(results, better, worse):
    rates, upper = curve(results, better)
    return upper - curve(results, worse)[1], rates


def table_23(page, results):
    sizes = results.items("n_")
    rows = []
    for name, factor in LAWS.items():
        law = "n³/2" if name == "uoptimal" else f"{factor} m log₂ m".removeprefix("1 ")
        law += " (not in it)" if name == "udecimate-global" else ""
        rises = results("mean", name, "rises_per_curve")
        shares = [results(f"n_{n}", name, "operations_share") for n in sizes]
        rows.append([name, law, *map(number, shares), "no" if name == "uoptimal" else "yes",
                     "yes" if name in TREES else "no", number(rises, 1)])
    curves = int(results("all", "curves", "count"))
    optimum = results("mean", "uoptimal", "rises_per_curve")
    never = "The optimum can lose by a segment more (table 2.1); on these curves it " + (
        "never does." if optimum == 0 else f"does {optimum:.2g} times.")
    page.table(
        "Table 2.3", "Properties of the algorithms",
        ["algorithm", "printed cost", *(f"n = {n}" for n in sizes), "nested", "tree", "rises"],
        rows,
        "costs as in the second column; only <code>coptimal</code> is monotone.",
        "operations (errors, comparisons, updates) over m log₂ m, of <code>uoptimal</code> over "
        f"n³; rises of the error per curve, a mean over {curves} curves. Laws of growth hold; "
        f"prefix sums take most algorithms below their printed factors. {never}", POLYLINE)


def figures_2(page, results):
    unconstrained = ["uoptimal", "urefine", "udecimate"]
    picture, axes = plt.subplots(figsize=(5.4, 3.3), layout="constrained")
    plot_operations(axes, results, unconstrained)
    axes.set_title("dotted: the thesis's law")
    exponent = power(*operations(results, "uoptimal"))
    page.figure("Figure 2.9", "Operations of the unconstrained algorithms", picture,
                "n³/2, 3 m log₂ m and 5 m log₂ m; refinement has the smaller factor.",
                f"<code>uoptimal</code> grows with exponent {exponent:.2f}. Prefix sums make each "
                "error one operation, which takes a third off the optimum's factor and more off "
                "decimation's.", POLYLINE)

    picture, axes = panels()
    plot_quality(axes[0], results, unconstrained, "(a) mean dB (2.3)")
    gaps = {w: difference(results, "uoptimal", w) for w in unconstrained[1:]}
    for i, (name, (gap, rates)) in enumerate(gaps.items()):
        axes[1].plot(rates, gap, color=COLOURS[i + 1], label=f"uoptimal − {name}")
    crossing, rates = difference(results, "urefine", "udecimate")
    axes[1].plot(rates, crossing, color=INK, ls="--", label="urefine − udecimate")
    axes[1].set(xscale="log", xlabel="segments", ylabel="dB", title="(b, c) differences")
    axes[1].axhline(0, color=GREY, lw=0.7)
    axes[1].legend(loc="upper right")
    both = np.maximum(gaps["urefine"][0], gaps["udecimate"][0])
    page.figure("Figure 2.10", "The optimum and greedy algorithms", picture,
                "the optimum is at most 3.86 dB above; refinement wins at low rates, decimation at "
                "high ones.",
                f"at most {most(both, rates)} segments; refinement is ahead by up to "
                f"{most(crossing, rates)}, decimation by up to {most(-crossing, rates)}.", POLYLINE)
    figures_2_trees(page, results)


def figures_2_trees(page, results):
    picture, axes = panels()
    names = ["urefine", "udecimate", "crefine", "cdecimate"]
    plot_operations(axes[0], results, names)
    plot_quality(axes[1], results, names)
    refine, rates = difference(results, "urefine", "crefine")
    decimate, _ = difference(results, "udecimate", "cdecimate")
    page.figure("Figure 2.17", "Algorithms bound to a tree, by local errors", picture,
                "at least 15 dB below the unconstrained ones; refinement and decimation cross "
                "about mid-rate.",
                f"at most {most(refine, rates)} segments "
                f"(refinement) and {most(decimate, rates)} (decimation)"
                f"{'' if refine.max() >= 15 else NOT_REPRODUCED}; they cross near "
                f"{crossing_rate(results)} segments.", POLYLINE)

    picture, axes = panels()
    names = ["urefine", "udecimate", "cdecimate", "cglobal", "coptimal"]
    plot_operations(axes[0], results, names)
    plot_quality(axes[1], results, names[:1] + names[2:])
    gap, rates = difference(results, "udecimate", "cglobal")
    other, _ = difference(results, "urefine", "cglobal")
    last = difference(results, "coptimal", "cglobal")[0].mean()
    largest = results.items("n_")[-1]
    shares = [results(f"n_{largest}", a, "operations_share") for a in ("cglobal", "coptimal")]
    page.figure("Figures 2.20, 2.23", "Trees by global error, and the optimal tree", picture,
                "unconstrained algorithms are at most 3.92 dB above <code>cglobal</code>; "
                "<code>coptimal</code> gains 0.5 dB more. 5 and 7 m log₂ m operations.",
                f"at most {most(np.maximum(gap, other), rates)} segments; <code>coptimal</code> "
                f"gains {last:.2f} dB in the mean{'' if last >= 0.4 else NOT_REPRODUCED}. They "
                f"take {shares[0]:.1f} and {shares[1]:.1f} m log₂ m operations.", POLYLINE)


def crossing_rate(results):
    gap, rates = difference(results, "crefine", "cdecimate")
    ahead = np.flatnonzero(gap > 0.005)
    return int(rates[ahead[-1]]) if len(ahead) else "no"


def chapter_2(page):
    results = Results("chapter_2.csv")
    page.chapter(2, "Polylines", "Seven algorithms of the thesis, and decimation by global error "
                 "without a tree, on rows of the central 257² samples of each terrain.")
    table_23(page, results)
    figures_2(page, results)
    return results


# Chapter 3

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


def chapter_3(page):
    results = Results("chapter_3.csv")
    page.chapter(3, "The 4-8 mesh", "Counts on complete meshes: no terrain is involved.")
    figure_35(page, results)
    theorem_31(page, results)
    figure_37(page, results)
    figure_39(page, results)


# Chapter 4

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


def chapter_4(page):
    sides = sorted(int(p.stem.split("_")[2]) for p in FOLDER.glob("chapter_4_*.csv"))
    results = {s: Results(f"chapter_4_{s}.csv") for s in sides}
    page.chapter(4, "The semi-linear quadtree", "Times of one thread; other programs on the "
                 "machine disturb single points.")
    figure_paths(page, sides, results)
    figure_depth(page, sides, results)
    figure_views(page, sides, results)


# Chapter 5

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


def draw_mesh(axes, budget):
    triangles = np.loadtxt(FOLDER / f"mesh_{budget}.csv", delimiter=",", skiprows=1)
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
                                       if budget > 1600 else "#00000030", linewidths=0.25))
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
        draw_mesh(axis, budget)
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


def table_51(page, results):
    sizes = results.items("n_")
    get = lambda n, q, of="general": results(f"n_{n}", of, q)
    rows = []
    for n in sizes:
        printed = PRINTED_51.get(n, (math.nan, math.nan))
        here = get(n, "initial_s") + get(n, "decimation_s")
        direct = get(n, "decimation_s", "direct")
        rows.append([f"{n:,}", *(("–" if math.isnan(p) else f"{p:g}") for p in printed),
                     f"{get(n, 'initial_s'):.5f}", f"{get(n, 'decimation_s'):.5f}",
                     "–" if math.isnan(direct) else f"{direct:.2f}",
                     "–" if math.isnan(sum(printed)) else f"{sum(printed) / here:.0f}"])
    large = np.array([n for n in sizes if n >= 8192])
    ours = power(large, [get(n, "decimation_s") for n in large])
    theirs = np.array([(n, s[1]) for n, s in PRINTED_51.items() if n >= 8192])
    direct = np.array([(n, get(n, "decimation_s", "direct")) for n in sizes
                       if not math.isnan(get(n, "decimation_s", "direct"))])
    grows = f" The direct algorithm, which removes the same, grows with {power(*direct.T):.2f}." \
        if len(direct) > 1 else ""
    page.table("Table 5.1", "Time of decimation, seconds",
               ["n", "printed: initial", "decimation", "here: initial", "decimation", "direct",
                "times faster"], rows,
               f"on a Pentium III of 500 MHz; exponent {power(*theirs.T):.2f} over n.",
               f"processor time on the machine that made this page; exponent {ours:.2f} over n, "
               f"where n log n has {power(large, large * np.log(large)):.2f}; the largest "
               f"meshes leave the caches.{grows} Sizes above the file's are mirrored.", MESH)


def chapter_5(page, polylines):
    results = Results("chapter_5.csv")
    page.chapter(5, "Decimation", "Meshes of 131 072 triangles over the central 257² samples.")
    figure_58(page, results)
    figure_59(page, polylines)
    figure_510(page, polylines, results)
    figure_511(page, results)
    figure_513(page, results)
    table_51(page, results)


def main():
    page = Page()
    polylines = chapter_2(page)
    chapter_3(page)
    chapter_4(page)
    chapter_5(page, polylines)
    page.write()


main()
