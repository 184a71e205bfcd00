// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/stored_heights_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/samples.hpp"
#include "base/view.hpp"
#include "bitstream/coder/byte_planes.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline geometry {

namespace {

/// The step nearest to a sample, in the range that steps have.
int32_t nearestStep(double sample, const GeometryHeader& header) {
  constexpr double kMost = 1 << 25;
  const double steps = std::round((sample - header.base) / header.step);
  return std::isnan(steps) ? 0 : static_cast<int32_t>(std::clamp(steps, -kMost, kMost));
}

template <class T>
class StoredSamples {
 public:
  StoredSamples(const GeometryHeader& header, const BytePlanes& words, DecodedHeights& out)
      : header_(header), words_(words), out_(out) {}

  /// Sample i of what comes out is the stored one with that number.
  void put(size_t i, size_t number) {
    if (!words_.knows(number)) return;
    const uint32_t word = words_[number];
    int32_t& step = out_.geometry.heights[i];
    step = nearestStep(static_cast<double>(fromOrder<T>(word)), header_);
    const T near = restore<T>(header_.base, header_.step, step);
    out_.corrections[i] = static_cast<int32_t>(word - orderOf(near));
    out_.geometry.significant[i] = 1;
  }

 private:
  const GeometryHeader& header_;
  const BytePlanes& words_;
  DecodedHeights& out_;
};

DecodedHeights emptyHeights(Extent extent, bool masked) {
  DecodedHeights out;
  out.geometry.width = extent.width;
  out.geometry.height = extent.height;
  out.geometry.heights.resize(extent.samples());
  out.geometry.significant.resize(extent.samples());
  if (masked) out.geometry.valid.resize(extent.samples());
  out.corrections.resize(extent.samples());
  return out;
}

}  // namespace

DecodedHeights decodeStoredHeights(const GeometryHeader& header, std::span<const uint8_t> bytes,
                                   Mask valid, int level) {
  const size_t count = header.extent().samples();
  const auto marks = valid.bytes();
  const auto voids = static_cast<size_t>(std::count(marks.begin(), marks.end(), uint8_t{0}));
  const auto sample = static_cast<tks_sample>(header.sample);
  const BytePlanes words(bytes, count - voids, static_cast<int>(tks_sample_bytes(sample)));
  assert(valid.all() || marks.size() == count);
  const Extent extent = View{level, {}}.extentIn(header.extent());
  DecodedHeights decoded = emptyHeights(extent, !valid.all());
  const size_t between = (size_t{1} << level) - 1;
  withSampleType(sample, [&](auto type) {
    StoredSamples<decltype(type)> samples(header, words, decoded);
    size_t at = 0, i = 0, number = 0;
    for (uint32_t y = 0; y < header.height; ++y) {
      for (uint32_t x = 0; x < header.width; ++x, ++at) {
        const bool is_valid = valid[at];
        const bool taken = ((x | y) & between) == 0;
        if (taken && is_valid) samples.put(i, number);
        if (taken && !valid.all()) decoded.geometry.valid[i] = is_valid;
        i += taken;
        number += is_valid;
      }
    }
    assert(i == extent.samples() && number == count - voids);
  });
  return decoded;
}

}  // namespace tetrakis::inline geometry
