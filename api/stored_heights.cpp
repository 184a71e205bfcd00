// SPDX-License-Identifier: Apache-2.0
#include "api/stored_heights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/restore.hpp"
#include "api/sample_order.hpp"
#include "api/samples.hpp"
#include "bitstream/byte_planes.hpp"
#include "wavelet/mip_level.hpp"

namespace tetrakis {

namespace {

/// The step nearest to a sample, in the range that steps have.
int32_t nearestStep(double sample, const GeometryHeader& header) {
  constexpr double kMost = 1 << 25;
  const double steps = std::round((sample - header.base) / header.step);
  return std::isnan(steps) ? 0 : static_cast<int32_t>(std::clamp(steps, -kMost, kMost));
}

/// Word k is that of the k-th valid sample; -1 for voids.
std::vector<int64_t> numbersOfValid(std::span<const uint8_t> valid, size_t count) {
  std::vector<int64_t> numbers(count, -1);
  int64_t next = 0;
  for (size_t i = 0; i < count; ++i) {
    if (valid.empty() || valid[i]) numbers[i] = next++;
  }
  return numbers;
}

}  // namespace

DecodedHeights decodeStored(const GeometryHeader& header, std::span<const uint8_t> bytes,
                            std::vector<uint8_t> valid, int level) {
  const size_t count = size_t{header.width} * header.height;
  const auto sample = static_cast<tks_sample>(header.sample);
  const std::vector<int64_t> numbers = numbersOfValid(valid, count);
  const auto stored = static_cast<size_t>(
      std::count_if(numbers.begin(), numbers.end(), [](int64_t number) { return number >= 0; }));
  const std::vector<uint32_t> words =
      fromBytePlanes(bytes, stored, static_cast<int>(tks_sample_bytes(sample)));
  const MipLevel mip(header.width, header.height, level);
  DecodedHeights decoded;
  DecodedGeometry& g = decoded.geometry;
  g.width = mip.size().width;
  g.height = mip.size().height;
  g.heights.resize(mip.samples());
  g.significant.resize(mip.samples());
  if (!valid.empty()) g.valid.resize(mip.samples());
  decoded.corrections.resize(mip.samples());
  withSampleType(sample, [&](auto type) {
    using T = decltype(type);
    for (size_t i = 0; i < mip.samples(); ++i) {
      const size_t at = ((i / g.width) * header.width + i % g.width) << level;
      const int64_t number = numbers[at];
      if (!valid.empty()) g.valid[i] = valid[at];
      if (number < 0 || static_cast<size_t>(number) >= words.size()) continue;
      const uint32_t word = words[static_cast<size_t>(number)];
      g.heights[i] = nearestStep(static_cast<double>(fromOrder<T>(word)), header);
      const T near = restore<T>(header.base, header.step, g.heights[i]);
      decoded.corrections[i] = static_cast<int32_t>(word - orderOf(near));
      g.significant[i] = 1;
    }
  });
  return decoded;
}

uint64_t storedBytes(const tks_heights& heights, size_t valid_samples) {
  return uint64_t{valid_samples} * tks_sample_bytes(heights.sample);
}

std::vector<uint8_t> storeSamples(const tks_heights& heights, std::span<const uint8_t> valid) {
  std::vector<uint32_t> words;
  withSampleType(heights.sample, [&](auto type) {
    const auto* samples = static_cast<const decltype(type)*>(heights.data);
    for (size_t i = 0; i < size_t{heights.width} * heights.height; ++i) {
      if (valid.empty() || valid[i]) words.push_back(orderOf(samples[i]));
    }
  });
  return toBytePlanes(words, static_cast<int>(tks_sample_bytes(heights.sample)));
}

}  // namespace tetrakis
