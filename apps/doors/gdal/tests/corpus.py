# SPDX-License-Identifier: Apache-2.0
"""Files of all kinds that GDAL writes, made here: sample types, nodata values, masks, layouts,
compressions, keys of GeoTIFF 1.0 and 1.1, units, MinIsWhite, files beside. Each case has a name and
a function that writes it into a folder."""

import struct
from dataclasses import dataclass
from typing import Any, Callable

import numpy as np
from conftest import RGB, gdal, gdal_type, osr, system

DOUBLE = np.finfo(np.float64)
LOWEST = float(np.finfo(np.float32).min)
UTM = "EPSG:32633"
GROUND = (500000, 10, 0, 5000000, 0, -10)


@dataclass
class Case:
    name: str
    write: Callable[[Any], str]  # takes a folder, gives the name of the file

    def __str__(self):
        return self.name


def hills(dtype, rows=12, columns=16):
    """A few values, 0 among them, and in floats a negative 0."""
    y, x = np.mgrid[0:rows, 0:columns]
    heights = np.round(50 + 45 * np.sin(x / 5) * np.cos(y / 4))
    heights[0, 4:8] = 0
    heights = heights.astype(dtype)
    if heights.dtype.kind == "f":
        heights[0, 5] = -0.0
    return heights


@dataclass
class Raster:
    """What one GeoTIFF holds and says."""

    layers: np.ndarray
    options: tuple = ()
    crs: Any = UTM
    transform: Any = GROUND
    nodata: Any = None
    mask: Any = None  # rows x columns, or one for each band
    mask_inside: bool = True
    colours: Any = None
    area_or_point: Any = None
    band: Any = ()  # what the first band is told: (method of GDAL, value) each

    def write(self, folder):
        name = str(folder / "a.tif")
        gdal.SetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES" if self.mask_inside else "NO")
        layers = self.layers[None] if self.layers.ndim == 2 else self.layers
        signed = layers.dtype == np.int8 and not hasattr(gdal, "GDT_Int8")
        options = [*self.options, *(["PIXELTYPE=SIGNEDBYTE"] if signed else [])]
        shape = layers.shape
        dataset = gdal.GetDriverByName("GTiff").Create(
            name, shape[2], shape[1], shape[0], gdal_type(layers.dtype), options
        )
        self._describe(dataset)
        for number, layer in enumerate(layers, 1):
            band = dataset.GetRasterBand(number)
            if self.nodata is not None:
                band.SetNoDataValue(self.nodata)
            band.WriteArray(layer.view(np.uint8) if signed else layer)
        if self.mask is not None:
            self._write_mask(dataset)
        del dataset
        gdal.SetConfigOption("GDAL_TIFF_INTERNAL_MASK", None)
        return name

    def _describe(self, dataset):
        if self.crs is not None:
            crs = self.crs if isinstance(self.crs, osr.SpatialReference) else system(self.crs)
            dataset.SetSpatialRef(crs)
        if self.transform is not None:
            dataset.SetGeoTransform(self.transform)
        if self.area_or_point is not None:
            dataset.SetMetadataItem("AREA_OR_POINT", self.area_or_point)
        for number, colour in enumerate(self.colours or (), 1):
            dataset.GetRasterBand(number).SetColorInterpretation(colour)
        for method, value in self.band:
            getattr(dataset.GetRasterBand(1), method)(value)

    def _write_mask(self, dataset):
        masks = np.asarray(self.mask)
        if masks.ndim == 2:
            dataset.CreateMaskBand(gdal.GMF_PER_DATASET)
            dataset.GetRasterBand(1).GetMaskBand().WriteArray(masks)
            return
        for number, mask in enumerate(masks, 1):
            band = dataset.GetRasterBand(number)
            band.CreateMaskBand(0)
            band.GetMaskBand().WriteArray(mask)


def case(name, layers, **facts):
    return Case(name, Raster(layers, **facts).write)


def hole(shape, first=0):
    mask = np.full(shape, 255, np.uint8)
    mask[3:6, 2 + first : 9 + first] = 0
    return mask


