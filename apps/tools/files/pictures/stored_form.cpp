// SPDX-License-Identifier: Apache-2.0
// How picture files store their samples, format by format.
#include "apps/tools/files/pictures/stored_form.hpp"

#include <span>
#include <string>
#include <utility>

#include "apps/tools/files/pictures/exif.hpp"
#include "apps/tools/files/pictures/geo_box.hpp"
#include "apps/tools/files/pictures/jpeg.hpp"
#include "apps/tools/files/pictures/pnm.hpp"
#include "apps/tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

Status noteTiff(Raster& raster) {
  const auto form = tiffForm(raster.file.path());
  if (!form.ok()) return form.status();
  if (!form->whole)
    return {TKS_IO, "cannot read " + raster.name + ": a part of its samples is missing"};
  raster.stored_bits = form->bits;
  raster.as_stored = true;
  raster.sparse = form->sparse;
  raster.empty = form->empty;
  raster.white_is_zero = form->white_is_zero;
  raster.further_pages = form->further_pages;
  raster.mask = form->mask;
  raster.nodata = form->nodata;
  if (form->associated_alpha) raster.alpha = Raster::Alpha::kAssociated;
  raster.palette = form->palette;
  raster.map = form->map;
  raster.inks = form->inks;
  raster.cmyk = form->inks && raster.shape.channels == 4;
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
Status keepGeoBox(Raster& raster) {
  const auto bytes = readBytes(raster.file.path());
  if (!bytes.ok()) return bytes.status();
  const GeoBox box = geoBoxOf(*bytes);
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
  if (format == "jpeg2000") return keepGeoBox(raster);
  if (format == "webp") return noteWebp(raster);
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
