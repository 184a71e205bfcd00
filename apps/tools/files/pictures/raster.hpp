// SPDX-License-Identifier: Apache-2.0
// openRaster() and readSamples() read pictures by libspng (PNG), libtiff (TIFF), OpenJPEG (JPEG
// 2000) or OpenImageIO (some others), with the samples exactly as stored: no gamma, no colour
// profile, no multiplication by alpha.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"
#include "apps/tools/files/pictures/band_colours.hpp"
#include "apps/tools/files/pictures/picture_formats.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// An open picture file. Keep it until the samples are read.
struct Raster {
  InputFile file;
  std::string name;                       ///< for messages
  std::unique_ptr<PictureReader> reader;  ///< null where the samples are `decoded` already
  PictureShape shape;                     ///< what reading gives
  int stored_bits = 0;                    ///< of one sample in the file; 0: as shape.sample
  bool as_stored = false;  ///< reading leaves fewer bits than the type has as they are
  bool stretched = false;  ///< to the whole range of the type by reading
  bool palette = false;    ///< expanded to RGB by reading, unless `map` does it
  std::vector<std::array<uint8_t, 3>> map{};  ///< what colour each sample stands for
  bool cmyk = false;                          ///< four inks, or converted to RGB by reading
  bool inks = false;                          ///< the channels of a TIFF begin with four of them
  bool white_is_zero = false;                 ///< samples are as stored all the same
  bool fourth_reserved = false;               ///< the fourth channel is none
  bool further_pages = false;                 ///< pages or frames that are not read
  bool mask = false;                  ///< a TIFF's mask page, which is not applied by reading
  std::string nodata{};               ///< a TIFF's nodata value as it is written; "": none
  std::vector<BandColour> colours{};  ///< of each channel of a TIFF that reading leaves as it is
  bool sparse = false;                ///< parts of a TIFF are missing: nodata value, or 0
  bool empty = false;                 ///< all are
  bool profile = false;               ///< an ICC profile that is not applied
  Temporary geo_box{};                ///< JPEG 2000: a TIFF with the tags of a GeoTIFF
  bool unread_place = false;          ///< JPEG 2000: a place in GML alone, or damaged tags
  int orientation = 1;                ///< as TIFF counts; not applied by reading
  /// Colours come multiplied by alpha: as the file says, or because OpenImageIO does it.
  enum class Alpha { kPlain, kAssociated, kMultiplied } alpha = Alpha::kPlain;
  std::vector<std::byte> decoded{};  ///< samples of a PNG or of a PNM of 16 bits
  bool is_tiff() const { return reader && reader->format() == "tiff"; }
  /// Of a TIFF with tags that may tell the place; "": there is none.
  std::string tagged() const { return is_tiff() ? file.path() : geo_box.path().string(); }
};

/// Opens the file (or standard input for "-") by its content, whatever it is called. TKS_USAGE for
/// more than so many rows or columns.
Result<Raster> openRaster(const std::string& path, uint64_t most_side);

/// Hands over all samples, converted to `type`, interleaved. Call once. What is decoded already,
/// or by libtiff, has its own type only.
Result<std::vector<std::byte>> readSamples(Raster& raster, PictureSample type);

/// Of its samples.
PictureShape shapeOf(const ImageFile& image);

/// A message of OpenImageIO, cut to its first line and without the full stop.
std::string firstLine(std::string message);

/// The file content that `format` ("tiff", "openexr", "webp") gives to the picture.
Result<std::vector<std::byte>> encodeRaster(const std::string& format,
                                            const PictureToWrite& picture);

}  // namespace tetrakis::tools
