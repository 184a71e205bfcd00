// SPDX-License-Identifier: Apache-2.0
// LineRepeats maps the columns and rows of a plane that repeat the one before them, as they do in
// planes that were enlarged by copying samples. Repeated lines are not coded, and decoders copy
// them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline stream {

/// Says which lines of a plane are coded, where these are fewer than the ones that are shown.
struct LineRepeats {
  Extent shown = {0, 0};  ///< lines of the plane; 0: no map, all lines are coded
  std::string code;       ///< of the map

  bool none() const { return shown.width == 0; }
};

/// Coding of the map, line by line: whether it repeats the one before. A run is a line and its
/// repeats; runs have the length of the last one, or of the one before that. Io:
/// bitstream/coder/range_decoder.hpp, range_encoder.hpp.
template <class Io>
class RepeatPass {
 public:
  explicit RepeatPass(Io& io) : io_(io) {}

  /// repeats: of the lines of one side, of the decoder as many zeros. It fills them up to the first
  /// decision that does not count.
  void run(std::span<uint8_t> repeats) {
    size_t run = 1, last = 0, before = 0;
    for (size_t i = 1; i < repeats.size(); ++i) {
      const size_t context = 3 * order(run, last) + order(run, before);
      const bool repeated = io_.decide(repeated_[context], repeats[i] != 0);
      if (io_.stopped()) return;
      repeats[i] = repeated;
      if (repeated) {
        ++run;
      } else {
        before = last;
        last = run;
        run = 1;
      }
    }
  }

 private:
  /// 0 less, 1 equal, 2 greater.
  static size_t order(size_t a, size_t b) { return size_t{a > b} + size_t{a >= b}; }

  Io& io_;
  std::array<AdaptiveBit, 9> repeated_;
};

/// The coded line that each line of a side shows.
struct LineMaps {
  std::vector<uint32_t> columns, rows;

  Extent coded() const { return {columns.back() + 1, rows.back() + 1}; }
};

/// The map that a header describes. Safe on any code.
LineMaps lineMapsOf(const LineRepeats& repeats);

/// The part of a header that says which lines of the plane that is shown are coded. Returns how
/// many are.
template <class V>
Extent visitLines(V& v, uint64_t kind, Extent shown, LineRepeats& repeats) {
  if (!v.part(kind, !repeats.none(), [&](auto& part) { part.rest(repeats.code); })) return shown;
  repeats.shown = shown;
  return lineMapsOf(repeats).coded();
}

}  // namespace tetrakis::inline stream
