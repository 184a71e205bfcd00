# SPDX-License-Identifier: Apache-2.0
"""Builds the wheel: CMake makes the shared library, which goes beside the modules.

TETRAKIS_BUILD_DIR names a build folder to use, so that what it holds is not compiled again;
otherwise one is made below build/ of the source tree.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parents[2]
SCRATCH = SOURCE / "build" / "doors"
LIBRARY = "libtetrakis.so"


def version():
    """That of the C library."""
    text = (SOURCE / "CMakeLists.txt").read_text()
    return re.search(r"project\(tetrakis VERSION ([0-9.]+)", text).group(1)


def built_library():
    given = os.environ.get("TETRAKIS_BUILD_DIR")
    folder = Path(given) if given else SCRATCH / "library"
    if not given:
        options = ["-DCMAKE_BUILD_TYPE=Release"]
        options += [f"-DTETRAKIS_{what}=OFF" for what in ("BUILD_TOOLS", "BUILD_TESTS", "INSTALL")]
        subprocess.check_call(["cmake", "-S", SOURCE, "-B", folder, *options])
    jobs = str(os.cpu_count() or 1)  # without a number make starts all of them at once
    build = ["cmake", "--build", folder, "--target", "tetrakis_python", "--parallel", jobs]
    subprocess.check_call(build)
    return folder / "doors" / "python" / LIBRARY


class BuildWithLibrary(build_py):
    def run(self):
        shutil.rmtree(self.build_lib, ignore_errors=True)  # modules that are gone
        super().run()
        package = Path(self.build_lib) / "tetrakis"
        shutil.copy2(built_library(), package / LIBRARY)
        shutil.copy2(SOURCE / "LICENSE", package)


class WithMachineCode(Distribution):
    def has_ext_modules(self):
        return True


class WheelForEveryPython(bdist_wheel):
    """The library is called through ctypes: any Python 3, but one platform."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


# setuptools leaves its scratch files in build/ as everything else does.
(SCRATCH / "setuptools").mkdir(parents=True, exist_ok=True)
os.chdir(HERE)
setup(
    version=version(),
    distclass=WithMachineCode,
    cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelForEveryPython},
    options={
        "build": {"build_base": str(SCRATCH / "setuptools")},
        "egg_info": {"egg_base": str(SCRATCH / "setuptools")},
    },
)
