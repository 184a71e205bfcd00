# SPDX-License-Identifier: Apache-2.0
"""QGIS's own raster provider, without a screen; skipped where QGIS is not installed, which takes 140
MB of packages (`apt install --no-install-recommends qgis`). CI has it."""

import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from conftest import copy, gdal, memory, samples, terrain

# Debian's qgis_process hands QGIS's options for its windows on to a program that refuses them.
PROCESS = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
pytestmark = pytest.mark.skipif(PROCESS is None, reason="QGIS is not installed")

PLACE = {"transform": (400000, 10, 0, 3800000, 0, -10), "crs": "EPSG:32611"}

DRAW = """
import json, sys
from qgis.core import *
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor

app = QgsApplication([], False)
app.initQgis()
name, side, png = sys.argv[1], int(sys.argv[2]), sys.argv[3]
registry = QgsProviderRegistry.instance()
layer = QgsRasterLayer(name, "layer", "gdal")
assert layer.isValid(), layer.error().message()
if layer.bandCount() == 1:
    range = QgsContrastEnhancement(layer.dataProvider().dataType(1))
    range.setMinimumValue(0)
    range.setMaximumValue(255)
    range.setContrastEnhancementAlgorithm(QgsContrastEnhancement.StretchToMinimumMaximum)
    layer.setRenderer(QgsSingleBandGrayRenderer(layer.dataProvider(), 1))
    layer.renderer().setContrastEnhancement(range)
settings = QgsMapSettings()
settings.setLayers([layer])
settings.setDestinationCrs(layer.crs())
settings.setBackgroundColor(QColor(0, 0, 0))
settings.setExtent(layer.extent())
settings.setOutputSize(QSize(side, side))
job = QgsMapRendererSequentialJob(settings)
job.start()
job.waitForFinished()
assert job.renderedImage().save(png)
print(json.dumps({
    "filters": registry.fileRasterFilters(),
    "sublayers": [each.uri() for each in registry.querySublayers(name)],
}))
"""


@pytest.fixture(scope="module")
def qgis(tmp_path_factory):
    """Runs a command in a profile of its own, and gives back the JSON that it prints."""
    home = tmp_path_factory.mktemp("home")
    home.chmod(0o700)
    nowhere = {"HOME": str(home), "XDG_RUNTIME_DIR": str(home), "QT_QPA_PLATFORM": "offscreen"}

    def run(*command):
        done = subprocess.run(
            command, env={**os.environ, **nowhere}, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return json.loads(done.stdout[done.stdout.index("{") :])

    return run


def process(qgis, algorithm, **inputs):
    given = [f"--{name}={value}" for name, value in inputs.items()]
    return qgis(PROCESS, "--json", "run", algorithm, *given)["results"]


def both(folder, dtype):
    """The same ground as .tks and as .tif."""
    source = memory(terrain(dtype=dtype), **PLACE)
    names = [str(folder / ("a" + suffix)) for suffix in (".tks", ".tif")]
    copy(source, names[0])
    gdal.GetDriverByName("GTiff").CreateCopy(names[1], source)
    return names


@pytest.mark.parametrize("dtype", ["i2", "f4"])
def test_properties_and_statistics(tmp_path, qgis, dtype):
    ours, theirs = both(tmp_path, dtype)
    for algorithm, more in (("properties", {}), ("statistics", {"BAND": 1})):
        algorithm = "native:rasterlayer" + algorithm
        found, wanted = (process(qgis, algorithm, INPUT=name, **more) for name in (ours, theirs))
        assert found == pytest.approx(wanted) if more else found == wanted


def test_slopes_of_windows(tmp_path, qgis):
    """QGIS reads lines, each with those beside it, and writes what it computes."""
    slopes = []
    for name in both(tmp_path, "f4"):
        process(qgis, "native:slope", INPUT=name, Z_FACTOR=1, OUTPUT=name + ".slope.tif")
        slopes.append(samples(gdal.Open(name + ".slope.tif")))
    np.testing.assert_array_equal(*slopes)


def drawn(qgis, folder, name, side):
    picture = str(folder / "map.png")
    facts = qgis(sys.executable, "-c", DRAW, name, str(side), picture)
    return samples(gdal.Open(picture))[:3].astype(int), facts


def test_maps(tmp_path, qgis):
    """A map in full resolution shows the samples, a smaller one an overview of them."""
    pytest.importorskip("qgis.core")
    ground = terrain(512, 512, "u1")
    copy(memory(ground, **PLACE), tmp_path / "a.tks")
    full, facts = drawn(qgis, tmp_path, str(tmp_path / "a.tks"), 512)
    assert "*.tks" in facts["filters"]
    np.testing.assert_array_equal(full[0], ground)
    small, _ = drawn(qgis, tmp_path, str(tmp_path / "a.tks"), 256)
    means = ground.reshape(256, 2, 256, 2).mean((1, 3))
    assert np.abs(small[0] - means).max() <= 1


def test_heights_and_texture_are_layers(placed, tmp_path, qgis):
    pytest.importorskip("qgis.core")
    placed = shutil.copy(placed, tmp_path)  # QGIS writes statistics beside it
    image, _ = drawn(qgis, tmp_path, f'TKS:"{placed}":texture', 400)
    assert image[:, 300:].std() > 20
    _, facts = drawn(qgis, tmp_path, f'TKS:"{placed}":heights', 50)
    assert len(facts["sublayers"]) == 1
    _, facts = drawn(qgis, tmp_path, placed, 50)
    assert [each.rpartition(":")[2] for each in facts["sublayers"]] == ["heights", "texture"]
