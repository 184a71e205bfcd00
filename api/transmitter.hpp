// SPDX-License-Identifier: Apache-2.0
// A tks_transmitter holds a sequence, and notes which pieces of it each receiver has. An AnswerPlan
// (answer_plan.hpp) chooses the pieces of an answer.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "api/sequence.hpp"
#include "ratecontrol/receiver/ground_sight.hpp"
#include "ratecontrol/receiver/sent_pieces.hpp"
#include "tetrakis/transmit.h"

namespace tetrakis::inline api {

/// Facts of a group that plans need and that take time to find.
struct KnownGroup {
  ParsedHeader parsed;
  std::optional<CoarseGround> ground = {};  ///< of the last frame
  /// How far meshes of it are from it, by their numbers of triangles: powers of two.
  std::map<uint32_t, double> mesh_errors = {};
};

/// A receiver, as a transmitter knows it.
struct KnownReceiver {
  SentPieces sent;
  uint64_t last_turn = 0;  ///< when it was heard
};

}  // namespace tetrakis::inline api

struct tks_transmitter {
  tks_sequence sequence;
  double seconds = 0.5;
  uint64_t answer_bytes = uint64_t{1} << 20;
  uint32_t most_receivers = 64;
  std::map<uint64_t, tetrakis::KnownReceiver> receivers;  ///< by their numbers
  uint64_t turn = 0;                                      ///< messages that were answered
  std::map<uint64_t, tetrakis::KnownGroup> known;         ///< by the numbers of groups
};
