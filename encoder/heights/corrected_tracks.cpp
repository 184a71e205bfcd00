// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/corrected_tracks.hpp"

#include <cassert>
#include <cstdint>
#include <utility>

namespace tetrakis::inline heights {

namespace {

/// Takes what the tracks leave off their accounts, and returns the sum of it.
RatePoint takeRest(std::vector<EncodedTrack>& tracks) {
  RatePoint rest{0, 0};
  for (EncodedTrack& track : tracks) {
    const RatePoint last = track.points.back();
    for (RatePoint& point : track.points) {
      point.distortion -= last.distortion;
      point.beyond -= last.beyond;
    }
    rest.distortion += last.distortion;
    rest.beyond += last.beyond;
  }
  return rest;
}

}  // namespace

std::vector<EncodedTrack> tracksWithCorrections(std::vector<EncodedTrack> tracks,
                                                std::span<const std::vector<uint8_t>> corrections,
                                                double corrected_to) {
  assert(!corrections.empty());
  const RatePoint rest = takeRest(tracks);
  if (corrections.size() == 1) {
    EncodedTrack& first = tracks.front();
    for (RatePoint& point : first.points) {
      point.distortion += rest.distortion;
      point.beyond += rest.beyond;
    }
    first.codeword.insert(first.codeword.end(), corrections[0].begin(), corrections[0].end());
    first.points.push_back({first.codeword.size(), corrected_to});
    return tracks;
  }
  double all = 0;
  for (const auto& codeword : corrections) all += static_cast<double>(codeword.size());
  for (const std::vector<uint8_t>& codeword : corrections) {
    EncodedTrack track{codeword, {}, tracks.front().planes};
    const double share = all > 0 ? static_cast<double>(codeword.size()) / all : 0;
    track.points.push_back({0, rest.distortion * share, false, rest.beyond * share});
    if (!codeword.empty()) track.points.push_back({codeword.size(), corrected_to * share});
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace tetrakis::inline heights
