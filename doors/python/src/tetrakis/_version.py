# SPDX-License-Identifier: Apache-2.0
"""The version that the package was installed with: that of the C library."""

from importlib.metadata import version

__version__ = version("tetrakis")
