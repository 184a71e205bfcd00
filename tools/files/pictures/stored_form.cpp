// SPDX-License-Identifier: Apache-2.0
// How picture files store their samples, format by format.
#include "tools/files/pictures/stored_form.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "tools/files/pictures/exif.hpp"
#include "tools/files/pictures/geo_box.hpp"
#include "tools/files/pictures/jpeg.hpp"
#include "tools/files/pictures/pnm.hpp"
#include "tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

Status noteTiff(Raster& raster) {
  constexpr const char* kPhotometric = "tiff:PhotometricInterpretation";
  constexpr int kCieLab = 8, kIccLab = 9, kItuLab = 10;
  raster.stored_bits = raster.reader->number("oiio:BitsPerSample");
  const auto form = tiffForm(raster.file.path());
  if (!form.ok()) return form.status();
  raster.sparse = form->sparse;
  // OpenImageIO cannot read those.
  if (!form->whole || (form->sparse && !raster.plain))
    return {TKS_IO, "cannot read " + raster.name + ": a part of its samples is missing"};
  // OpenImageIO takes a missing BitsPerSample for 8, where TIFF means 1, and reads past the rows.
  if (!form->states_bits)
    return {TKS_USAGE, raster.name + " does not state its bits per sample: convert it to 8 bits"};
  raster.white_is_zero =
      raster.reader->has(kPhotometric) && raster.reader->number(kPhotometric) == 0;
  // OpenImageIO inverts these up to 8 bits, alpha too.
  if (raster.white_is_zero && raster.shape.channels > 1)
    return {TKS_USAGE, raster.name + " stores white as 0: convert it to black as 0"};
  // OpenImageIO hands these over as if they were RGB.
  const int photometric = raster.reader->number(kPhotometric);
  if (photometric == kCieLab || photometric == kIccLab || photometric == kItuLab)
    return {TKS_USAGE, raster.name + " stores its colours as L*a*b*: convert it to RGB"};
  raster.further_pages = form->further_pages;
  raster.mask = form->mask;
  raster.nodata = form->nodata;
  if (form->associated_alpha) raster.alpha = Raster::Alpha::kAssociated;
  const std::string colours = raster.reader->text("tiff:ColorSpace");
  raster.palette = colours == "palette";
  raster.cmyk = colours == "CMYK";
  if (!raster.palette && !raster.cmyk) raster.colours = form->colours;
  return {};
}

Status noteJpeg(Raster& raster) {
  const std::string colours = raster.reader->text("jpeg:ColorSpace");
  raster.cmyk = colours == "CMYK" || colours == "YCbCrK";
  const auto bytes = readBytes(raster.file.path());
  if (!bytes.ok()) return bytes.status();
  return checkJpeg(*bytes, raster.name);
}

/// Tags that no TIFF reader opens are none.
Status keepGeoBox(std::span<const std::byte> bytes, Raster& raster) {
  const GeoBox box = geoBoxOf(bytes);
  raster.unread_place = box.gml || !box.tiff.empty();
  if (box.tiff.empty()) return {};
  auto file = Temporary::makeFile();
  if (!file.ok()) return file.status();
  const Status written = writeBytes(file->path(), box.tiff);
  if (!written.ok()) return written;
  if (!TiffFile::open(file->path(), "r").ok()) return {};
  raster.geo_box = std::move(*file);
  raster.unread_place = false;
  return {};
}

/// OpenImageIO hands signed samples over shifted, and others than 8 and 16 bits rescaled. SIZ
/// marker segment (ITU-T T.800, A.5.1): 38 bytes behind its length, for each component bits - 1,
/// and 128 if signed.
Status noteJpeg2000(Raster& raster) {
  const auto bytes = readBytes(raster.file.path());
  if (!bytes.ok()) return bytes.status();
  constexpr std::array<std::byte, 4> kStart{std::byte{0xFF}, std::byte{0x4F}, std::byte{0xFF},
                                            std::byte{0x51}};
  constexpr ptrdiff_t kFirstComponent = 42;
  const auto start = std::search(bytes->begin(), bytes->end(), kStart.begin(), kStart.end());
  if (bytes->end() - start <= kFirstComponent)
    return {TKS_IO, "cannot read " + raster.name + ": it ends early or is damaged"};
  const auto depth = static_cast<unsigned>(start[kFirstComponent]);
  if (depth & 128U) {
    return {TKS_USAGE, raster.name +
                           " holds signed JPEG 2000 samples, which reading would shift: "
                           "convert it to TIFF"};
  }
  raster.stored_bits = static_cast<int>(depth) + 1;
  return keepGeoBox(*bytes, raster);
}

/// Greymaps say which value is white, and OpenImageIO stretches the others to that.
Status notePnm(Raster& raster) {
  constexpr uint64_t kWhite8 = 255, kWhite16 = 65535;
  const auto bytes = readBytes(raster.file.path());
  if (!bytes.ok()) return bytes.status();
  const auto header = readPnmHeader(*bytes);
  if (!header) return {};
  raster.stretched = header->white != kWhite8 && header->white != kWhite16;
  if (header->white != kWhite16) return {};
  auto samples = readWidePnm(*bytes, *header, raster.shape.samples(), raster.name);
  if (!samples.ok()) return samples.status();
  raster.decoded = std::move(*samples);
  raster.reader = nullptr;
  return {};
}

/// OpenImageIO states the bits of palette files alone, and reads those of greys as grey.
void noteBmp(Raster& raster) {
  const int bits = raster.reader->number("bmp:bitsperpixel");
  raster.palette = bits > 0 && bits <= 8 && raster.shape.channels > 1;
}

Status noteWebp(Raster& raster) {
  const auto bytes = readBytes(raster.file.path());
  if (!bytes.ok()) return bytes.status();
  raster.profile = !webpChunk(*bytes, "ICCP").empty();
  raster.orientation = exifOrientation(webpChunk(*bytes, "EXIF"));
  raster.further_pages = !webpChunk(*bytes, "ANIM").empty();
  if (raster.shape.channels == 4) raster.alpha = Raster::Alpha::kMultiplied;
  return {};
}

}  // namespace

Status noteStoredForm(Raster& raster) {
  const std::string format = raster.reader->format();
  // OpenImageIO can turn images, but its 2.4 takes orientation 5 for 7.
  const int orientation = raster.reader->number("Orientation");
  raster.orientation = orientation >= 1 && orientation <= 8 ? orientation : 1;
  raster.profile = raster.reader->has("ICCProfile");
  if (format == "tiff") return noteTiff(raster);
  if (format == "jpeg") return noteJpeg(raster);
  if (format == "jpeg2000") return noteJpeg2000(raster);
  if (format == "webp") return noteWebp(raster);
  // OpenImageIO 2.4 reads each row of these from where the next one lies.
  if (format == "fits") {
    return {TKS_USAGE, raster.name +
                           " is a FITS file, which is not read exactly: convert it to "
                           "TIFF (gdal_translate)"};
  }
  raster.stored_bits = raster.reader->number("oiio:BitsPerSample");
  if (format == "pnm") return notePnm(raster);
  if (format == "gif" || format == "ico") {
    const auto formats = pictureFormats();
    raster.further_pages = formats.ok() && (*formats)->hasSecond(raster.file.path());
    raster.palette = format == "gif";
  }
  if (format == "bmp") noteBmp(raster);
  return {};
}

}  // namespace tetrakis::tools