NODATA = {
    "-9999": -9999, "0": 0, "-0": -0.0, "1.5": 1.5, "255": 255, "70000": 70000, "-32768": -32768,
    "nan": np.nan, "inf": np.inf, "-inf": -np.inf, "0.1": 0.1, "1e-42": 1e-42, "tiny": DOUBLE.tiny,
    "lowest": LOWEST, "-DBL_MAX": DOUBLE.min, "DBL_MAX": DOUBLE.max,
}  # fmt: skip


def with_voids(dtype, nodata):
    """Some samples have the nodata value, if the type can hold it."""
    heights = hills(dtype)
    with np.errstate(all="ignore"):
        value = np.float64(nodata).astype(heights.dtype)
    same = np.float64(value) == nodata or (np.isnan(nodata) and heights.dtype.kind == "f")
    if same or heights.dtype.kind == "f":
        heights[5, 3:9] = value
    return heights


def nodata_cases():
    some = ["-9999", "0", "255"]
    many = [*some, "-0", "1.5", "70000", "nan", "-inf", "tiny", "-DBL_MAX"]
    kinds = {"f4": NODATA, "f8": NODATA, "u1": many, "i2": many, **dict.fromkeys(
        ("i1", "u2", "u4", "i4"), some)}
    for dtype, names in kinds.items():
        for name in names:
            nodata = NODATA[name]
            yield case(f"{dtype} nodata {name}", with_voids(dtype, nodata), nodata=nodata)


def fill_cases():
    """Samples that look like voids and are not declared, or not as such."""
    for dtype in ("i2", "f4", "f8"):
        for value in (-9999, -32768):
            heights = hills(dtype)
            heights[5, 3:9] = value
            yield case(f"{dtype} of {value}", heights)
            yield case(f"{dtype} of {value} beside -32767", heights, nodata=-32767)
    heights = hills("f4")
    heights[5, 3:9] = LOWEST
    yield case("floats of the lowest beside -9999", heights, nodata=-9999)
    heights = hills("u2")
    heights[5, 3:9] = 65535
    yield case("u2 of 65535", heights)


def mask_cases():
    facts = dict(mask=hole((12, 16)))
    for dtype in ("u1", "i2", "f4", "f8"):
        yield case(f"{dtype} masked inside", hills(dtype), **facts)
        yield case(f"{dtype} masked beside", hills(dtype), mask_inside=False, **facts)
        yield case(f"{dtype} masked inside, nodata", hills(dtype), nodata=7, **facts)
    wild = hills("f8")
    wild[4, 3:6] = (1e300, np.inf, 0.1)
    yield case("f8 masked where no float is", wild, mask=hole(wild.shape))


def layout_cases():
    layouts = [
        ("COMPRESS=LZW", "PREDICTOR=2"), ("COMPRESS=DEFLATE", "TILED=YES", "BLOCKXSIZE=16",
        "BLOCKYSIZE=16"), ("COMPRESS=PACKBITS",), ("COMPRESS=ZSTD",), ("COMPRESS=LERC",),
        ("BIGTIFF=YES",), ("ENDIANNESS=BIG",), ("BLOCKYSIZE=5",),
    ]  # fmt: skip
    for number, options in enumerate(layouts):
        dtype = ("i2", "f4")[number % 2]
        yield case(f"{dtype} " + " ".join(options), hills(dtype), options=options)
    for dtype in ("u1", "u2", "i2", "u4", "i4", "f4", "f8"):
        yield case(f"{dtype} white as 0", hills(dtype), options=("PHOTOMETRIC=MINISWHITE",))


LAMBERT = "+proj=lcc +lat_1=44 +lat_2=49 +lat_0=46.5 +lon_0=3 +x_0=7e5 +y_0=6.6e6 +ellps=GRS80"
SYSTEMS = [
    "EPSG:32633", "EPSG:4326", "EPSG:4807", "EPSG:27572", "EPSG:2263", "EPSG:4979", "EPSG:4937",
    "EPSG:32633+5773", "EPSG:4326+5773", "EPSG:2225+8228", "EPSG:26910+6360", "EPSG:6893",
    "EPSG:7415", "EPSG:3857", "EPSG:3413", "ESRI:102003", LAMBERT,
    "+proj=utm +zone=33 +datum=WGS84 +units=us-ft",
]  # fmt: skip


