# SPDX-License-Identifier: Apache-2.0
"""One corpus of files through the command line, this plugin and Python: samples, voids, nodata
value, place, CRS and unit come back alike, and as in the source, or all doors refuse; notes and
warnings tell of the same."""

import re
import subprocess
import sys
from dataclasses import dataclass
from typing import Any, Optional

import corpus
import numpy as np
import pytest
from conftest import REPOSITORY, copy, gdal, memory, samples, terrain, warnings_of

TETRAKIS = REPOSITORY / "build/tetrakis"
UNITS = {"metre": "m", "foot": "ft", "US survey foot": "us-ft"}

# What a note of the command line and a warning of the plugin say alike.
TOLD = {
    "rounded": "rounded to",
    "another nodata value": "do not hold its nodata value",
    "no void": "no sample of its type can have the nodata value",
    "far": "far from all others",
    "masks differ": "masks of (its|the) bands.* differ",
    "mask dropped": "mask .*not applied and not kept",
    "nodata dropped": "nodata value .*not applied and not kept",
}


def told(texts):
    return {what for what, words in TOLD.items() if re.search(words, texts, re.IGNORECASE)}


@dataclass
class Facts:
    """What GDAL says of a raster."""

    layers: np.ndarray
    void: np.ndarray
    nodata: Optional[float]
    transform: Any
    crs: Any
    point: bool
    unit: str
    scaling: tuple
    description: str

    @staticmethod
    def of(name):
        dataset = gdal.Open(name)
        band = dataset.GetRasterBand(1)
        layers = samples(dataset)
        void = band.GetMaskBand().ReadAsArray() == 0
        if layers.ndim == 2 and layers.dtype.kind == "f":
            void |= np.isnan(layers)
        unit = band.GetUnitType()
        return Facts(
            layers, void, band.GetNoDataValue(), dataset.GetGeoTransform(can_return_null=True),
            dataset.GetSpatialRef(), dataset.GetMetadataItem("AREA_OR_POINT") == "Point",
            UNITS.get(unit, unit), (band.GetScale() or 1, band.GetOffset() or 0),
            band.GetDescription(),
        )  # fmt: skip


def same_number(a, b):
    return a is b or a == b or (a is not None and b is not None and np.isnan(a) and np.isnan(b))


def same_system(a, b):
    if a is None or b is None:
        return a is b
    options = ["IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT"]
    return bool(a.IsSame(b, options if a.GetAuthorityCode(None) is None else options[:1]))


def assert_alike(got, other):
    """Of two doors: everything, down to the bits of heights."""
    assert got.layers.dtype == other.layers.dtype
    np.testing.assert_array_equal(got.void, other.void)
    np.testing.assert_array_equal(got.layers, other.layers)
    if got.layers.dtype.kind == "f":
        np.testing.assert_array_equal(np.signbit(got.layers), np.signbit(other.layers))
    assert same_number(got.nodata, other.nodata), (got.nodata, other.nodata)
    assert_described_alike(got, other)
    assert got.unit == other.unit


def assert_described_alike(got, other):
    assert got.transform == other.transform
    assert same_system(got.crs, other.crs), (got.crs, other.crs)
    assert (got.point, got.scaling, got.description) == (
        other.point, other.scaling, other.description
    )  # fmt: skip


def run(*arguments):
    words = [str(TETRAKIS), *(str(argument) for argument in arguments)]
    return subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)


def by_command_line(kind, name, folder):
    """The facts, and what was told; no facts where it was refused."""
    what = [name] if kind == "height" else ["--texture", name]
    stream, back = folder / "cli.tks", folder / "cli.tif"
    encoded = run("encode", *what, "--lossless", "-o", stream)
    if encoded.returncode == 1 and "64-bit floats that 32 bits do not hold" in encoded.stderr:
        # The plugin, which has no such promise to keep, rounds.
        encoded = run("encode", *what, "--max-error", "1e-6", "-o", stream)
    if encoded.returncode != 0:
        return None, encoded.stderr
    decoded = run("decode", stream, f"--{kind}", back)
    assert decoded.returncode == 0, decoded.stderr
    return Facts.of(str(back)), encoded.stderr


def by_plugin(kind, name, folder):
    stream = folder / "gdal.tks"

    def write():
        if kind == "height":
            return copy(gdal.Open(name), stream, strict=False)
        return copy(memory(terrain(20, 25)), stream, "TEXTURE=" + name, strict=False)

    try:
        made, heard = warnings_of(write)
        del made
    except RuntimeError as failure:
        return None, str(failure)
    (folder / "gdal.tks.aux.xml").unlink(missing_ok=True)  # the stream has to say it all
    opened = str(stream) if kind == "height" else f'TKS:"{stream}":texture'
    return Facts.of(opened), "\n".join(heard)


