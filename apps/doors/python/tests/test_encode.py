# SPDX-License-Identifier: Apache-2.0
"""Arrays go in whatever their type and strides, and come back; what makes no sense is refused."""

import numpy as np
import pytest
from conftest import SAMPLES, photograph, terrain

import tetrakis


def back(stream, **options):
    with tetrakis.open(stream) as terrain:
        return terrain.heights(**options)


@pytest.mark.parametrize("dtype", SAMPLES)
@pytest.mark.parametrize("shape", [(2, 2), (2, 37), (31, 2), (40, 33)])
def test_heights_come_back(dtype, shape):
    heights = terrain(*shape, dtype)
    decoded = back(tetrakis.encode(heights))
    assert decoded.dtype == heights.dtype
    np.testing.assert_array_equal(decoded, heights)


@pytest.mark.parametrize("dtype", ["u1", "u2"])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_texels_come_back(dtype, channels):
    texture = photograph(33, 20, channels, dtype)
    with tetrakis.open(tetrakis.encode(texture=texture)) as stream:
        np.testing.assert_array_equal(stream.texture(), texture)
        assert stream.info.texture_shape == texture.shape
        assert stream.info.shape is None and stream.info.dtype is None


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
@pytest.mark.parametrize("alpha", [True, False])
def test_a_further_colour_is_no_alpha(channels, alpha):
    texture = photograph(33, 20, channels, "u1")
    stream = tetrakis.encode(texture=texture, texture_alpha=alpha)
    with tetrakis.open(stream) as opened:
        np.testing.assert_array_equal(opened.texture(), texture)
        assert opened.info.texture_alpha == (alpha and channels % 2 == 0)


def test_reflectances_have_a_white_level():
    texture = np.random.default_rng(3).integers(200, 3000, (20, 33, 3)).astype("u2")
    for given in (0, 1234, 65535):
        with tetrakis.open(tetrakis.encode(texture=texture, texture_white_level=given)) as stream:
            white = stream.info.texture_white_level
            assert white == given if given else 2000 < white < 3000
            np.testing.assert_array_equal(stream.texture(), texture)
    with tetrakis.open(tetrakis.encode(heights=np.zeros((3, 3), "f4"))) as stream:
        assert stream.info.texture_white_level is None


@pytest.mark.parametrize("dtype", SAMPLES)
def test_wild_bits_come_back(dtype):
    bits = np.random.default_rng(7).integers(0, 256, (9, 13, 4), np.uint8)
    heights = np.ascontiguousarray(bits[..., : np.dtype(dtype).itemsize]).view(dtype)[..., 0]
    if dtype == "f4":
        heights = np.where(np.isfinite(heights), heights, np.float32(-0.0))
    decoded = back(tetrakis.encode(heights))
    np.testing.assert_array_equal(decoded.view("u1"), np.ascontiguousarray(heights).view("u1"))


def test_any_strides_and_byte_order_give_the_same_stream(heights):
    stream = tetrakis.encode(heights)
    wide = np.zeros((heights.shape[0] * 2, heights.shape[1] * 3), "f4")
    wide[::2, ::3] = heights
    read_only = heights.copy()
    read_only.flags.writeable = False
    flipped = heights[::-1, ::-1].copy()[::-1, ::-1]
    variants = [wide[::2, ::3], np.asfortranarray(heights), flipped, read_only]
    variants += [heights.astype(">f4")]
    for variant in variants:
        assert tetrakis.encode(variant) == stream


def test_targets(heights):
    assert len(tetrakis.encode(heights, bytes=900)) <= 900
    bounded = back(tetrakis.encode(heights, max_error=0.5))
    assert np.abs(bounded - heights).max() <= 0.5
    close = back(tetrakis.encode(heights, psnr=50))
    rmse = np.sqrt(np.mean((close.astype("f8") - heights) ** 2))
    assert 20 * np.log10(np.ptp(heights) / rmse) >= 50
    assert tetrakis.encode(heights, lossless=True) == tetrakis.encode(heights)


def test_threads_do_not_change_the_bytes(heights, texture):
    options = dict(bytes=3000, regions=16)
    one = tetrakis.encode(heights, texture, **options)
    assert tetrakis.encode(heights, texture, threads=3, **options) == one


