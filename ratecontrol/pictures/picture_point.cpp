// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/picture_point.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/portable_math.hpp"
#include "base/samples.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::inline pictures {

std::vector<Lanes> shownTexels(const Texels& texels) {
  const size_t channels = texels.channels;
  const bool has_alpha = texels.hasAlpha();
  const size_t second = channels < 3 ? 0 : 1, third = channels < 3 ? 0 : 2;
  const uint32_t white = texels.white(), most = texels.most();
  std::vector<Lanes> shown(texels.extent().samples());
  const uint16_t* texel = texels.samples.data();
  for (Lanes& lanes : shown) {
    const uint32_t alpha = has_alpha ? shownIn8Bits(texel[channels - 1], most) : 255;
    const auto colour = [&](size_t c) -> Lanes {
      const uint32_t value = shownIn8Bits(texel[c], white);
      return alpha == 255 ? value : (value * alpha + 127) / 255;
    };
    lanes = colour(0) | colour(second) << 16 | colour(third) << 32;
    texel += channels;
  }
  return shown;
}

ScreenTexture::ScreenTexture(const Texels& texels, Extent whole, int first)
    : whole_(whole), first_(first) {
  Level level{texels.width, texels.height, shownTexels(texels), 1, 1, 0};
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
  constexpr Lanes kHalf = 0x0002'0002'0002, kBytes = 0x00ff'00ff'00ff;
  Level coarse{std::max(1u, fine.width / 2), std::max(1u, fine.height / 2), {}};
  coarse.texels.resize(size_t{coarse.width} * coarse.height);
  const size_t beside = fine.width > 1 ? 1 : 0;
  Lanes* out = coarse.texels.data();
  for (uint32_t y = 0; y < coarse.height; ++y) {
    const Lanes* north = &fine.texels[size_t{fine.width} * std::min(2 * y, fine.height - 1)];
    const Lanes* south = &fine.texels[size_t{fine.width} * std::min(2 * y + 1, fine.height - 1)];
    for (uint32_t x = 0; x < coarse.width; ++x) {
      const size_t west = size_t{2} * x, east = west + beside;
      *out++ = (north[west] + north[east] + south[west] + south[east] + kHalf) >> 2 & kBytes;
    }
  }
  return coarse;
}

/// Along rows weights are multiples of 1/256, so that sums of lanes stay below 2^16.
void ScreenTexture::addBilinear(const Level& level, double u, double v, float weight, Colour& sum) {
  const double x = std::clamp(u * level.scale_x - level.shift, 0.0, level.width - 1.0);
  const double y = std::clamp(v * level.scale_y - level.shift, 0.0, level.height - 1.0);
  const auto west = static_cast<size_t>(x), north = static_cast<size_t>(y);
  const size_t east = std::min<size_t>(west + 1, level.width - 1);
  const size_t south = std::min<size_t>(north + 1, level.height - 1);
  constexpr Lanes kParts = 256;
  const auto of_east = static_cast<Lanes>((x - static_cast<double>(west)) * kParts + 0.5);
  const auto fy = static_cast<float>(y - static_cast<double>(north));
  const Lanes* const texels = level.texels.data();
  const auto along = [&](size_t row) {
    const Lanes* const from = texels + row * level.width;
    return from[west] * (kParts - of_east) + from[east] * of_east;
  };
  const Lanes upper = along(north), lower = along(south);
  const float of_upper = weight * (1 - fy) / kParts, of_lower = weight * fy / kParts;
  for (size_t c = 0; c < 3; ++c)
    sum[c] += of_upper * static_cast<float>(upper >> 16 * c & 0xffff) +
              of_lower * static_cast<float>(lower >> 16 * c & 0xffff);
}

Colour ScreenTexture::at(double u, double v, double level) const {
  const double last = static_cast<double>(levels_.size()) - 1;
  const double detail = std::clamp(level - first_, 0.0, last);
  const auto fine = static_cast<size_t>(detail);
  const auto rest = static_cast<float>(detail - static_cast<double>(fine));
  Colour sum{};
  addBilinear(levels_[fine], u, v, 1 - rest, sum);
  if (rest > 0) addBilinear(levels_[fine + 1], u, v, rest, sum);
  return sum;
}

CameraPoints::CameraPoints(const Camera& camera) : height_(camera.height) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = portable::tan(camera.fov_y * std::numbers::pi / 360);
  const double pixel = 2 * tan_y / camera.height;
  origin_.right = scale(axes.right, pixel);
  origin_.down = scale(axes.up, -pixel);
  origin_.ray.origin = camera.eye;
  corner_ = add(axes.forward, add(scale(origin_.right, camera.width / -2.0),
                                  scale(origin_.down, camera.height / -2.0)));
}

PicturePoint CameraPoints::at(double column, double row) const {
  PicturePoint point = origin_;
  point.ray.direction = add(corner_, add(scale(point.right, column), scale(point.down, row)));
  const double last = height_ - 1.0;
  const auto sky = skyAt(static_cast<uint32_t>(std::clamp(row, 0.0, last)), height_);
  for (size_t c = 0; c < 3; ++c) point.sky[c] = static_cast<float>(sky[c]);
  return point;
}

SeenPoint seenAt(const PicturePoint& point, const GroundRays& ground, Extent texture) {
  SeenPoint seen;
  const auto hit = ground.hit(point.ray);
  if (!hit) return seen;
  const double columns = ground.frame().width - 1.0, rows = ground.frame().height - 1.0;
  seen.ground = true;
  seen.u = hit->column / columns;
  seen.v = hit->row / rows;
  // Distances are measured along the plane of the triangle. A triangle that is seen edge on is as
  // wide as the texture at most.
  const auto texelsTo = [&](const Vec3& change) {
    const Ray ray{point.ray.origin, add(point.ray.direction, scale(change, 0.5))};
    const auto place = ground.onPlane(*hit, ray);
    const double u = place ? std::clamp((*place)[0] / columns - seen.u, -1.0, 1.0) : 1;
    const double v = place ? std::clamp((*place)[1] / rows - seen.v, -1.0, 1.0) : 1;
    const double texels_u = u * texture.width, texels_v = v * texture.height;
    return std::sqrt(texels_u * texels_u + texels_v * texels_v);
  };
  const double wide = std::max(texelsTo(point.right), texelsTo(point.down));
  seen.level = wide > 1 ? portable::log2(wide) : 0;
  return seen;
}

Colour colourOf(const PicturePoint& point, const SeenPoint& seen, const ScreenTexture& texture) {
  return seen.ground ? texture.at(seen.u, seen.v, seen.level) : point.sky;
}

double squaresBetween(const Colour& a, const Colour& b) {
  double squares = 0;
  for (size_t c = 0; c < 3; ++c) squares += double{a[c] - b[c]} * double{a[c] - b[c]};
  return squares;
}

std::vector<double> sharesOf(const std::vector<Camera>& cameras) {
  double most = 0, weights = 0;
  for (const Camera& camera : cameras) most = std::max(most, camera.weight);
  assert(most > 0);
  for (const Camera& camera : cameras) weights += camera.weight / most;
  std::vector<double> shares;
  for (const Camera& camera : cameras) shares.push_back(camera.weight / most / weights);
  return shares;
}

}  // namespace tetrakis::inline pictures
