# SPDX-License-Identifier: Apache-2.0
"""Chapter 7: open problems."""

import html

import numpy as np

from results import Results

BITS = "build/bench/bench_thesis_bits FOLDER"
CODECS = ("triangles", "bits_1", "bits_2", "bits_3", "prefix")


def write(page):
    results = Results(page.folder / "chapter_7.csv")
    page.chapter(7, "Open problems", "What decimation gains if the rate is bits.")
    terrains = list(dict.fromkeys(item for item, _, _ in results.values))
    budgets = sorted({int(q.split("_")[1]) for _, _, q in results.values})
    rows, gains, prefixes = [], {}, {}
    for budget in budgets:
        of = {c: np.array([results(t, c, f"bytes_{budget}") for t in terrains]) for c in CODECS}
        gains[budget] = 100 * (1 - (of["bits_1"] / of["triangles"]).mean())
        prefixes[budget] = (of["triangles"] / of["prefix"]).mean()
        for k, terrain in enumerate(terrains):
            rows.append([html.escape(terrain), budget, *(f"{of[c][k]:,.0f}" for c in CODECS)])
    words = ", ".join(f"{g:.1f} % ({b})" for b, g in gains.items())
    times = ", ".join(f"{p:.1f} ({b})" for b, p in prefixes.items())
    page.table("Section 7.3.1", "Bytes at equal error, with triangles and with bits as the rate",
               ["terrain", "triangles", "rate: triangles", "bits, once", "twice", "three times",
                "prefix of a stream"], rows,
               "left open: a mesh that is decimated for the bits of its code.",
               "meshes coded vertex by vertex, heights to the step, by ideal adaptive arithmetic "
               "coding; the bits of each vertex are its cost, found anew for each round. What this "
               f"saves, in the mean of the terrains (triangles): {words}. All vertices cost about "
               "as many bits, so triangles are a good rate. Prefixes of the stream err as little "
               f"in fewer bytes; the mesh has {times} times as many.", BITS)
