# SPDX-License-Identifier: Apache-2.0
"""Chapter 2: polylines."""

import math

import matplotlib.pyplot as plt
import numpy as np

from page import COLOURS, GREY, INK, NOT_REPRODUCED, panels
from results import Results, most, number, power

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


def write(page):
    results = Results(page.folder / "chapter_2.csv")
    page.chapter(2, "Polylines", "Seven algorithms of the thesis, and decimation by global error "
                 "without a tree, on rows of the central 257² samples of each terrain.")
    table_23(page, results)
    figures_2(page, results)