def by_python(stream, facts):
    """What Python reads of a stream of heights, where its wheel has been built and installed."""
    environment = REPOSITORY / "build/doors/environment/lib"
    installed = next(environment.glob("python3*/site-packages"), None)
    if installed is None or not (installed / "tetrakis").exists():
        return
    if str(installed) not in sys.path:
        sys.path.append(str(installed))
    import tetrakis

    with tetrakis.open(stream.read_bytes()) as opened:
        array = opened.heights(masked=True)
        assert same_number(opened.info.nodata, facts.nodata)
    np.testing.assert_array_equal(np.ma.getmaskarray(array), voids_of(facts))
    np.testing.assert_array_equal(array.data[~voids_of(facts)], facts.layers[~voids_of(facts)])


def voids_of(facts):
    """By the value alone: GDAL takes a nodata value of 1.5 for 1 among integers."""
    with np.errstate(invalid="ignore"):
        return np.isnan(facts.layers) | (facts.layers == facts.nodata)


def assert_kept(source, got, notes):
    """The source, but for what notes tell."""
    as_floats = source.layers.dtype == np.float64
    taken = re.search("far from all others: taken|far from all others: declared", notes)
    void = source.void.copy()
    if taken:
        void |= source.layers == got.nodata
    if source.nodata is not None and got.layers.dtype.kind == "f":
        void |= np.isnan(source.layers)
    np.testing.assert_array_equal(got.void, void)
    valid = ~void
    with np.errstate(over="ignore", invalid="ignore"):
        expected = source.layers.astype(np.float32) if as_floats else source.layers
    tolerance = 1e-6 if "rounded" in told(notes) else 0
    np.testing.assert_allclose(got.layers[valid], expected[valid], rtol=0, atol=tolerance)
    if not (taken or "another nodata value" in told(notes)) and source.nodata is not None:
        if got.layers.dtype.kind != "f" and np.isinf(source.nodata):
            assert got.nodata is None
        elif "mask is read as" not in notes:
            kept = np.float32(source.nodata) if as_floats else source.nodata
            assert same_number(got.nodata, float(kept)), (got.nodata, source.nodata)
    assert_described_alike(got, source)
    assert source.unit in ("", got.unit)


@pytest.mark.parametrize("case", corpus.height_cases(), ids=str)
def test_heights_come_back_alike(tmp_path, case):
    name = case.write(tmp_path)
    command, notes = by_command_line("height", name, tmp_path)
    plugin, warnings = by_plugin("height", name, tmp_path)
    assert (command is None) == (plugin is None), notes + warnings
    if command is None:
        return
    assert told(notes) == told(warnings), notes + warnings
    assert_alike(command, plugin)
    assert_kept(Facts.of(name), command, notes)
    for stream in ("cli.tks", "gdal.tks"):
        assert_alike(Facts.of(str(tmp_path / stream)), command)
        by_python(tmp_path / stream, command)
    if (tmp_path / "cli.tks").read_bytes() != (tmp_path / "gdal.tks").read_bytes():
        back = tmp_path / "back.tif"
        decoded = run("decode", tmp_path / "gdal.tks", "--height", back)
        assert decoded.returncode == 0, decoded.stderr
        assert_alike(Facts.of(str(back)), command)


@pytest.mark.parametrize("case", corpus.texture_cases(), ids=str)
def test_textures_come_back_alike(tmp_path, case):
    name = case.write(tmp_path)
    command, notes = by_command_line("texture", name, tmp_path)
    plugin, warnings = by_plugin("texture", name, tmp_path)
    assert (command is None) == (plugin is None), notes + warnings
    if command is None:
        return
    assert told(notes) == told(warnings), notes + warnings
    for got in (command, plugin):
        np.testing.assert_array_equal(got.layers, texels_of(name))
        assert same_system(got.crs, Facts.of(name).crs)
        assert got.transform == Facts.of(name).transform


def texels_of(name):
    """In the order of a texture, with an alpha of what all bands hide."""
    dataset = gdal.Open(name)
    bands = [dataset.GetRasterBand(i + 1) for i in range(dataset.RasterCount)]
    order = [*corpus.RGB, gdal.GCI_GrayIndex, gdal.GCI_Undefined, gdal.GCI_AlphaBand]
    bands.sort(key=lambda band: order.index(band.GetColorInterpretation()))
    layers = [band.ReadAsArray() for band in bands]
    if len(bands) % 2 != 0:
        shown = np.bitwise_or.reduce([band.GetMaskBand().ReadAsArray() for band in bands])
        if (shown == 0).any():
            layers.append(np.where(shown, np.iinfo(layers[0].dtype).max, 0).astype(layers[0].dtype))
    return np.stack(layers) if len(layers) > 1 else layers[0]


def test_a_transform_of_arcgis_is_told(tmp_path):
    """GDAL takes none of its polynomials either."""
    cases = {case.name: case for case in corpus.beside_cases()}
    for kind, tells in (("PolynomialXform", True), ("IdentityXform", False)):
        name = cases["ArcGIS's " + kind].write(tmp_path)
        encoded = run("encode", name, "--lossless", "-f", "-o", tmp_path / "a.tks")
        assert encoded.returncode == 0
        assert ("polynomial" in encoded.stderr) == tells, encoded.stderr
