# SPDX-License-Identifier: Apache-2.0
"""The CSV files of the benches, and arithmetic on their columns."""

import csv
import math

import numpy as np


class Results:
    """The rows of one CSV file: value(item, codec, quantity), and what items begin with a text."""

    def __init__(self, path):
        with open(path) as file:
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


def power(x, y):
    """The exponent of y over x, by least squares of the logarithms."""
    return np.polyfit(np.log(x), np.log(y), 1)[0]


def number(value, digits=2):
    return "–" if math.isnan(value) else f"{value:.{digits}f}"


def most(difference, rates):
    """'3.86 dB at 9': the largest difference and its rate."""
    i = int(np.nanargmax(difference))
    return f"{difference[i]:.2f} dB at {int(rates[i])}"
