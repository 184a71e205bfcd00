// SPDX-License-Identifier: Apache-2.0
// Pictures by libspng (PNG), libtiff (plain TIFFs) or OpenImageIO (all others), with the samples
// exactly as stored: no gamma, no colour profile, no multiplication by alpha.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "tools/files/file_bytes.hpp"
#include "tools/files/files.hpp"
#include "tools/files/pictures/band_colours.hpp"
#include "tools/files/pictures/picture_formats.hpp"

namespace tetrakis::tools {

/// An open picture file. Keep it until the samples are read.
struct Raster {
  InputFile file;
  std::string name;                       ///< for messages
  std::unique_ptr<PictureReader> reader;  ///< null where the samples are `decoded` already
  PictureShape shape;                     ///< what reading gives
  bool plain = false;                     ///< a TIFF that libtiff reads alone
  int stored_bits = 0;                    ///< of one sample in the file; 0: as shape.sample
  bool palette = false;                   ///< expanded to RGB by reading
  bool cmyk = false;                      ///< converted to RGB by reading
  bool stretched = false;                 ///< to the whole range of the type by reading
  bool white_is_zero = false;             ///< inverted by reading if it has 8 bits or fewer
  bool further_pages = false;             ///< pages or frames that are not read
  bool mask = false;                      ///< a TIFF's mask page, which is not applied by reading
  std::string nodata{};                   ///< a TIFF's nodata value as it is written; "": none
  std::vector<BandColour> colours{};  ///< of each channel of a TIFF that reading leaves as it is
  bool sparse = false;                ///< parts of a TIFF are missing, which reading leaves at 0
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

/// Opens the file (or standard input for "-") by its content, whatever it is called.
Result<Raster> openRaster(const std::string& path);

/// Hands over all samples, converted to `type`, interleaved. Call once. What is decoded already
/// has its own type only.
Result<std::vector<std::byte>> readSamples(Raster& raster, PictureSample type);

/// Of its samples.
PictureShape shapeOf(const ImageFile& image);

/// A message of OpenImageIO, cut to its first line and without the full stop.
std::string firstLine(std::string message);

/// The file content that `format` ("tiff", "openexr", "webp") gives to the picture.
Result<std::vector<std::byte>> encodeRaster(const std::string& format,
                                            const PictureToWrite& picture);

}  // namespace tetrakis::tools