def test_nan_and_nodata_are_voids(heights):
    holed = heights.copy()
    holed[5:20, 30:40] = np.nan
    stream = tetrakis.encode(holed)
    np.testing.assert_array_equal(back(stream), holed)
    declared = back(tetrakis.encode(holed, nodata=-9999))
    np.testing.assert_array_equal(declared == -9999, np.isnan(holed))
    with tetrakis.open(stream) as opened:
        np.testing.assert_array_equal(opened.validity(), ~np.isnan(holed))
        np.testing.assert_array_equal(np.isnan(opened.surface()), np.isnan(holed))
        assert opened.info.has_voids and opened.info.nodata is None


@pytest.mark.parametrize("dtype", SAMPLES)
def test_masked_arrays_come_back(dtype):
    heights = np.ma.MaskedArray(terrain(dtype=dtype))
    heights[:, 40:] = np.ma.masked
    heights[3, 4] = np.ma.masked
    decoded = back(tetrakis.encode(heights), masked=True)
    assert decoded.dtype == heights.dtype
    np.testing.assert_array_equal(np.ma.getmaskarray(decoded), np.ma.getmaskarray(heights))
    np.testing.assert_array_equal(decoded.compressed(), heights.compressed())


@pytest.mark.parametrize("dtype", ["i2", "i4", "f4"])
def test_auto_declares_what_files_write_where_they_have_no_height(dtype):
    heights = (terrain(dtype="f4") % 1000).astype(dtype)
    hole = np.zeros(heights.shape, bool)
    hole[::5, ::3] = True
    heights[hole] = -9999
    for nodata, declared in (("auto", -9999), (None, None), (7, 7)):
        with tetrakis.open(tetrakis.encode(heights, nodata=nodata)) as stream:
            assert stream.info.nodata == declared
            np.testing.assert_array_equal(stream.heights(), heights)
    with tetrakis.open(tetrakis.encode(np.abs(heights) % 1000, nodata="auto")) as stream:
        assert stream.info.nodata is None
    with pytest.raises(tetrakis.TksUsageError, match="auto"):
        tetrakis.encode(heights, nodata="none")
    masked = np.ma.MaskedArray(heights.astype("i2"), mask=np.roll(hole, 1, axis=1))
    with tetrakis.open(tetrakis.encode(masked, nodata="auto")) as stream:
        assert stream.info.nodata != -9999  # a mask needs a value of its own
        np.testing.assert_array_equal(stream.heights(masked=True).mask, masked.mask)


def test_masked_integers_get_a_nodata_that_is_free():
    values = np.arange(256, dtype="u1").reshape(16, 16)
    full = np.ma.MaskedArray(np.vstack([values, values]), mask=False)
    full.mask[:16] = values == 77
    full.mask[16:] = values == 77
    stream = tetrakis.encode(full)
    with tetrakis.open(stream) as opened:
        assert opened.info.nodata == 77
        assert (opened.heights(masked=True).mask == full.mask).all()
    full.mask[:16] = False
    with pytest.raises(tetrakis.TksUsageError, match="wider type"):
        tetrakis.encode(full)
    with pytest.raises(tetrakis.TksUsageError, match="cannot become the nodata"):
        tetrakis.encode(full, nodata=-1)
    for no_integer in (float("nan"), float("inf"), 0.5):
        with pytest.raises(tetrakis.TksUsageError, match="cannot become the nodata"):
            tetrakis.encode(full, nodata=no_integer)
    assert tetrakis.encode(np.ma.MaskedArray(values)) == tetrakis.encode(values)


def test_place_comes_back(stream):
    with tetrakis.open(stream[:3000]) as opened:
        info = opened.info
        assert info.geotransform == (4e5, 10, 0, 3.8e6, 0, -10)
        assert (info.crs, info.unit, info.spacing) == ("EPSG:32611", "m", (10, 10))
        assert info.registration == "area"
        assert opened.describe(level=1).spacing == (20, 20)
    rotated = (5.0, 2.0, 1.0, 7.0, -1.0, 2.0)
    image = tetrakis.encode(
        texture=photograph(),
        texture_geotransform=rotated,
        texture_crs="my grid",
        texture_registration="point",
    )
    with tetrakis.open(image) as opened:
        assert opened.info.texture_geotransform == rotated
        assert opened.info.texture_crs == "my grid"
        assert opened.info.texture_registration == "point"


def test_codes_of_epsg_come_back_in_capitals(heights, texture):
    codes = dict(crs="epsg:32611+5773", vertical_datum="Epsg:5773", texture_crs="epsg:32612")
    with tetrakis.open(tetrakis.encode(heights, texture, psnr=30, **codes)) as stream:
        info = stream.info
        assert info.crs == "EPSG:32611+5773"
        assert info.vertical_datum == "EPSG:5773"
        assert info.texture_crs == "EPSG:32612"


