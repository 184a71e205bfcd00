// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/followed_heights.hpp"

#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace tetrakis::inline heights {

namespace {

/// Subtracts the error that the complete tracks leave from their accounts, and returns the sum.
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

/// A single codeword lies at the end of the first track; several are tracks of their own.
std::vector<EncodedTrack> withCorrections(std::vector<EncodedTrack> tracks,
                                          const PartCodewords& corrections, double corrected_to) {
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
  const auto all = static_cast<double>(bytesOf(corrections));
  for (const std::vector<uint8_t>& codeword : corrections) {
    EncodedTrack track{codeword, {}, tracks.front().planes};
    const double share = all > 0 ? static_cast<double>(codeword.size()) / all : 0;
    track.points.push_back({0, rest.distortion * share, false, rest.beyond * share});
    if (!codeword.empty()) track.points.push_back({codeword.size(), corrected_to * share});
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace

CodedHeights followedBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double corrected_to) {
  const uint64_t before = heights.tracks.front().codeword.size();
  layers.coefficient_bytes = before - layers.besideCoefficients();
  heights.layers = std::move(layers);
  heights.tracks = withCorrections(std::move(heights.tracks), corrections, corrected_to);
  heights.correction_bytes = heights.tracks.front().codeword.size() - before;
  return heights;
}

CodedHeights restoredBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double left) {
  assert(left > 0);
  for (RatePoint& point : heights.tracks.front().points) point.distortion += left;
  CodedHeights restored = followedBy(std::move(heights), std::move(layers), corrections, 0);
  restored.left = left;
  return restored;
}

}  // namespace tetrakis::inline heights
