// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/heights_decoder.hpp"

#include <algorithm>
#include <cassert>

#include "base/samples.hpp"
#include "base/view.hpp"
#include "bitstream/coder/byte_planes.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/steps/step_units.hpp"

namespace tetrakis::inline geometry {

namespace {

/// Steps of stored samples stay within what other steps do.
constexpr int64_t kMostSteps = 1 << 25;

template <class T>
class StoredSamples {
 public:
  StoredSamples(const GeometryHeader& header, const BytePlanes& words, DecodedHeights& out)
      : header_(header), grid_(header.base, header.step), words_(words), out_(out) {}

  /// Writes the stored sample `number` as sample i of the result.
  void put(size_t i, size_t number) {
    if (!words_.knows(number)) return;
    const uint32_t word = words_[number];
    int32_t& step = out_.geometry.heights[i];
    const T sample = fromOrder<T>(word);
    step = isNaN(sample) ? 0 : grid_.nearest(sample, 0, kMostSteps);
    const T near = restore<T>(header_.base, header_.step, step);
    out_.corrections[i] = static_cast<int32_t>(word - orderOf(near));
    out_.geometry.significant[i] = 1;
  }

 private:
  const GeometryHeader& header_;
  StepGrid grid_;
  const BytePlanes& words_;
  DecodedHeights& out_;
};

DecodedHeights emptyHeights(Extent extent) {
  DecodedHeights out;
  out.geometry.width = extent.width;
  out.geometry.height = extent.height;
  out.geometry.heights.resize(extent.samples());
  out.geometry.significant.resize(extent.samples());
  out.corrections.resize(extent.samples());
  return out;
}

/// Calls see(i, number) for the valid samples of a view: sample i of the view is sample `number` of
/// all valid ones.
void forEachValid(const GeometryHeader& header, const BitPlane* valid, const View& view,
                  const auto& see) {
  const Extent extent = view.extentIn(header.extent());
  size_t rows_before = 0;
  size_t i = 0;
  for (uint32_t y = 0, above = 0; y < extent.height; ++y) {
    const uint32_t row = view.rowOf(y);
    for (; above < row; ++above)
      rows_before += valid != nullptr ? valid->countBefore(header.width, above) : header.width;
    uint32_t x = view.firstColumn();
    size_t number = rows_before + (valid != nullptr ? valid->countBefore(x, row) : x);
    for (uint32_t k = 0; k < extent.width; ++k, ++i) {
      if (valid == nullptr || valid->at(x, row)) see(i, number);
      for (const uint32_t end = std::min(x + view.step(), header.width); x < end; ++x)
        number += valid == nullptr || valid->at(x, row);
    }
  }
}

}  // namespace

DecodedHeights decodeStoredHeights(const GeometryHeader& header, std::span<const uint8_t> bytes,
                                   const SharedBits& valid, const View& view) {
  size_t count = header.extent().samples();
  if (valid != nullptr) {
    count = 0;
    for (uint32_t y = 0; y < header.height; ++y) count += valid->countBefore(header.width, y);
  }
  const auto sample = static_cast<tks_sample>(header.sample);
  const BytePlanes words(bytes, count, static_cast<int>(tks_sample_bytes(sample)));
  DecodedHeights decoded = emptyHeights(view.extentIn(header.extent()));
  decoded.geometry.valid = shownMarks(valid, view);
  withSampleType(sample, [&](auto type) {
    StoredSamples<decltype(type)> samples(header, words, decoded);
    forEachValid(header, valid.get(), view,
                 [&](size_t i, size_t number) { samples.put(i, number); });
  });
  return decoded;
}

}  // namespace tetrakis::inline geometry
