# SPDX-License-Identifier: Apache-2.0
"""Chapter 6: mesh and texture together, from what bench/joint --figures left."""

import csv
import html
import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from page import COLOURS, GREY, INK, WIDTH, panels
from results import Results, most

JOINT = "bench/joint FOLDER --figures OUT --grid N"


class Pairs:
    """Pairs of prefixes of either track: heights and textures in bytes, psnr[height, texture]."""

    def __init__(self, path):
        with open(path) as file:
            rows = list(csv.DictReader(file))
        of = lambda what: np.array([[float(r[k] or "nan") for k in ("heights", "texture", "psnr")]
                                    for r in rows if r["what"] == what]).reshape(-1, 3)
        every = of("pair")
        self.heights, self.textures = np.unique(every[:, 0]), np.unique(every[:, 1])
        seen = every[:, 2].reshape(len(self.heights), len(self.textures))
        self.psnr = np.where(np.isfinite(seen), seen, seen[np.isfinite(seen)].max())
        self.bytes = self.heights[:, None] + self.textures[None, :]
        self.hull, self.greedy, self.shipped = of("hull"), of("greedy"), of("shipped")
        self.models = {"6.9": of("equal_psnr"), "6.10": of("equal_bytes")}

    def at(self, heights, texture):
        """dB between the nodes; nan outside."""
        logs = np.log(self.heights), np.log(self.textures)
        rows = [np.interp(math.log(texture), logs[1], row, np.nan, np.nan) for row in self.psnr]
        return np.interp(math.log(heights), logs[0], rows, np.nan, np.nan)


def captions(folder, figure):
    """(path of the picture, caption) of each plate of a figure."""
    with open(folder / "plates.csv") as file:
        return [(folder / f"{r['plate']}.png", html.escape(r["caption"]))
                for r in csv.DictReader(file) if r["plate"][:-1] == figure]


def figure_64(page, folder, terrain, results):
    seen = [results(terrain, f"6.4{plate}", "db") for plate in "ab"]
    page.plates("Figure 6.4", "Meshes for a viewer and for a map", captions(folder, "6.4"),
                "a view-dependent mesh has its triangles near the viewer; pictures.",
                f"2000 triangles for the low camera have {seen[0]:.1f} dB in its picture, as many "
                f"for a map {seen[1]:.1f} dB.", JOINT)
    edges = np.genfromtxt(folder / "edges.csv", delimiter=",", skip_header=1)
    picture, axes = panels(2, 4.2)
    for mesh, axis in enumerate(axes):
        own = edges[edges[:, 0] == mesh, 1:]
        lines, eye = own[~np.isnan(own[:, 2])], own[np.isnan(own[:, 2])][0, :2]
        far = lines.reshape(-1, 2).max(axis=0)
        axis.add_collection(LineCollection(lines.reshape(-1, 2, 2), colors=INK, linewidths=0.3))
        border = 0.04 * far.max()
        axis.plot(*np.clip(eye, -border / 2, far + border / 2), "o", color=COLOURS[1], ms=7)
        axis.set(xlim=(-border, far[0] + border), ylim=(far[1] + border, -border), aspect="equal",
                 xticks=[], yticks=[], title=("for the viewer", "for a map")[mesh])
        axis.grid(False)
        for spine in axis.spines.values():
            spine.set_visible(False)
    page.figure("Figure 6.4, from above", "The same meshes", picture, "as above.",
                "the dot is the viewer, moved to the border if he stands outside.", JOINT)


def figure_65(page, folder, terrain, results):
    get = lambda plate, what="db": results(terrain, f"6.5{plate}", what)
    page.plates("Figure 6.5", "Bytes for a viewer and for anybody", captions(folder, "6.5"),
                "a view-dependent texture is blurred where nobody looks; pictures.",
                "streams of 16 kB. The one that was told the low camera has "
                f"{get('a'):.1f} dB in it, the one told nothing {get('c'):.1f} dB; from above "
                f"they have {get('b'):.1f} and {get('d'):.1f} dB. They give the heights "
                f"{get('a', 'heights_bytes') / 1000:.1f} and "
                f"{get('c', 'heights_bytes') / 1000:.1f} kB.", JOINT)


def figure_66(page, pairs):
    picture, axes = plt.subplots(figsize=(WIDTH * 0.75, 3.9), layout="constrained")
    for t, shade in enumerate(plt.cm.viridis(np.linspace(0.95, 0.15, len(pairs.textures)))):
        axes.semilogx(pairs.bytes[:, t], pairs.psnr[:, t], "o-", ms=2, lw=0.8, color=shade)
    axes.plot(pairs.hull[:, :2].sum(axis=1), pairs.hull[:, 2], color=COLOURS[1], lw=2,
              label="hull of all pairs")
    axes.plot(pairs.greedy[:, :2].sum(axis=1), pairs.greedy[:, 2], ":", color=INK, lw=1.6,
              label="marginal analysis")
    axes.set(xlabel="bytes of heights and texture", ylabel="screen PSNR, dB")
    axes.legend()
    first, last = pairs.textures[[0, -1]]
    page.figure("Figure 6.6", "Pairs of meshes and textures", picture,
                "60 meshes × 32 textures, D over R; the best pairs are on the lower hull.",
                f"{len(pairs.heights)} prefixes of heights × {len(pairs.textures)} of texture, a "
                f"line for each texture, from {first:,.0f} bytes (light) to {last:,.0f} (dark). "
                "Lines of coarse textures end level: a finer mesh does not help them.", JOINT)


