// SPDX-License-Identifier: Apache-2.0
// The functions here read and write the tags of TIFF files that OpenImageIO does not handle: those
// of GeoTIFF and GDAL (OGC GeoTIFF 1.1, 19-008r4; GDAL's GTiff driver).
#pragma once

#include <tiffio.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/pictures/band_colours.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

inline constexpr uint32_t kModelPixelScaleTag = 33550;
inline constexpr uint32_t kModelTiepointTag = 33922;
inline constexpr uint32_t kModelTransformationTag = 34264;
inline constexpr uint32_t kGeoKeyDirectoryTag = 34735;
inline constexpr uint32_t kGeoDoubleParamsTag = 34736;
inline constexpr uint32_t kGeoAsciiParamsTag = 34737;
inline constexpr uint32_t kGdalMetadataTag = 42112;
inline constexpr uint32_t kGdalNodataTag = 42113;

enum GeoKey : uint16_t {
  kGtModelTypeGeoKey = 1024,
  kGtRasterTypeGeoKey = 1025,
  kGtCitationGeoKey = 1026,
  kGeodeticCrsGeoKey = 2048,
  kGeodeticCitationGeoKey = 2049,
  kGeogAngularUnitsGeoKey = 2054,
  kGeogAngularUnitSizeGeoKey = 2055,
  kGeogSemiMajorAxisGeoKey = 2057,
  kGeogSemiMinorAxisGeoKey = 2058,
  kGeogInvFlatteningGeoKey = 2059,
  kProjectedCrsGeoKey = 3072,
  kProjectedCitationGeoKey = 3073,
  kProjLinearUnitsGeoKey = 3076,
  kProjLinearUnitSizeGeoKey = 3077,
  kVerticalGeoKey = 4096,
  kVerticalCitationGeoKey = 4097,
  kVerticalDatumGeoKey = 4098,
  kVerticalUnitsGeoKey = 4099,
};
inline constexpr uint16_t kModelTypeProjected = 1, kModelTypeGeographic = 2,
                          kModelTypeGeocentric = 3;
inline constexpr uint16_t kUserDefined = 32767;

/// EPSG units of measure, our name for them, and their length.
struct LengthUnit {
  uint16_t code;
  const char* name;
  double metres;
};
inline constexpr std::array kLengthUnits{LengthUnit{9001, "m", 1.0}, LengthUnit{9002, "ft", 0.3048},
                                         LengthUnit{9003, "us-ft", 1200.0 / 3937.0}};

/// An open TIFF whose warnings are swallowed and whose last error is kept.
class TiffFile {
 public:
  /// mode as TIFFOpen takes it: "r", "w", "w8" (BigTIFF).
  static Result<TiffFile> open(const std::string& path, const char* mode);
  TIFF* get() const { return tiff_.get(); }
  /// Of the last call, with a sentence that names the file, or without.
  Status failure() const;
  Status reason() const { return {TKS_IO, *error_}; }

 private:
  struct Close {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  };
  std::unique_ptr<std::string> error_;  // before tiff_: closing may still report
  std::unique_ptr<TIFF, Close> tiff_;
};

/// The values of a tag, empty unless it is there with this type.
template <class T>
std::vector<T> tagValues(TIFF* tiff, uint32_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  // libtiff gives tags that it does not know a 32-bit count before the values.
  if (!field || TIFFFieldDataType(field) != type || !TIFFFieldPassCount(field) ||
      TIFFFieldReadCount(field) != TIFF_VARIABLE2) {
    return {};
  }
  uint32_t count = 0;
  const T* values = nullptr;
  if (!TIFFGetField(tiff, tag, &count, &values) || !values) return {};
  return {values, values + count};
}

/// Of a tag of one or equal numbers, its default if it is missing; 0 if it has none.
uint16_t shortTag(TIFF* tiff, uint32_t tag);

/// Black as 0 where the tag is missing, as GDAL has it.
uint16_t photometricOf(TIFF* tiff);

/// Up to its terminating zero; "" if the tag is no text.
std::string tagText(TIFF* tiff, uint32_t tag);

/// What the first directory says of its samples.
struct TiffForm {
  int bits = 0;  ///< of a sample
  bool white_is_zero = false, palette = false;
  bool inks = false;    ///< the first four samples are cyan, magenta, yellow and black
  bool whole = true;    ///< all strips or tiles lie inside the file, but for those that are missing
  bool sparse = false;  ///< some are missing
  bool empty = false;   ///< all are
  bool associated_alpha = false;
  std::vector<BandColour> colours{};          ///< of each sample
  std::vector<std::array<uint8_t, 3>> map{};  ///< of a palette: the colour of each place
  std::string nodata{};        ///< GDAL's nodata value as it is written; "": none is declared
  bool mask = false;           ///< there is a mask page for the first
  bool further_pages = false;  ///< other than that, and smaller versions of the first (overviews)
};
Result<TiffForm> tiffForm(const std::string& path);

/// Whether the file leaves out a strip or tile, as GDAL's sparse files do: a void without bytes.
bool isMissing(TIFF* tiff, uint32_t strip_or_tile);

/// Width and height of the current directory.
std::pair<uint32_t, uint32_t> sizeOfPage(TIFF* tiff);

/// Whether the current directory masks a page of this size.
bool isMaskPage(TIFF* tiff, uint32_t width, uint32_t height);

/// Fills place, scale, offset, spacing, nodata, unit, datum and description of heights whose size
/// and sample type are known, as far as the tags tell; the nodata value as it is written, whatever
/// the samples. Tags that make no sense count as missing.
Status readGeoTags(const std::string& path, HeightFile& heights, Notes& notes);

/// Only the place, of any picture.
Result<Georeference> readGeoreference(const std::string& path, Notes& notes);

/// Deflated TIFF with the tags that readGeoTags reads. A spacing without a place becomes a local
/// grid in metres, in no CRS.
Status writeGeoTiff(const std::string& path, const HeightFile& heights);

/// The same of an image of any kind.
Status writeGeoTiff(const std::string& path, const ImageFile& image);

}  // namespace tetrakis::tools
