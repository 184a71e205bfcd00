// SPDX-License-Identifier: Apache-2.0
// A receiver of a sequence tells a transmitter by control messages what it wants, what it can take
// and what came, and gets an Answer for each: pieces of the groups of the sequence
// (docs/CONTROL.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::inline sequence {

inline constexpr size_t kMostControlBytes = 100;
/// Answers before the last one that came whose loss a message can tell.
inline constexpr uint32_t kToldAnswers = 32;
inline constexpr uint32_t kMostRate = (1u << 28) - 1;  ///< of links and renderers: 4 bytes

/// What a receiver looks at: the rows of a matrix that give x, y and w of clip coordinates, as the
/// bits of numbers of 32 bits (IEEE 754), which are finite.
struct ControlView {
  uint32_t width = 0, height = 0;  ///< of its picture, in pixels
  std::array<uint32_t, 12> rows{};

  bool operator==(const ControlView&) const = default;
};

struct ControlMessage {
  uint64_t receiver = 0;  ///< a number that it chose
  uint32_t answers = 0;   ///< 1 more than the number of the last answer that came; 0: none came
  uint32_t lost = 0;      ///< bit i: answer (answers - 2 - i) did not come
  uint64_t kept = 0;      ///< first frame that the receiver holds, or will
  std::optional<uint64_t> frame = {};  ///< the first that it wants; none: the newest
  uint32_t link = 1;                   ///< bytes a second
  uint32_t triangles = 0;              ///< of its meshes; 0: any number
  std::optional<ControlView> view = {};

  bool operator==(const ControlMessage&) const = default;
};

std::vector<uint8_t> writeControl(const ControlMessage& message);

/// TKS_CORRUPT, TKS_UNSUPPORTED with a sentence: these bytes are no message, or no lawful one.
Result<ControlMessage> readControl(std::span<const uint8_t> bytes);

/// Bytes of a group: its head and its stream.
struct AnswerPiece {
  uint64_t group = 0;  ///< its number
  uint64_t place = 0;  ///< of the first byte behind the begin of the group
  std::span<const uint8_t> bytes;
};

struct Answer {
  uint32_t number = 0;     ///< from 0 on, to one receiver
  uint64_t end_frame = 0;  ///< the transmitter has the frames before this one
  std::vector<AnswerPiece> pieces;
};

/// The most that a piece takes in an answer beside its bytes.
inline constexpr size_t kMostPieceHead = 5 + 9 + 5;

std::vector<uint8_t> writeAnswer(const Answer& answer);

/// Its pieces lie in `bytes`. TKS_CORRUPT, TKS_UNSUPPORTED with a sentence.
Result<Answer> readAnswer(std::span<const uint8_t> bytes);

}  // namespace tetrakis::inline sequence