def draw_plane(axes, pairs, values, levels, label, marks):
    """Lines of equal values over the bytes of heights and textures, with the paths."""
    axes.set(xscale="log", yscale="log", xlabel="bytes of heights", ylabel="bytes of texture",
             xlim=pairs.heights[[0, -1]], ylim=pairs.textures[[0, -1]])
    axes.grid(False)
    lines = axes.contour(pairs.heights, pairs.textures, values.T, levels=levels, colors=GREY,
                         linewidths=0.8)
    for text in axes.clabel(lines, fmt=label, fontsize=7, inline_spacing=2):
        text.set(zorder=4, bbox={"fc": "white", "ec": "none", "pad": 0.6})
    axes.plot(*pairs.shipped[:, :2].T, color=COLOURS[2], lw=1.2, label="the stream's order")
    axes.plot(*pairs.hull[:, :2].T, color=COLOURS[1], lw=2.2, label="hull of all pairs")
    axes.plot(*pairs.greedy[:, :2].T, "o:", color=INK, ms=2.5, lw=1.2, label="marginal analysis")
    for name, (heights, texture, _) in zip("abcdef", marks):
        axes.annotate(name, (heights, texture), ha="center", va="center", fontsize=8,
                      bbox={"boxstyle": "circle,pad=0.25", "fc": "white", "ec": COLOURS[0]})


def lost(pairs):
    """dB of the stream's order below the hull at as many bytes, from 2 kB on, and the bytes."""
    totals, below = [], []
    for heights, texture, _ in pairs.shipped:
        if heights + texture < 2000:
            continue
        totals.append(heights + texture)
        best = np.interp(math.log(totals[-1]), np.log(pairs.hull[:, :2].sum(axis=1)),
                         pairs.hull[:, 2])
        below.append(best - pairs.at(heights, texture))
    return np.array(below), np.array(totals)


def worse_with_texture(pairs):
    """Words: how much the mesh of fewest bytes loses by the whole texture, beside its best."""
    row = pairs.psnr[0]
    best = int(np.argmax(row))
    if best == len(row) - 1:
        return "Even the coarsest mesh gains by all of the texture."
    return (f"The mesh of {pairs.heights[0]:,.0f} bytes has {row[best]:.2f} dB with "
            f"{pairs.textures[best]:,.0f} bytes of texture and {row[-1]:.2f} dB with "
            f"{pairs.textures[-1]:,.0f}: more texture on a coarse mesh is worse.")


def figures_67_68(page, terrain, results, pairs):
    get = lambda what: results(terrain, "marginal", what)
    picture, axes = plt.subplots(figsize=(WIDTH * 0.75, 4.6), layout="constrained")
    levels = np.arange(math.ceil(pairs.psnr.min()), pairs.psnr.max(), 2)
    draw_plane(axes, pairs, pairs.psnr, levels, "%d dB", pairs.models["6.9"])
    axes.legend(loc="upper left")
    below, totals = lost(pairs)
    mean = np.nanmean(below)
    page.figure("Figure 6.7", "Paths through the plane, and lines of equal PSNR", picture,
                "marginal analysis has a path of 84 pairs and looks at 168 of 1920; on coarse "
                "meshes more texture stops helping.",
                f"a path of {get('path'):.0f} pairs, {get('looked'):.0f} of {get('pairs'):.0f} "
                f"looked at, {get('mean_db_lost'):.3f} dB below the best pair of no more bytes in "
                f"the mean and {get('worst_db_lost'):.3f} at worst. The stream's order, chosen "
                f"without a picture, is {abs(mean):.2f} dB {'below' if mean > 0 else 'above'} the "
                "hull in the mean (drawn pairs, interpolated; from 2 kB on), and at most "
                f"{most(below, totals)} bytes below. "
                f"{worse_with_texture(pairs)} Letters: figure 6.9.", JOINT)
    picture, axes = plt.subplots(figsize=(WIDTH * 0.75, 4.6), layout="constrained")
    powers = 2.0 ** np.arange(math.ceil(math.log2(pairs.bytes.min())), math.log2(pairs.bytes.max()))
    draw_plane(axes, pairs, pairs.bytes, powers,
               lambda b: f"{b / 1024:g} KiB" if b >= 1024 else f"{b:g} B", pairs.models["6.10"])
    axes.legend(loc="upper left")
    page.figure("Figure 6.8", "The same paths, and lines of equal bytes", picture,
                "the path crosses lines of equal rate where D is least.",
                "letters: figure 6.10.", JOINT)


def write(page):
    path = page.folder / "chapter_6.csv"
    if not path.exists():
        page.chapter(6, "Mesh and texture", "Left out: bench/joint could not draw.")
        return
    results = Results(path)
    terrain = next(iter(results.values))[0]
    folder = page.folder / "joint" / terrain
    pairs = Pairs(folder / "pairs.csv")
    page.chapter(6, "Mesh and texture", f"A stream of 256 kB of {html.escape(terrain)}, heights "
                 "and texture; its prefixes are drawn, and dB are those of the pictures of three "
                 "cameras (oblique, low and top) unless one is named.")
    figure_64(page, folder, terrain, results)
    figure_65(page, folder, terrain, results)
    figure_66(page, pairs)
    figures_67_68(page, terrain, results, pairs)
    models = pairs.models["6.9"]
    totals = models[:, 0] + models[:, 1]
    page.plates("Figure 6.9", "Models of one PSNR", captions(folder, "6.9"),
                "six pairs of one line of equal PSNR.",
                f"{len(models)} pairs on one line, of {totals.min():,.0f} to {totals.max():,.0f} "
                "bytes.", JOINT)
    decibels = pairs.models["6.10"][:, 2]
    page.plates("Figure 6.10", "Models of 10 kB", captions(folder, "6.10"),
                "six pairs of 10 kB; the best one shares them.",
                f"from few heights to nearly nothing else: "
                f"{', '.join(f'{d:.1f}' for d in decibels)} dB.", JOINT)
