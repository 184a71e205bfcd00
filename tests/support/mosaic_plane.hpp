// SPDX-License-Identifier: Apache-2.0
// Planes that tests of mosaics code tile by tile, each with its plan and a reader of its samples.
#pragma once

#include <bit>
#include <cmath>
#include <vector>

#include "codec/geometry/heights_encoder.hpp"
#include "encoder/mosaic/mosaic_plan.hpp"
#include "tests/support/random_planes.hpp"

namespace tetrakis::test {

/// Heights whose step is 1 and whose base is 0, with the filter of all levels.
struct TileCase {
  Extent plane;
  int region_log2, tile_log2;
  uint8_t filter = 0, fraction_bits = 0, first_doubled = 3;
  int low = -500, high = 500;
  bool voids = false, wild = false;
};

class WholePlane {
 public:
  explicit WholePlane(const TileCase& given) : case_(given) {
    Random random(given.filter + given.plane.width);
    values_ = given.wild ? extremePlane(random, given.plane.samples(), given.low, given.high)
                         : hills(random);
    if (!given.voids) return;
    valid_.assign(values_.size(), 1);
    for (size_t i = 0; i < values_.size(); ++i) {
      const uint32_t x = static_cast<uint32_t>(i % given.plane.width),
                     y = static_cast<uint32_t>(i / given.plane.width);
      if ((x / 37 + y / 23) % 5 == 0 || random() % 40 == 0) valid_[i] = 0;
    }
  }

  MosaicPlan plan() const {
    MosaicPlan plan;
    plan.tile_log2 = case_.tile_log2;
    GeometryHeader& header = plan.header.geometry.emplace();
    header.width = case_.plane.width;
    header.height = case_.plane.height;
    header.sample = TKS_I32;
    header.regions.side_log2 = static_cast<uint8_t>(case_.region_log2);
    header.wavelet.filters = {case_.filter, case_.filter, case_.filter};
    header.wavelet.fraction_bits = case_.fraction_bits;
    header.wavelet.bits = static_cast<uint8_t>(
        std::bit_width(static_cast<uint32_t>(case_.high - case_.low)) + case_.fraction_bits);
    header.wavelet.first_doubled = case_.fraction_bits > 0 ? 0 : case_.first_doubled;
    header.planes = 30;
    plan.header.lossless = 1;
    if (case_.voids) {
      plan.header.layers.validity_bytes = 1;
      plan.header.layers.region_masks = plan.geometry().regions.side_log2 > 0;
      plan.header.layers.has_nodata = 1;
      plan.header.layers.nodata = kNodata;
    }
    return plan;
  }

  const Plane& values() const { return values_; }
  const std::vector<uint8_t>& valid() const { return valid_; }

  std::vector<EncodedTrack> tracks() const {
    const MosaicPlan plan = this->plan();
    CoefficientOptions options;
    options.region_log2 = case_.region_log2;
    return encodeCoefficients({values_, case_.plane, valid_}, plan.geometry().wavelet, options);
  }

  ReadSamples reader() const {
    return [this](const Window& window, void* samples) -> Status {
      auto* out = static_cast<int32_t*>(samples);
      for (uint32_t y = window.y; y < window.y + window.height; ++y) {
        for (uint32_t x = window.x; x < window.x + window.width; ++x) {
          const size_t i = size_t{y} * case_.plane.width + x;
          *out++ = Mask(valid_)[i] ? values_[i] : kNodata;
        }
      }
      return {};
    };
  }

 private:
  static constexpr int32_t kNodata = -99999;

  Plane hills(Random& random) const {
    Plane plane(case_.plane.samples());
    const double span = case_.high - case_.low;
    for (size_t i = 0; i < plane.size(); ++i) {
      const double x = static_cast<double>(i % case_.plane.width),
                   y = static_cast<double>(i / case_.plane.width);
      const double rise = 0.5 + 0.4 * std::sin(x / 17) * std::cos(y / 11);
      plane[i] = case_.low + static_cast<int32_t>(span * rise) + static_cast<int32_t>(random() % 8);
    }
    return plane;
  }

  TileCase case_;
  Plane values_;
  std::vector<uint8_t> valid_;
};

}  // namespace tetrakis::test
