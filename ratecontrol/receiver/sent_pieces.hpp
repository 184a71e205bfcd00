// SPDX-License-Identifier: Apache-2.0
// SentPieces is what a transmitter knows of one receiver: which bytes of which groups it has or are
// on their way. Bytes whose answer was lost are missing again.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "bitstream/stream/pieces.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline receiver {

/// Ranges of bytes, no two of which touch.
class ByteRanges {
 public:
  void add(ByteRange range);
  void remove(ByteRange range);
  /// What is not among them of a range, in the order of the bytes.
  std::vector<ByteRange> missing(ByteRange wanted) const;
  uint64_t bytes() const;

 private:
  std::map<uint64_t, uint64_t> ends_;  ///< by begins
};

struct SentPiece {
  uint64_t group = 0;
  ByteRange range;  ///< of the group
};

class SentPieces {
 public:
  /// What is missing of a range of a group.
  std::vector<ByteRange> missing(uint64_t group, ByteRange wanted) const;
  uint64_t bytesOf(uint64_t group) const;

  /// Answers are numbered as they are sent, from 0 on.
  uint32_t answers() const { return answers_; }
  /// Adds a piece to the next answer.
  void add(const SentPiece& piece);
  const std::vector<SentPiece>& added() const { return added_; }
  /// Sends what was added. Answers that no message can tell of any more were lost.
  void send();
  /// What a control message says of answers (ControlMessage). TKS_USAGE: it tells of answers that
  /// were not sent, or fewer than before.
  Status hear(uint32_t answers, uint32_t lost);

  /// The receiver does not hold the groups before this one.
  void forgetBefore(uint64_t group);

 private:
  struct UnderWay {
    uint32_t number = 0;
    std::vector<SentPiece> pieces;
  };
  void lose(const UnderWay& answer);

  std::map<uint64_t, ByteRanges> groups_;
  std::vector<SentPiece> added_;
  std::deque<UnderWay> under_way_;  ///< in their order
  uint32_t answers_ = 0, heard_ = 0;
};

}  // namespace tetrakis::inline receiver
