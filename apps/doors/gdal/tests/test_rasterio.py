# SPDX-License-Identifier: Apache-2.0
"""Rasterio, Debian's, which loads the same GDAL."""

import numpy as np
import pytest
from conftest import SAMPLES, copy, terrain

rasterio = pytest.importorskip("rasterio")
shutil = pytest.importorskip("rasterio.shutil")


def test_read(placed):
    with rasterio.open(placed) as dataset:
        assert dataset.driver == "TKS" and dataset.profile["nodata"] == -32768
        assert dataset.crs.to_string().startswith("COMPD") or dataset.crs.is_projected
        assert dataset.transform.to_gdal() == (400000, 10, 0, 3800000, 0, -10)
        assert dataset.overviews(1) == [2] and dataset.units == ("m",)
        assert (dataset.scales, dataset.offsets) == ((0.5,), (100,))
        np.testing.assert_array_equal(dataset.read(1), terrain(dtype="i2"))
        part = dataset.read(1, window=rasterio.windows.Window(20, 30, 50, 60))
        np.testing.assert_array_equal(part, terrain(dtype="i2")[30:90, 20:70])
        assert dataset.read(1, out_shape=(150, 170)).shape == (150, 170)
        assert not dataset.read(1, masked=True).mask.any()
        (name,) = [each for each in dataset.subdatasets if each.endswith("texture")]
    with rasterio.open(name) as image:
        assert image.count == 4 and image.colorinterp[3] == rasterio.enums.ColorInterp.alpha


@pytest.mark.parametrize("dtype", [each for each in SAMPLES if each != "i1"])
def test_write(tmp_path, dtype):
    name = tmp_path / "a.tks"
    transform = rasterio.transform.from_origin(400000, 3800000, 30, 30)
    facts = {"crs": "EPSG:32611", "transform": transform, "count": 1, "height": 50, "width": 60}
    with rasterio.open(name, "w", driver="TKS", dtype=np.dtype(dtype).name, **facts) as out:
        out.write(terrain(50, 60, dtype), 1)
    with rasterio.open(name) as dataset:
        np.testing.assert_array_equal(dataset.read(1), terrain(50, 60, dtype))
        assert dataset.crs.to_epsg() == 32611 and dataset.transform == transform
    with rasterio.open(name) as source:
        profile = source.profile
        assert profile["dtype"] == np.dtype(dtype).name
    shutil.copy(name, tmp_path / "b.tks", driver="TKS", MAX_Z_ERROR=2)
    with rasterio.open(tmp_path / "b.tks") as dataset:
        off = np.abs(dataset.read(1).astype(float) - terrain(50, 60, dtype).astype(float))
        assert off.max() <= 2


@pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning")
def test_lossy_profile(tmp_path):
    copy(terrain(), tmp_path / "a.tks", "BYTES=5000")
    with rasterio.open(tmp_path / "a.tks") as dataset:
        assert "compress" not in dataset.profile
