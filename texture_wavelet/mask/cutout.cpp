// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/mask/cutout.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace tetrakis::inline mask {

std::vector<uint8_t> cutoutOf(const Texels& texels) {
  std::vector<uint8_t> seen;
  if (!texels.hasAlpha()) return seen;
  const size_t count = size_t{texels.width} * texels.height;
  size_t opaque = 0;
  seen.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const uint16_t alpha = texels.samples[(i + 1) * texels.channels - 1];
    if (alpha != 0 && alpha != texels.most()) return {};
    seen[i] = alpha != 0;
    opaque += seen[i];
  }
  if (opaque == count) return {};
  return seen;
}

std::vector<uint8_t> softlySeen(const Texels& texels) {
  if (!texels.hasAlpha()) return {};
  std::vector<uint8_t> seen(texels.extent().samples());
  bool soft = false;
  for (size_t i = 0; i < seen.size(); ++i) {
    const uint16_t alpha = texels.samples[(i + 1) * texels.channels - 1];
    seen[i] = alpha != 0;
    soft = soft || (alpha != 0 && alpha != texels.most());
  }
  if (!soft || std::find(seen.begin(), seen.end(), 0) == seen.end()) return {};
  return seen;
}

std::vector<std::vector<int32_t>> withMeanColour(Mask mask,
                                                 std::vector<std::vector<int32_t>> channels) {
  if (mask.all()) return channels;
  const std::span<const uint8_t> coded = mask.bytes();
  const auto count = std::max(int64_t{1}, std::accumulate(coded.begin(), coded.end(), int64_t{0}));
  for (std::vector<int32_t>& channel : channels) {
    int64_t sum = 0;
    for (size_t i = 0; i < coded.size(); ++i) sum += coded[i] * channel[i];
    const auto mean = static_cast<int32_t>((sum + count / 2) / count);
    for (size_t i = 0; i < coded.size(); ++i) {
      if (!coded[i]) channel[i] = mean;
    }
  }
  return channels;
}

uint64_t countedSamples(const Texels& texels, Mask seen) {
  if (seen.all()) return texels.samples.size();
  const std::span<const uint8_t> marks = seen.bytes();
  const auto opaque = std::accumulate(marks.begin(), marks.end(), uint64_t{0});
  return marks.size() + opaque * (texels.channels - 1);
}

double countedSquares(const Texels& original, const Texels& decoded, Mask seen) {
  uint64_t squares = 0;
  const auto add = [&](size_t k) {
    const int32_t difference = int32_t{original.samples[k]} - decoded.samples[k];
    squares += static_cast<uint32_t>(difference) * static_cast<uint32_t>(difference);
  };
  const size_t channels = original.channels;
  if (seen.all()) {
    for (size_t k = 0; k < original.samples.size(); ++k) add(k);
    return static_cast<double>(squares);
  }
  for (size_t i = 0; i < seen.bytes().size(); ++i) {
    for (size_t c = seen[i] ? 0 : channels - 1; c < channels; ++c) add(i * channels + c);
  }
  return static_cast<double>(squares);
}

}  // namespace tetrakis::inline mask
