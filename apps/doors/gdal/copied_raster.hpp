// SPDX-License-Identifier: Apache-2.0
// Datasets of GDAL as what tks_encode takes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include "apps/doors/gdal/crs.hpp"
#include "apps/doors/gdal/ground_positions.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

struct Progress {
  GDALProgressFunc function;
  void* user;
};

/// The part [from, to] of a longer work; false: stop.
class ProgressPart {
 public:
  ProgressPart(const Progress& whole, double from, double to)
      : whole_(whole), from_(from), to_(to) {}
  bool report(double done) const {
    return whole_.function == nullptr ||
           whole_.function(from_ + (to_ - from_) * done, "", whole_.user) != FALSE;
  }
  static int CPL_STDCALL call(double done, const char*, void* part) {
    return static_cast<const ProgressPart*>(part)->report(done) ? TRUE : FALSE;
  }

 private:
  Progress whole_;
  double from_, to_;
};

/// Move only: the struct points into its own texts and samples.
struct CopiedHeights {
  std::vector<std::byte> samples;
  CrsTexts crs;
  std::string unit, description;
  tks_heights heights{};
  double rounding = 0;                ///< of doubles to floats, at most, in samples
  std::unique_ptr<WebGround> ground;  ///< where browsers do not know it
  std::vector<uint8_t> positions;     ///< what is fitted to it
};

struct CopiedTexture {
  std::vector<std::byte> texels;
  CrsTexts crs;
  tks_image image{};
  std::unique_ptr<WebGround> ground;
  std::vector<uint8_t> positions;
};

/// Heights without their samples, and without what they say of voids. Null after a reported error.
std::unique_ptr<CopiedHeights> describeHeights(const std::string& name, GDALDataset& dataset);

/// The same of one of several bands.
std::unique_ptr<CopiedHeights> describeBand(const std::string& name, GDALRasterBand& band);
/// Reads what describeBand() has described, with its voids. False after a reported error.
bool readHeights(const std::string& name, GDALRasterBand& band, bool strict, CopiedHeights& copy,
                 const ProgressPart& progress);

/// With all. strict: doubles that no float holds are refused; else a warning tells that they are
/// rounded. Null after a reported error.
std::unique_ptr<CopiedHeights> copyHeights(const std::string& name, GDALDataset& dataset,
                                           bool strict, const ProgressPart& progress);

/// The numbers of the bands in a texture's order: red, green, blue, what is none of these, alpha.
std::vector<int> textureBands(GDALDataset& dataset);

/// A sentence that says why it is no texture; "" if it may be one.
std::string whyNoTexture(GDALDataset& dataset);
/// Whether it becomes a texture without heights: colours, or anything with alpha.
bool isPicture(GDALDataset& dataset);

/// `file` is opened; warnings tell where it lies beside the heights, and what of it is not kept.
/// Null after a reported error.
std::unique_ptr<CopiedTexture> copyTexture(const std::string& name, const std::string& file,
                                           GDALDataset& heights);
/// Of what isPicture(). Null after a reported error.
std::unique_ptr<CopiedTexture> copyPicture(const std::string& name, GDALDataset& dataset);

struct Place {
  double geotransform[6];
  int has_geotransform;
  tks_registration registration;
};
Place placeOf(GDALDataset& dataset);

/// A cylinder if the columns of a geographic grid go round the Earth. system: null if unknown.
tks_domain domainOf(const Place& place, const OGRSpatialReference* system, uint32_t width);

}  // namespace tetrakis::gdal
