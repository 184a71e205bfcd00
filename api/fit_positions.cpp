// SPDX-License-Identifier: Apache-2.0
// Positions for tks_heights and tks_image, fitted to what the caller knows.
#include <cmath>
#include <cstddef>
#include <vector>

#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "encoder/encode_stream.hpp"

namespace tetrakis::inline api {
namespace {

Status fit(const tks_ground* given, tks_buffer& out) {
  constexpr double kTolerance = 0.1;
  tks_ground ground;
  if (given == nullptr) return {TKS_USAGE, "The raster is missing."};
  Status taken = takeSized("the raster", *given, offsetof(tks_ground, tolerance), ground);
  if (!taken.ok()) return taken;
  if (ground.locate == nullptr || ground.width == 0 || ground.height == 0 ||
      !(ground.tolerance >= 0))
    return {TKS_USAGE, "A raster has samples, and something that locates them."};
  const auto locate = [&](double u, double v) -> std::optional<LongitudeLatitude> {
    LongitudeLatitude place;
    const bool known =
        ground.locate(ground.user, (u + 1) / 2 * ground.width, (v + 1) / 2 * ground.height,
                      &place.longitude, &place.latitude) == 0;
    return known ? std::optional(place) : std::nullopt;
  };
  const auto positions = fitPositions(
      locate, {static_cast<double>(ground.width), static_cast<double>(ground.height),
               ground.tolerance > 0 ? ground.tolerance : kTolerance, TKS_MOST_POSITION_BYTES});
  if (!positions) return {TKS_UNSUPPORTED, "No positions of so few bytes are as good as that."};
  const std::string bytes = written(*positions);
  giveBytes(std::vector<uint8_t>(bytes.begin(), bytes.end()), out);
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_fit_positions(const tks_ground* ground, tks_buffer* out) {
  if (out == nullptr) return TKS_USAGE;
  *out = {nullptr, 0};
  return tetrakis::answering([&] { return tetrakis::fit(ground, *out); });
}
