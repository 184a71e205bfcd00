// SPDX-License-Identifier: Apache-2.0
// The colours that a surface shows. Light of stored values: sRGB (IEC 61966-2-1).
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "base/portable_math.hpp"

namespace tetrakis::tools {
namespace {

/// Both from 0 to 1.
double lightOf(double value) {
  return value <= 0.04045 ? value / 12.92 : portable::pow((value + 0.055) / 1.055, 2.4);
}
double valueOf(double light) {
  return light <= 0.0031308 ? light * 12.92 : 1.055 * portable::pow(light, 1 / 2.4) - 0.055;
}

using Values = std::array<std::byte, 256>;

/// What the values of a channel become.
Values multiplied(double factor, bool of_light) {
  constexpr double kWhite = 255;
  Values values{};
  for (size_t v = 0; v < values.size(); ++v) {
    const double value = static_cast<double>(v) / kWhite;
    const double shown = of_light ? valueOf(factor * lightOf(value)) : factor * value;
    values[v] = static_cast<std::byte>(std::lround(kWhite * std::clamp(shown, 0.0, 1.0)));
  }
  return values;
}

}  // namespace

ImageFile withoutAlpha(const ImageFile& image) {
  if (image.hasFurtherColour()) return withoutFurtherColour(image);
  if (!image.hasAlpha()) return image;
  ImageFile colours = image;
  colours.channels = image.channels - 1;
  colours.data.clear();
  const size_t taken = colours.channels * tks_sample_bytes(image.sample);
  const size_t texel = image.channels * tks_sample_bytes(image.sample);
  for (size_t at = 0; at + texel <= image.data.size(); at += texel) {
    const auto first = image.data.begin() + static_cast<std::ptrdiff_t>(at);
    colours.data.insert(colours.data.end(), first, first + static_cast<std::ptrdiff_t>(taken));
  }
  return colours;
}

ImageFile shownTexture(const SurfaceFile& surface) {
  ImageFile colours = withoutAlpha(*surface.texture);
  const auto& factor = surface.base_colour;
  const auto all = [&factor](double value) {
    return factor[0] == value && factor[1] == value && factor[2] == value;
  };
  if (colours.channels != 3 || colours.sample != TKS_U8 || all(1) || all(0)) return colours;
  for (size_t channel = 0; channel < 3; ++channel) {
    const Values values = multiplied(factor[channel], surface.y_is_up);
    for (size_t i = channel; i < colours.data.size(); i += 3)
      colours.data[i] = values[static_cast<size_t>(colours.data[i])];
  }
  return colours;
}

}  // namespace tetrakis::tools
