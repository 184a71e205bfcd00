// SPDX-License-Identifier: Apache-2.0
#include "base/samples.hpp"

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

size_t tks_sample_bytes(tks_sample sample) {
  if (sample < TKS_U8 || sample > TKS_F32) return 0;
  return tetrakis::withSampleType(sample, [](auto type) { return sizeof(type); });
}

namespace tetrakis::inline base {

namespace {

/// The colours of an image of 16 bits, and its alpha.
struct Colours {
  explicit Colours(const tks_image& image)
      : samples(static_cast<const uint16_t*>(image.data),
                size_t{image.width} * image.height * image.channels),
        channels(image.channels),
        shown(image.channels < 3 ? 1 : 3),
        has_alpha(image.channels % 2 == 0 && image.opaque == 0) {}

  std::span<const uint16_t> samples;
  size_t channels, shown;
  bool has_alpha;
};

/// How many colours have each value, but for those that are not seen; none if an alpha is soft.
std::vector<uint64_t> histogramOf(const Colours& colours) {
  std::vector<uint64_t> counts(size_t{UINT16_MAX} + 1);
  for (size_t i = 0; i < colours.samples.size(); i += colours.channels) {
    const uint16_t alpha =
        colours.has_alpha ? colours.samples[i + colours.channels - 1] : UINT16_MAX;
    if (alpha != 0 && alpha != UINT16_MAX) return {};
    if (alpha == 0) continue;
    for (size_t c = 0; c < colours.shown; ++c) ++counts[colours.samples[i + c]];
  }
  return counts;
}

}  // namespace

uint32_t findWhiteLevel(const tks_image& image) {
  constexpr uint32_t kDim = UINT16_MAX / 4;
  const uint32_t largest = largestTexel(image.sample);
  if (image.sample != TKS_U16) return largest;
  std::vector<uint64_t> counts = histogramOf(Colours(image));
  if (counts.empty()) return largest;
  counts[0] = 0;  // often the border of a scene
  const uint64_t all = std::accumulate(counts.begin(), counts.end(), uint64_t{0});
  uint64_t above = 0;
  uint32_t level = UINT16_MAX;
  while (level > 0 && 50 * (above + counts[level]) <= all) above += counts[level--];
  uint32_t most = UINT16_MAX;
  while (most > 0 && counts[most] == 0) --most;
  const uint32_t white = std::min(most, level + level / 4);
  return white > 0 && white <= kDim ? white : largest;
}

}  // namespace tetrakis::inline base
