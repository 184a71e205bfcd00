// SPDX-License-Identifier: Apache-2.0
// The colours that a surface shows. Light of stored values: sRGB (IEC 61966-2-1).
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "base/portable_math.hpp"

namespace tetrakis::tools {
double lightOf(double value) {
  return value <= 0.04045 ? value / 12.92 : portable::pow((value + 0.055) / 1.055, 2.4);
}

double valueOf(double light) {
  return light <= 0.0031308 ? light * 12.92 : 1.055 * portable::pow(light, 1 / 2.4) - 0.055;
}

namespace {

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

namespace {

bool isAll(const SurfaceFile& surface, double value) {
  const auto& [red, green, blue, alpha] = surface.base_colour;
  return red == value && green == value && blue == value;
}

/// RGB of 8 bits, times the base colour.
void multiplyBy(const SurfaceFile& surface, ImageFile& colours) {
  for (size_t channel = 0; channel < 3; ++channel) {
    const Values values = multiplied(surface.base_colour[channel], surface.y_is_up);
    for (size_t i = channel; i < colours.data.size(); i += 3)
      colours.data[i] = values[static_cast<size_t>(colours.data[i])];
  }
}

}  // namespace

ImageFile shownTexture(const SurfaceFile& surface) {
  ImageFile colours = withoutAlpha(*surface.texture);
  const bool is_shown = colours.channels != 3 || colours.sample != TKS_U8;
  if (!is_shown && !isAll(surface, 1) && !isAll(surface, 0)) multiplyBy(surface, colours);
  return colours;
}

ImageFile plainTexture(const SurfaceFile& surface) {
  constexpr std::byte kWhite{255};
  ImageFile colour{1, 1, 3, TKS_U8, {kWhite, kWhite, kWhite}};
  if (surface.y_is_up || !isAll(surface, 0)) multiplyBy(surface, colour);
  return colour;
}

}  // namespace tetrakis::tools
