# SPDX-License-Identifier: Apache-2.0
"""Draws PSNR over bytes: one stream of a terrain, cut after ever fewer bytes.

    python3 rate_distortion.py [HEIGHTS.npy] [-o curve.png]

Editors that know cells ("# %%") run it piece by piece, as a notebook.
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import tetrakis

# %% Arguments, and a terrain to play with: noise whose spectrum falls as that of mountains does


def hills(side=257, seed=1):
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(side), np.fft.rfftfreq(side), indexing="ij"))
    frequency[0, 0] = np.inf
    noise = np.random.default_rng(seed).normal(size=(side, side))
    heights = np.fft.irfft2(np.fft.rfft2(noise) * frequency**-2.0, (side, side))
    heights *= 300 / heights.std()
    return (np.round(heights * 10) / 10).astype(np.float32)  # metres, in decimetres


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("heights", nargs="?", help="an array of (rows, columns) saved by numpy.save")
parser.add_argument("-o", "--output", default="rate_distortion.png")
parser.add_argument("--side", type=int, default=257, help="of the terrain made here")
arguments = parser.parse_args()
original = np.load(arguments.heights) if arguments.heights else hills(arguments.side)

# %% One stream: it serves all rates, the last of which is lossless

stream = tetrakis.encode(original, threads=2)
print(f"{original.shape} {original.dtype}: {original.nbytes} bytes, lossless in {len(stream)}")

# %% Its prefixes


def psnr(heights):
    mean_square = np.nanmean((heights.astype(np.float64) - original) ** 2)
    peak = float(np.nanmax(original)) - float(np.nanmin(original))
    return 10 * np.log10(peak**2 / mean_square) if mean_square > 0 else np.inf


with tetrakis.open(stream) as terrain:
    lengths = np.geomspace(terrain.info.header_bytes, len(stream), 40).astype(int)
    qualities = [psnr(terrain.surface(bytes=length)) for length in lengths]
for length, quality in list(zip(lengths, qualities))[::8]:
    print(f"{length:9d} bytes  {quality:6.2f} dB")

# %% The curve

figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
axes.semilogx(lengths, qualities, ".-")
axes.set(xlabel="bytes of the prefix", ylabel="PSNR of heights, dB", title="One stream, cut")
axes.grid(alpha=0.3)
figure.savefig(arguments.output, dpi=120)
print(f"wrote {arguments.output}")
