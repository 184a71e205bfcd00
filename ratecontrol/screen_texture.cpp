// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/screen_texture.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tetrakis::inline ratecontrol {

ScreenTexture::ScreenTexture(const Texels& texels, Extent whole, int first)
    : whole_(whole), first_(first) {
  const size_t count = size_t{texels.width} * texels.height, channels = texels.channels;
  const bool has_alpha = channels % 2 == 0;
  const int shift = texels.bits - 8;
  Level level{texels.width, texels.height, std::vector<uint8_t>(4 * count), 1, 1, 0};
  for (size_t i = 0; i < count; ++i) {
    const uint16_t* texel = &texels.samples[i * channels];
    const uint32_t alpha = has_alpha ? texel[channels - 1] >> shift : 255;
    for (size_t c = 0; c < 3; ++c) {
      const uint32_t colour = texel[channels < 3 ? 0 : c] >> shift;
      level.texels[4 * i + c] = static_cast<uint8_t>((colour * alpha + 127) / 255);
    }
  }
  while (level.width > 1 || level.height > 1) {
    Level next = halved(level);
    levels_.push_back(std::move(level));
    level = std::move(next);
  }
  levels_.push_back(std::move(level));
  for (size_t i = 0; i < levels_.size(); ++i) place(levels_[i], static_cast<int>(i));
}

/// A texel of the level is the mean of 2^halvings samples, which lie 2^first_ texels apart.
void ScreenTexture::place(Level& level, int halvings) const {
  const double mean = std::ldexp(1.0, halvings), apart = std::ldexp(1.0, first_);
  level.scale_x = whole_.width / (apart * mean);
  level.scale_y = whole_.height / (apart * mean);
  level.shift = (0.5 / apart + (mean - 1) / 2) / mean;
}

ScreenTexture::Level ScreenTexture::halved(const Level& fine) {
  Level coarse{std::max(1u, fine.width / 2), std::max(1u, fine.height / 2), {}};
  coarse.texels.resize(size_t{4} * coarse.width * coarse.height);
  size_t out = 0;
  for (uint32_t y = 0; y < coarse.height; ++y) {
    const uint8_t* north = &fine.texels[size_t{4} * fine.width * std::min(2 * y, fine.height - 1)];
    const uint8_t* south =
        &fine.texels[size_t{4} * fine.width * std::min(2 * y + 1, fine.height - 1)];
    for (uint32_t x = 0; x < coarse.width; ++x) {
      const size_t west = size_t{4} * std::min(2 * x, fine.width - 1);
      const size_t east = size_t{4} * std::min(2 * x + 1, fine.width - 1);
      for (size_t c = 0; c < 4; ++c)
        coarse.texels[out++] = static_cast<uint8_t>(
            (north[west + c] + north[east + c] + south[west + c] + south[east + c] + 2) / 4);
    }
  }
  return coarse;
}

void ScreenTexture::addBilinear(const Level& level, double u, double v, float weight, Sum& sum) {
  const double x = std::clamp(u * level.scale_x - level.shift, 0.0, level.width - 1.0);
  const double y = std::clamp(v * level.scale_y - level.shift, 0.0, level.height - 1.0);
  const auto west = static_cast<size_t>(x), north = static_cast<size_t>(y);
  const size_t east = std::min<size_t>(west + 1, level.width - 1);
  const size_t south = std::min<size_t>(north + 1, level.height - 1);
  const auto fx = static_cast<float>(x - static_cast<double>(west));
  const auto fy = static_cast<float>(y - static_cast<double>(north));
  const uint8_t* rows[2] = {&level.texels[4 * north * level.width],
                            &level.texels[4 * south * level.width]};
  const float along[2] = {weight * (1 - fy), weight * fy};
  for (size_t j = 0; j < 2; ++j) {
    const uint8_t *a = rows[j] + 4 * west, *b = rows[j] + 4 * east;
    const float wa = along[j] * (1 - fx), wb = along[j] * fx;
    for (size_t c = 0; c < 4; ++c)
      sum[c] += wa * static_cast<float>(a[c]) + wb * static_cast<float>(b[c]);
  }
}

Colour ScreenTexture::at(double u, double v, double level) const {
  const double last = static_cast<double>(levels_.size()) - 1;
  const double detail = std::clamp(level - first_, 0.0, last);
  const auto fine = static_cast<size_t>(detail);
  const auto rest = static_cast<float>(detail - static_cast<double>(fine));
  Sum sum{};
  addBilinear(levels_[fine], u, v, 1 - rest, sum);
  if (rest > 0) addBilinear(levels_[fine + 1], u, v, rest, sum);
  return {sum[0], sum[1], sum[2]};
}

}  // namespace tetrakis::inline ratecontrol
