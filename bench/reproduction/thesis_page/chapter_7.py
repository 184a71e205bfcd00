# SPDX-License-Identifier: Apache-2.0
"""Chapter 7: open problems."""

import numpy as np

from results import Results

BITS = "build/bench/bench_thesis_bits FOLDER"
CODECS = ("triangles", "bits_1", "bits_2", "bits_3", "prefix")


def write(page):
    results = Results(page.folder / "chapter_7.csv")
    page.chapter(7, "Open problems", "What decimation gains if the rate is bits.")
    terrains = list(dict.fromkeys(item for item, _, _ in results.values))
    rows = []
    for budget in sorted({int(q.split("_")[1]) for _, _, q in results.values}):
        of = {c: np.array([results(t, c, f"bytes_{budget}") for t in terrains]) for c in CODECS}
        saved = 100 * (1 - of["bits_1"] / of["triangles"])
        rows.append([f"{budget:,}", *(f"{of[c].mean():,.0f}" for c in CODECS),
                     f"{saved.mean():.1f} % ({saved.min():.1f} to {saved.max():.1f})",
                     f"{(of['triangles'] / of['prefix']).mean():.1f}"])
    page.table("Section 7.3.1", "Bytes at equal error, with triangles and with bits as the rate",
               ["triangles", "rate: triangles", "bits, once", "twice", "three times",
                "prefix of a stream", "saved by bits", "times the prefix"], rows,
               "left open: a mesh that is decimated for the bits of its code.",
               "meshes coded vertex by vertex, heights to the step, by ideal adaptive arithmetic "
               "coding; the bits of each vertex are its cost, found anew for each round. Means "
               f"over {len(terrains)} terrain{'s' if len(terrains) > 1 else ''} of 257². Vertices "
               "cost about as many bits each, so that triangles are nearly as good a rate.", BITS)