def test_scale_and_text_come_back(heights):
    stream = tetrakis.encode(
        terrain(dtype="i2") // 2,
        scale=0.1,
        offset=5,
        unit="ft",
        vertical_datum="EPSG:5703",
        description="höhe",
        nodata=-32768,
        spacing=(2, 3),
    )
    with tetrakis.open(stream) as opened:
        info = opened.info
        assert (info.scale, info.offset, info.nodata) == (0.1, 5, -32768)
        assert (info.unit, info.vertical_datum, info.description) == ("ft", "EPSG:5703", "höhe")
        assert info.spacing == (2, 3)
        np.testing.assert_allclose(opened.surface(), opened.heights() * 0.1 + 5, rtol=1e-5)


class WithWkt:
    """As the CRSs of rasterio and pyproj are."""

    def to_wkt(self):
        return "LOCAL_CS[]"


REFUSED = [
    (dict(heights=np.zeros((4, 4), bool)), "bool"),
    (dict(heights=np.zeros((4, 4), "c8")), "complex64"),
    (dict(heights=np.zeros((4, 4), "M8[s]")), "datetime64"),
    (dict(heights=np.array([["a", "b"]])), "<U1"),
    (dict(heights=[[None, 1], [2, 3]]), "object"),
    (dict(heights=np.ma.masked_all((4, 4), bool)), "bool"),
    (dict(heights=np.float32(4)), r"of shape \(\)"),
    (dict(heights=np.zeros(4, "f4")), "rows, columns"),
    (dict(heights=np.zeros((2, 4, 4), "f4")), "rows, columns"),
    (dict(heights=np.zeros((0, 9), "f4")), "each side"),
    (dict(heights=np.full((4, 4), np.inf, "f4")), "infinite"),
    (dict(texture=np.zeros((4, 4), "f4")), "uint8, uint16"),
    (dict(texture=np.zeros((4, 4, 5), "u1")), "1 to 4 channels"),
    (dict(texture=np.ma.masked_all((4, 4, 3), "u1")), "alpha"),
    (dict(), "."),
    (dict(heights=np.zeros((4, 4), "f4"), bytes=1000, psnr=40), "bytes and psnr"),
    (dict(heights=np.zeros((4, 4), "f4"), lossless=True, psnr=40), "psnr and lossless"),
    (dict(heights=np.zeros((4, 4), "f4"), lossless=False), "not lossless"),
    (dict(heights=np.zeros((4, 4), "f4"), bytes=0), "greater than 0"),
    (dict(heights=np.zeros((4, 4), "f4"), bytes=-5), "between 0 and"),
    (dict(heights=np.zeros((4, 4), "f4"), bytes="64k"), "integer"),
    (dict(heights=np.zeros((4, 4), "f4"), psnr="high"), "number"),
    (dict(heights=np.zeros((4, 4), "f4"), psnr=-3), "."),
    (dict(heights=np.zeros((4, 4), "f4"), max_error=float("nan")), "."),
    (dict(heights=np.zeros((4, 4), "f4"), triangles=2**32), "between 0 and"),
    (dict(heights=np.zeros((4, 4), "f4"), regions=33), "."),
    (dict(heights=np.zeros((4, 4), "f4"), unit="a\0b"), "NUL"),
    (dict(heights=np.zeros((4, 4), "f4"), unit="\ud800"), "Unicode"),
    (dict(heights=np.zeros((4, 4), "f4"), crs=32611), r'"EPSG:32611" or WKT, not 32611 .*to_wkt'),
    (dict(texture=np.zeros((4, 4), "u1"), texture_crs=WithWkt()), r"texture_crs .*to_wkt\(\)"),
    (dict(heights=np.zeros((4, 4), "f4"), crs="EPSG:Mercator"), "no code of EPSG"),
    (dict(texture=np.zeros((4, 4), "u1"), texture_crs="epsg:"), "no code of EPSG"),
    (dict(heights=np.zeros((4, 4), "f4"), index="tiles"), "one of"),
    (dict(heights=np.zeros((4, 4), "f4"), index="windows", bytes=900), "lossless"),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=(1, 2)), "6 numbers"),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=(1, 2, 3, 4, 5, 1e200)), "."),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=5), "takes 6 numbers"),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=(0, 0, 0, 0, 0, 0)), "one point"),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=(4e5, 0, 0, 3.8e6, 0, -10)), "one line"),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=(0, 0.1, 0.2, 0, 0.3, 0.6)), "one line"),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=(0, 1e-200, 0, 0, 1e-200, 0)), "one line"),
    (dict(texture=np.zeros((4, 4), "u1"), texture_geotransform=[0] * 6), "one line or one point"),
    (dict(heights=np.zeros((4, 4), "f4"), geotransform=(0, np.nan, 0, 0, 0, 1)), "six numbers"),
    (dict(heights=np.zeros((4, 4), "f4"), spacing=(1, 2, 3)), "one number or two"),
    (dict(heights=np.zeros((4, 4), "f4"), spacing=[[1], [2, 3]]), "spacing must be a number"),
    (dict(heights=np.zeros((4, 4), "f4"), spacing=(None, 3)), "spacing must be a number"),
    (dict(heights=np.zeros((4, 4), "f4"), registration="pixel"), "one of"),
    (dict(heights=np.zeros((4, 4), "f4"), registration=np.array(["area", "point"])), "one of"),
    (dict(heights=np.zeros((4, 4), "f4"), weights="none"), "one of"),
    (dict(heights=np.zeros((4, 4), "f4"), nodata="x"), "number"),
    (dict(heights=np.zeros((4, 4), "f4"), nodata=10**400), "number, not 1000"),
    (dict(heights=np.zeros((4, 4), "f4"), psnr="40"), "number, not '40'"),
    (dict(heights=np.zeros((4, 4), "f4"), step=np.ones(2)), "step must be a number"),
    (dict(heights=np.zeros((4, 4), "f4"), bytes=10**5000), "a value of type int"),
    (dict(heights=np.zeros((4, 4), "f4"), progress=5), "progress must be a function"),
    (dict(heights=[[1, 2], [3]]), "Heights must be an array"),
    (dict(texture=np.zeros((4, 4, 2), "u1"), texture_alpha=np.ones(2)), "texture_alpha must be"),
    (dict(texture=np.zeros((4, 4), "u1"), texture_white_level=9), "white level"),
    (dict(texture=np.zeros((4, 4), "u2"), texture_white_level=-1), "texture_white_level"),
]