def transform_of(crs):
    return (5, 0.001, 0, 50, 0, -0.001) if system(crs).IsGeographic() else (5e5, 10, 0, 5e6, 0, -10)


def of_revision(minor, crs, **facts):
    """Keys of one revision of GeoTIFF under the number of the other."""

    def write(folder):
        name = Raster(hills("i2"), crs=crs, transform=transform_of(crs), **facts).write(folder)
        with open(name, "r+b") as file:
            data = file.read()
            # Head of the directory, behind which comes GTModelTypeGeoKey.
            at = data.find(struct.pack("<3H", 1, 1, 1 - minor))
            while at >= 0 and data[at + 8 : at + 10] != struct.pack("<H", 1024):
                at = data.find(struct.pack("<3H", 1, 1, 1 - minor), at + 1)
            assert at >= 0
            file.seek(at)
            file.write(struct.pack("<3H", 1, 1, minor))
        return name

    return write


def system_cases():
    for crs in SYSTEMS:
        for version, minor in (("1.0", 0), ("1.1", 1)):
            options = ("GEOTIFF_VERSION=" + version,)
            deep = system(crs).GetAxesCount() > 2
            # GDAL 3.6 reads keys of 1.0 of this as two axes with the code of three.
            odd = crs == "EPSG:4937"
            if minor == 1 or (deep and not odd):
                yield case(f"{crs} {version}", hills("i2"), crs=crs, transform=transform_of(crs),
                           options=options)
            if deep and "+" in crs:
                yield Case(f"{crs} {version} said of the other",
                           of_revision(1 - minor, crs, options=options))
    yield case("no CRS", hills("i2"), crs=None)
    yield case("no place", hills("i2"), crs=None, transform=None)


def fact_cases():
    for transform in ((100.25, 3, 8, 900, 4, -6), (5, -2, 0, 5, 0, 3), (5e5, 7, 0, 5e6, 0, 9)):
        for kind in ("Area", "Point"):
            yield case(f"{kind} {transform}", hills("i2"), transform=transform, area_or_point=kind)
    scaled = [("SetScale", 0.1), ("SetOffset", -100.5)]
    yield case("scale and offset", hills("u2"), band=scaled)
    for unit in ("m", "metre", "ft", "US survey foot", "fathom", "K", "m²"):
        yield case(f"unit {unit}", hills("i2"), band=[("SetUnitType", unit)])
    yield case("unit before that of the CRS", hills("i2"), crs="EPSG:32633+5773",
               band=[("SetUnitType", "ft")])
    yield case("description", hills("i2"), band=[("SetDescription", "Höhen <1>")])


ARCGIS = """<PAMDataset><Metadata domain="xml:ESRI" format="xml"><GeodataXform
xsi:type="typens:{kind}" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
xmlns:typens="http://www.esri.com/schemas/ArcGIS/3.1.0">{more}<SpatialReference
xsi:type="typens:ProjectedCoordinateSystem"><WKT>{wkt}</WKT></SpatialReference></GeodataXform>
</Metadata></PAMDataset>"""
POLYNOMIAL = (
    "<PolynomialOrder>1</PolynomialOrder><CoeffX><Double>500000</Double><Double>10</Double>"
    "<Double>0</Double></CoeffX><CoeffY><Double>5000000</Double><Double>0</Double>"
    "<Double>10</Double></CoeffY>"
)


