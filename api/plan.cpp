// SPDX-License-Identifier: Apache-2.0
// Which bytes of a stream a viewer should fetch next.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "api/guarded.hpp"
#include "api/needed.hpp"
#include "api/outlook.hpp"

namespace tetrakis::inline api {
namespace {

/// Sightings of the ground that the camera sees, and that it might see next. Without a camera all
/// ground counts alike.
Result<std::vector<WeightedSighting>> sightingsIn(tks_decoder& decoder,
                                                  const tks_screen_camera* given,
                                                  uint32_t triangles) {
  if (given == nullptr)
    return std::vector<WeightedSighting>{{{.ground = {}, .triangles = triangles}, 1}};
  tks_screen_camera camera{};
  if (Status status = takeCamera("the view", *given, camera); !status.ok()) return status;
  if (camera.globe != nullptr) {
    const Result<CoarseGlobe> globe = coarseGlobe(decoder, camera.globe);
    if (!globe.ok()) return globe.status();
    return outlookOf(*globe, camera, triangles);
  }
  const Result<CoarseGround> ground = coarseGround(decoder);
  if (!ground.ok()) return ground.status();
  return outlookOf(decoder, *ground, camera, triangles);
}

std::vector<ByteRange> missingIn(const tks_decoder& decoder, ByteRange wanted) {
  if (!decoder.pieces.empty()) return decoder.pieces.missing(wanted);
  wanted.begin = std::max<uint64_t>(wanted.begin, decoder.data.size());
  return wanted.begin < wanted.end ? std::vector{wanted} : std::vector<ByteRange>();
}

Status plan(tks_decoder& decoder, std::span<const WeightedSighting> sightings,
            const tks_fetch& fetch, tks_ranges& out) {
  const auto missing = [&](uint64_t begin, uint64_t end) {
    return missingIn(decoder, {begin, end});
  };
  const auto ranges = planFetch(decoder.parsed, decoder.pages ? &*decoder.pages : nullptr,
                                sightings, missing, {fetch.bytes, fetch.request_bytes});
  if (!ranges.ok()) return ranges.status();
  std::vector<tks_range> planned;
  for (const FetchRange& range : *ranges)
    planned.push_back({range.begin, range.end - range.begin, range.gain});
  giveRanges(planned, out);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_plan(tks_decoder* decoder, const tks_screen_camera* view, const tks_fetch* fetch,
                    tks_ranges* out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  *out = {};
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    if (fetch == nullptr) return {TKS_USAGE, "What to fetch at most is missing."};
    tks_fetch limits{};
    tetrakis::Status status = tetrakis::takeSized("the limits of a plan", *fetch,
                                                  offsetof(tks_fetch, request_bytes), limits);
    if (!status.ok()) return status;
    if (status = tetrakis::checkPlanMemory(*decoder); !status.ok()) return status;
    const auto sightings = tetrakis::sightingsIn(*decoder, view, limits.triangles);
    if (!sightings.ok()) return sightings.status();
    return tetrakis::plan(*decoder, *sightings, limits, *out);
  });
}
