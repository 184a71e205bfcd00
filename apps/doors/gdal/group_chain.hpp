// SPDX-License-Identifier: Apache-2.0
// Groups of a sequence that go on from the ones before them: they decode in a tks_sequence that
// holds all groups from their point of entry on.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "apps/doors/gdal/file_bytes.hpp"
#include "tetrakis/sequence.h"

namespace tetrakis::gdal {

struct CloseSequence {
  void operator()(tks_sequence* sequence) const { tks_sequence_close(sequence); }
};
using SequencePointer = std::unique_ptr<tks_sequence, CloseSequence>;

/// Null where there is not enough memory. limits: of decoders; may be null.
SequencePointer openSequence(const tks_limits* limits);

/// A group that goes on from others, and where it lies in its file.
struct ChainedGroup {
  uint64_t first_frame = 0;
  uint64_t begin = 0, end = 0;
  uint64_t bytes_back = 0;  ///< from its point of entry to its beginning
};

/// Holds the groups from one point of entry on, as far as they were asked for.
class GroupChain {
 public:
  /// end: of the bytes that may be used.
  GroupChain(File file, uint64_t end) : file_(std::move(file)), end_(end) {}

  /// The decoder of a group, which lives until that of another group is asked for. Where groups are
  /// missing the library says what the group lacks.
  tks_status open(const ChainedGroup& group, const tks_limits& limits, tks_decoder** decoder);
  /// Why open() failed.
  const std::string& message() const { return message_; }

 private:
  /// Holds all bytes from a place to another one.
  tks_status hold(uint64_t begin, uint64_t end, const tks_limits& limits);

  File file_;
  uint64_t end_;
  SequencePointer sequence_;
  uint64_t held_begin_ = 0, held_end_ = 0;
  std::string message_;
};

}  // namespace tetrakis::gdal