def beside_cases():
    def beside(text, **facts):
        def write(folder):
            name = Raster(hills("i2"), **facts).write(folder)
            (folder / "a.tif.aux.xml").write_text(text, encoding="utf-8")
            return name

        return write

    esri = system(UTM).ExportToWkt(["FORMAT=WKT1_ESRI"])
    bare = dict(crs=None, transform=None)
    for kind, more in (("PolynomialXform", POLYNOMIAL), ("IdentityXform", "")):
        text = ARCGIS.format(kind=kind, more=more, wkt=esri)
        yield Case(f"ArcGIS's {kind}", beside(text, **bare))
        yield Case(f"ArcGIS's {kind} over a place", beside(text, crs="EPSG:3857"))
    band = '<PAMDataset><PAMRasterBand band="1">{}</PAMRasterBand></PAMDataset>'
    nodata = band.format("<NoDataValue>0</NoDataValue>")
    yield Case("nodata beside", beside(nodata, nodata=-9999))
    yield Case("unit beside", beside(band.format("<UnitType>ft</UnitType>")))


def height_cases():
    for cases in (nodata_cases, fill_cases, mask_cases, layout_cases, system_cases, fact_cases,
                  beside_cases):
        yield from cases()


def layers_of(bands, dtype):
    layers = [hills(dtype) + number for number in range(bands)]
    return np.stack(layers).astype(dtype)


COLOURS = {
    1: (gdal.GCI_GrayIndex,),
    2: (gdal.GCI_GrayIndex, gdal.GCI_AlphaBand),
    3: RGB,
    4: (*RGB, gdal.GCI_AlphaBand),
}


def texture_cases():
    layouts = [(), ("INTERLEAVE=BAND",), ("COMPRESS=DEFLATE", "PREDICTOR=2"),
               ("TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=LZW"),
               ("INTERLEAVE=BAND", "COMPRESS=ZSTD")]  # fmt: skip
    for bands, colours in COLOURS.items():
        for dtype in ("u1", "u2"):
            facts = dict(colours=colours)
            for layout in layouts if dtype == "u1" else layouts[:2]:
                options = layout
                name = " ".join([f"{bands} {dtype}", *layout])
                if bands % 2 == 0:
                    options = (*options, "ALPHA=YES")
                yield case(name, layers_of(bands, dtype), options=options, **facts)
    bgr = tuple(reversed(RGB))
    yield case("BGR", layers_of(3, "u1"), colours=bgr)
    infrared = (*RGB, gdal.GCI_Undefined)
    yield case("near infrared", layers_of(4, "u1"), colours=infrared, options=("ALPHA=NO",))
    yield from texture_void_cases()


def texture_void_cases():
    shape = (12, 16)
    for bands in (1, 3):
        for inside in (True, False):
            where = "inside" if inside else "beside"
            yield case(f"{bands} masked {where}", layers_of(bands, "u1"), colours=COLOURS[bands],
                       mask=hole(shape), mask_inside=inside)
        for nodata in (0, 300, -1, 1.5, np.nan):
            yield case(f"{bands} nodata {nodata}", layers_of(bands, "u1") // 2 * 2,
                       colours=COLOURS[bands], nodata=nodata)
    facts = dict(colours=RGB, mask_inside=False)
    yield case("masks of bands, alike", layers_of(3, "u1"), mask=[hole(shape)] * 3, **facts)
    yield case("masks of bands", layers_of(3, "u1"), mask=[hole(shape, i) for i in range(3)],
               **facts)
    yield case("masks of bands that hide nothing together", layers_of(3, "u2"),
               mask=[hole(shape, 0), hole(shape, 0), 255 - hole(shape, 0)], **facts)
    yield case("a mask that hides nothing", layers_of(3, "u1"), mask=np.full(shape, 255, np.uint8),
               colours=RGB)
    alpha = dict(colours=COLOURS[4], options=("ALPHA=YES",))
    yield case("a mask beside alpha", layers_of(4, "u1"), mask=hole(shape), mask_inside=False,
               **alpha)
    yield case("a mask beside near infrared", layers_of(4, "u1"), mask=hole(shape),
               colours=(*RGB, gdal.GCI_Undefined), options=("ALPHA=NO",))
    yield case("nodata beside alpha", layers_of(4, "u1"), nodata=0, **alpha)
