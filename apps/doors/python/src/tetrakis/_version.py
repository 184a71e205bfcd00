# SPDX-License-Identifier: Apache-2.0
"""The version that the package was installed with: that of the C library."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("tetrakis")
except PackageNotFoundError:  # a copy of the folder alone
    __version__ = "0+unknown"
