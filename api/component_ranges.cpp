// SPDX-License-Identifier: Apache-2.0
#include "api/component_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "api/decoder.hpp"
#include "api/group_chain.hpp"
#include "tetrakis/components.h"

namespace tetrakis::inline api {
namespace {

constexpr uint64_t kMostSamples = 1 << 16;

/// The finest level of so few samples, or the coarsest one.
uint32_t levelOf(uint64_t width, uint64_t height, uint32_t coarsest) {
  uint32_t level = 0;
  const auto samples = [&] { return (((width - 1) >> level) + 1) * (((height - 1) >> level) + 1); };
  while (level < coarsest && samples() > kMostSamples) ++level;
  return level;
}

/// Exhausted memory is what the caller's guard answers for.
Status failureOf(const tks_decoder& decoder, tks_status code) {
  if (code == TKS_NO_MEMORY) throw std::bad_alloc();
  return {code, tks_message(&decoder)};
}

tks_info infoOf(const tks_decoder& decoder) {
  tks_info info{};
  info.size = sizeof info;
  if (tks_get_info(&decoder, &info) != TKS_OK) throw std::bad_alloc();
  return info;
}

/// values: those that are there. step: what a quality counts in.
ComponentRange rangeOf(const std::vector<double>& values, double step) {
  if (values.empty()) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double range = *most > *least ? *most - *least : 1;
  const auto count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += std::pow((value - sum / count) / range, 2);
  return {range / step, squares / count};
}

Result<ComponentRange> rangeOfHeights(tks_decoder& decoder) {
  const tks_info whole = infoOf(decoder);
  const uint32_t level = levelOf(whole.width, whole.height, whole.coarsest_level);
  if (const tks_status code = tks_set_levels(&decoder, level, 0); code != TKS_OK)
    return failureOf(decoder, code);
  const tks_info info = infoOf(decoder);
  std::vector<float> surface(size_t{info.width} * info.height);
  if (const tks_status code = tks_decode_surface(&decoder, surface.data(), surface.size());
      code != TKS_OK)
    return failureOf(decoder, code);
  std::vector<double> values;
  for (const float height : surface)
    if (std::isfinite(height)) values.push_back(height);
  return rangeOf(values, info.step * std::abs(info.scale));
}

Result<ComponentRange> rangeOfTexture(tks_decoder& decoder) {
  const tks_info whole = infoOf(decoder);
  const uint32_t level =
      levelOf(whole.texture_width, whole.texture_height, whole.texture_coarsest_level);
  if (const tks_status code = tks_set_levels(&decoder, 0, level); code != TKS_OK)
    return failureOf(decoder, code);
  const tks_info info = infoOf(decoder);
  const size_t count = size_t{info.texture_width} * info.texture_height * info.texture_channels;
  const bool is_wide = info.texture_sample == TKS_U16;
  std::vector<uint8_t> texels(count * (is_wide ? 2 : 1));
  if (const tks_status code = tks_decode_texture(&decoder, texels.data(), texels.size());
      code != TKS_OK)
    return failureOf(decoder, code);
  std::vector<double> values(count);
  for (size_t i = 0; i < count; ++i) {
    uint16_t wide = 0;
    if (is_wide) std::memcpy(&wide, texels.data() + 2 * i, sizeof wide);
    values[i] = is_wide ? wide : texels[i];
  }
  return rangeOf(values, 1);
}

}  // namespace

Result<std::vector<ComponentRange>> componentRanges(std::span<const uint8_t> stream,
                                                    const tks_limits* limits) {
  Result<OwnedDecoder> opened = openBehind(stream, limits, {});
  if (!opened.ok()) return opened.status();
  tks_decoder& decoder = **opened;
  std::vector<ComponentRange> ranges;
  for (uint32_t i = 0; i < decoder.parsed.header.components.size(); ++i) {
    tks_component component{};
    component.size = sizeof component;
    if (tks_get_component(&decoder, i, &component) != TKS_OK) throw std::bad_alloc();
    if (component.kind == TKS_COMPONENT_UNKNOWN) {
      ranges.emplace_back();
      continue;
    }
    if (const tks_status code = tks_choose_component(&decoder, i); code != TKS_OK)
      return failureOf(decoder, code);
    Result<ComponentRange> range =
        component.kind == TKS_COMPONENT_HEIGHTS ? rangeOfHeights(decoder) : rangeOfTexture(decoder);
    if (!range.ok()) return range.status();
    ranges.push_back(*range);
  }
  return ranges;
}

}  // namespace tetrakis::inline api