@pytest.mark.parametrize("arguments, words", REFUSED)
def test_what_makes_no_sense_is_refused(arguments, words):
    with pytest.raises(tetrakis.TksUsageError, match=words) as raised:
        tetrakis.encode(**arguments)
    assert raised.value.code == tetrakis.Status.USAGE
    assert isinstance(raised.value, ValueError) and str(raised.value).endswith((".", ")."))


def test_progress_reports_and_raises(heights):
    seen = []
    tetrakis.encode(heights, bytes=2000, progress=seen.append)
    assert seen and seen == sorted(seen) and 0 <= seen[0] and seen[-1] <= 1

    def interrupted(_done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        tetrakis.encode(heights, bytes=2000, progress=interrupted)


def test_latitudes_put_the_ground_first():
    globe = terrain(128, 256)
    area = np.cos(np.radians(90 - (np.arange(128) + 0.5) * 180 / 128))[:, np.newaxis]

    def squares(**place):
        stream = tetrakis.encode(globe, bytes=3000, **place)
        with tetrakis.open(stream) as opened:
            return (area * (opened.heights() - globe.astype("f8")) ** 2).sum()

    assert squares(latitudes=(90, -90)) < squares()
    assert squares(latitudes=(5, -5)) == squares()
    for refused in (90, (90,), (200, -90), ("north", "south")):
        with pytest.raises(tetrakis.TksUsageError):
            tetrakis.encode(globe, latitudes=refused)


def test_columns_that_go_round(heights, texture):
    stream = tetrakis.encode(heights, texture, lossless=True, domain="cylinder")
    with tetrakis.open(stream) as opened:
        assert (opened.info.domain, opened.info.texture_domain) == ("cylinder", "cylinder")
        np.testing.assert_array_equal(opened.heights(), heights)
        np.testing.assert_array_equal(opened.texture(), texture)
    apart = tetrakis.encode(heights, texture, domain="cylinder", texture_domain="plane")
    with tetrakis.open(apart) as opened:
        assert (opened.info.domain, opened.info.texture_domain) == ("cylinder", "plane")
    with pytest.raises(tetrakis.TksUsageError):
        tetrakis.encode(heights, domain="sphere")
