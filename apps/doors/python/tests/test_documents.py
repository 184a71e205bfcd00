# SPDX-License-Identifier: Apache-2.0
"""The example runs, and what README.md and docstrings show works."""

import importlib.util
import re
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import numpy as np
import pytest
from conftest import REPOSITORY, photograph, terrain
from test_objects import sphere

import tetrakis

DOOR = REPOSITORY / "apps" / "doors" / "python"


def test_the_example_draws_a_curve(tmp_path):
    pytest.importorskip("matplotlib")
    output = tmp_path / "curve.png"
    heights = tmp_path / "heights.npy"
    np.save(heights, terrain())
    example = DOOR / "examples" / "rate_distortion.py"
    run = [sys.executable, example, heights, "-o", output]
    printed = subprocess.run(run, check=True, capture_output=True, text=True).stdout
    assert output.read_bytes().startswith(b"\x89PNG") and "dB" in printed


def zarr_generation():
    try:
        return metadata.version("zarr").split(".")[0]
    except metadata.PackageNotFoundError:
        return None


def have(*packages):
    return all(importlib.util.find_spec(name) for name in packages)


def test_what_the_readme_shows_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", terrain(64, 64))
    np.save("texture.npy", photograph(64, 64))
    points, triangles = sphere(9, 12)
    np.savez("scan.npz", points=points, triangles=triangles)
    names = {}
    blocks = re.findall(r"```python\n(.*?)```", (DOOR / "README.md").read_text(), re.S)
    assert len(blocks) >= 3
    for block in blocks:
        if "import zarr" in block and f"# Zarr {zarr_generation()}\n" not in block:
            continue
        if "import rasterio" in block and not have("rasterio", "xarray"):
            continue
        exec(block, names)
    assert "array" in names or not zarr_generation()


def test_the_licence_comes_along():
    installed = Path(tetrakis.__file__).with_name("LICENSE")
    assert installed.read_bytes() == (REPOSITORY / "LICENSE").read_bytes()


def test_a_copy_of_the_folder_can_be_imported(tmp_path):
    """Without what pip writes beside it."""
    shutil.copytree(Path(tetrakis.__file__).parent, tmp_path / "tetrakis")
    script = f"import sys; sys.path[:0] = [{str(tmp_path)!r}]\n" + (
        "import importlib.metadata as metadata\n"
        "def version(name): raise metadata.PackageNotFoundError(name)\n"
        "metadata.version = version\n"
        "import tetrakis; print(tetrakis.__file__, tetrakis.tks_version())\n"
    )
    printed = subprocess.check_output([sys.executable, "-c", script], text=True).split()
    assert Path(printed[0]).parent == tmp_path / "tetrakis"
    assert printed[1:] == ["tetrakis", "0+unknown"]


def test_all_that_is_public_is_described():
    for name in tetrakis.__all__:
        thing = getattr(tetrakis, name)
        if name != "__version__":
            assert thing.__doc__, name
    for kind in (tetrakis.Stream, tetrakis.Sequence, tetrakis.SequenceEncoder, tetrakis.Clock):
        for name in vars(kind):
            if not name.startswith("_") and name not in ("closed", "tick", "epoch", "calendar"):
                assert getattr(kind, name).__doc__, name
