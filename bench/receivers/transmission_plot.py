# SPDX-License-Identifier: Apache-2.0
"""bench/transmission runs this: transmission_plot.py FRAMES.csv OUT.svg. PSNR over time, a line a
receiver."""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot


def main(frames, out):
    with open(frames, newline="", encoding="utf-8") as file:
        names, *rows = list(csv.reader(file))
    columns = list(zip(*[[float(value) for value in row] for row in rows]))
    figure, axes = pyplot.subplots(figsize=(7, 3.5), layout="constrained")
    for name, values in zip(names[1:], columns[1:]):
        axes.plot(columns[0], values, label=name)
    axes.axvline(30, color="grey", linewidth=0.8, linestyle=":")
    axes.set_xlabel("seconds of the flight")
    axes.set_ylabel("screen PSNR, dB")
    axes.legend()
    figure.savefig(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
