// SPDX-License-Identifier: Apache-2.0
// Reference decoder: structures that are lists of parts, and the parts that heights and textures
// share (docs/FORMAT.md, section 2).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "conformance/reference_decoder/reader.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {

/// FORMAT 2, Parts, in the order of their kinds: a decoder asks for those that it knows.
class Parts {
 public:
  explicit Parts(Reader& in) : in_(in) { readNext(); }

  /// Reads the next part, if it is of that kind: read(Reader&), which takes all of it.
  template <class Read>
  bool take(uint64_t kind, Read read) {
    skipBefore(kind);
    if (!next_ || next_->kind != kind) return false;
    Reader body(next_->body);
    read(body);
    if (!body.rest().empty()) body.fail(Outcome::kCorrupt);
    if (body.outcome() == Outcome::kTruncated) in_.fail(Outcome::kCorrupt);
    in_.fail(body.outcome());
    last_ = kind;
    readNext();
    return true;
  }
  /// Passes over the next part, if it is of that kind: parts of any kind may follow.
  void passFirst(uint64_t kind) {
    if (next_ && next_->kind == kind) readNext();
  }
  void end() { skipBefore({}); }

 private:
  struct Part {
    uint64_t kind;
    std::span<const uint8_t> body;
  };

  void readNext() {
    next_.reset();
    if (in_.outcome() != Outcome::kDone || in_.rest().empty()) return;
    const uint64_t kind = in_.varint(0, UINT64_MAX);
    const auto body = in_.take(in_.varint(0, UINT64_MAX));
    if (last_ && kind < *last_) in_.fail(Outcome::kCorrupt);
    if (in_.outcome() == Outcome::kDone) next_ = {kind, body};
  }
  /// A kind stands once, unless it is asked for again; one below 64 that is not asked for is not
  /// known.
  void skipBefore(std::optional<uint64_t> kind) {
    while (next_ && (!kind || next_->kind < *kind)) {
      if (last_ == next_->kind) in_.fail(Outcome::kCorrupt);
      if (next_->kind < 64) in_.fail(Outcome::kUnsupported);
      last_ = next_->kind;
      readNext();
    }
  }

  Reader& in_;
  std::optional<Part> next_;
  std::optional<uint64_t> last_;
};

/// All bytes that are left.
inline std::vector<uint8_t> restOf(Reader& in) {
  const auto rest = in.take(in.rest().size());
  return {rest.begin(), rest.end()};
}

/// FORMAT 2, Wavelet: behind `coding` 2.
template <class Header>
void readWavelet(Reader& in, int coding, Header& c) {
  c.planes = coding == 2 ? in.u8(0, 30) : kDrawnPlanes;
  if (coding != 2) return;
  WaveletHeader& w = c.wavelet;
  for (int& filter : w.filters) filter = in.u8(0, 5);
  w.fractionBits = in.u8(0, 8);
  w.sampleBits = in.u8(0, 32);
  if (w.fractionBits > 0) return;
  w.firstDoubled = in.u8(0, 4);
  w.roundedBytes = in.varint(0, INT64_MAX);
}

/// FORMAT 2, table Priorities.
inline PriorityHeader readPriorities(Reader& in) {
  PriorityHeader priorities;
  priorities.tileLog2 = in.u8(4, 20);
  priorities.code = restOf(in);
  return priorities;
}

/// FORMAT 2, Priorities: "at most 65536 tiles".
template <class Header>
bool hasTooManyTiles(const Header& c) {
  const int log2 = c.priorities.tileLog2;
  if (log2 == 0) return false;
  return (int64_t{(c.width - 1) >> log2} + 1) * (int64_t{(c.height - 1) >> log2} + 1) > 65536;
}

/// FORMAT 2: whether heights and textures may both have this on a forest.
template <class Header>
bool suitsForest(const Header& c) {
  return c.wavelet.domain.forest.isGrid() || c.lines.columns.empty();
}

/// FORMAT 8.3: the size becomes that of the coded lines.
template <class Header>
void readLines(Reader& in, Header& g) {
  const std::vector<uint8_t> code = restOf(in);
  g.lines = LineMap(code, g.width, g.height);
  g.width = g.lines.columns.back() + 1;
  g.height = g.lines.rows.back() + 1;
}

/// FORMAT 2: the first parts of heights and of textures.
template <class Header>
void readCoding(Parts& parts, Header& c) {
  parts.take(1, [&](Reader& p) { readLines(p, c); });
  parts.take(2, [&](Reader& p) { c.priorities = readPriorities(p); });
}

/// FORMAT 2, frames. scaled: of heights.
FramesHeader readFrames(Reader& in, bool scaled);

/// FORMAT 2: whether heights and textures in frames may have what both may have.
template <class Header>
bool suitsFrames(const Header& c) {
  return c.planes != kDrawnPlanes && c.wavelet.domain.forest.isGrid() && c.lines.columns.empty() &&
         c.priorities.tileLog2 == 0;
}

/// FORMAT 2, Heights and Texture: what follows `region_log2` of such a component.
void readHeights(Reader& in, const Domain& domain, RegionHeader regions, Stream& stream);
void readTexture(Reader& in, const Domain& domain, RegionHeader regions, Stream& stream);

}  // namespace tetrakis::reference
