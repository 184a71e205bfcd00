// SPDX-License-Identifier: Apache-2.0
// An AnswerPlan chooses the pieces of groups that a transmitter sends in one answer: those that
// help the receiver most in the time that they take (thesis 1.2.7, system control).
#pragma once

#include <cstdint>
#include <vector>

#include "api/transmitter.hpp"
#include "bitstream/sequence/control_message.hpp"
#include "ratecontrol/receiver/fetch_plan.hpp"

namespace tetrakis::inline api {

class AnswerPlan {
 public:
  /// sent: takes the pieces. bytes: of the answer, at most. All outlive the plan.
  AnswerPlan(tks_transmitter& transmitter, const ControlMessage& message, SentPieces& sent,
             uint64_t bytes)
      : transmitter_(transmitter), message_(message), sent_(sent), left_(bytes) {}

  /// TKS_CORRUPT, TKS_LIMIT: a group does not open.
  Status choose();

 private:
  /// By what a receiver counts errors of the ground.
  enum class Ground { kSeen, kAll };

  const std::deque<KeptGroup>& groups() const { return transmitter_.sequence.groups; }
  size_t placeWanted() const;
  /// Whether all is there that a group goes on from.
  bool hasChain(size_t place) const;
  size_t endAhead(size_t wanted) const;
  double secondsOf(size_t place) const;
  double secondsBetween(int64_t from, int64_t to) const;
  uint64_t shareOf(size_t place) const;

  Result<KnownGroup*> known(size_t place);
  /// The decoder of the last frame of the group that a group goes on from at first: what takes
  /// long to find changes little behind it, and it is decoded by itself.
  Result<tks_decoder*> decoderOfEntry(size_t place);
  size_t entryOf(size_t place) const;
  /// The bytes of a group's stream that no mesh of the receiver's triangles shows.
  Result<ByteRanges> beyondRenderer(size_t place);
  Result<std::vector<WeightedSighting>> sightings(size_t place, Ground ground);
  /// Adds what is missing of a range of a group, as far as there are bytes left.
  void add(size_t place, ByteRange range);
  /// Adds head and header of a group, and the first bytes of its stream.
  Status require(size_t place, uint64_t stream_bytes);
  /// The bytes of a group that the next one goes on from.
  Status requireBehind(size_t place);
  /// Adds the pieces of a group that help most, of at most `most` bytes.
  Status give(size_t place, uint64_t most, Ground ground);

  tks_transmitter& transmitter_;
  const ControlMessage& message_;
  SentPieces& sent_;
  uint64_t left_;
};

}  // namespace tetrakis::inline api
