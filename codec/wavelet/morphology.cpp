// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/morphology.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "base/bit_plane.hpp"

namespace tetrakis::inline wavelet {

namespace {

/// Marks what lies so many bits behind a mark of the line.
void orShifted(std::span<uint64_t> line, uint32_t by) {
  const size_t whole = by / kWordBits;
  const uint32_t rest = by % kWordBits;
  for (size_t k = line.size(); k-- > whole;) {
    line[k] |= line[k - whole] << rest;
    if (rest > 0 && k > whole) line[k] |= line[k - whole - 1] >> (kWordBits - rest);
  }
}

/// Marks spread over a span by doubling: grow(by) marks what lies so far behind a mark.
template <class Grow>
void growTo(uint32_t span, const Grow& grow) {
  for (uint32_t grown = 1; grown < span;) {
    const uint32_t by = std::min(grown, span - grown);
    grow(by);
    grown += by;
  }
}

/// Spreads marks along rows: over all samples within reach of one.
void dilateRows(BitPlane& marks, uint32_t reach) {
  const uint32_t words = marks.words(), behind = reach / kWordBits, rest = reach % kWordBits;
  std::vector<uint64_t> line(words + behind + 2);
  for (uint32_t y = 0; y < marks.extent().height; ++y) {
    uint64_t* const row = marks.row(y);
    if (std::all_of(row, row + words, [](uint64_t word) { return word == 0; })) continue;
    std::fill(std::copy_n(row, words, line.begin()), line.end(), 0);
    growTo(2 * reach + 1, [&](uint32_t by) { orShifted(line, by); });
    for (uint32_t k = 0; k < words; ++k) {
      const uint64_t low = line[k + behind] >> rest;
      const uint64_t high = rest > 0 ? line[k + behind + 1] << (kWordBits - rest) : 0;
      row[k] = (low | high) & marks.existing(k);
    }
  }
}

/// The same along columns, for a strip of words of each row at a time: one that caches hold.
void dilateColumns(BitPlane& marks, uint32_t reach) {
  constexpr uint32_t kStrip = 8;
  const uint32_t height = marks.extent().height;
  std::vector<uint64_t> grown(size_t{kStrip} * (height + reach));
  const auto line = [&](uint32_t y) { return grown.data() + size_t{kStrip} * y; };
  for (uint32_t first = 0; first < marks.words(); first += kStrip) {
    const uint32_t words = std::min(kStrip, marks.words() - first);
    for (uint32_t y = 0; y < height; ++y) std::copy_n(marks.row(y) + first, words, line(y));
    std::fill(line(height), grown.data() + grown.size(), 0);
    growTo(2 * reach + 1, [&](uint32_t by) {
      for (uint32_t y = height + reach; y-- > by;)
        for (uint32_t k = 0; k < kStrip; ++k) line(y)[k] |= line(y - by)[k];
    });
    for (uint32_t y = 0; y < height; ++y) std::copy_n(line(y + reach), words, marks.row(y) + first);
  }
}

void dilate(BitPlane& marks, uint8_t reach) {
  dilateRows(marks, reach);
  dilateColumns(marks, reach);
}

/// A closing is a dilation, then one of what is left unmarked.
void close(BitPlane& marks, uint8_t reach) {
  dilate(marks, reach);
  marks.invert();
  dilate(marks, reach);
  marks.invert();
}

}  // namespace

std::vector<uint8_t> opened(const std::vector<uint8_t>& marks, Extent plane, uint8_t reach) {
  BitPlane bits(marks, plane);
  bits.invert();
  close(bits, reach);
  bits.invert();
  return bits.bytes();
}

BitPlane closed(BitPlane marks, uint8_t reach) {
  close(marks, reach);
  return marks;
}

std::vector<uint8_t> closed(const std::vector<uint8_t>& marks, Extent plane, uint8_t reach) {
  return closed(BitPlane(marks, plane), reach).bytes();
}

SharedBits liftedSamples(const SharedBits& valid, uint8_t reach) {
  if (reach == 0 || valid == nullptr) return valid;
  if (reach == kBridgeAll) return nullptr;
  BitPlane lifted = closed(*valid, reach);
  return lifted.all() ? nullptr : shared(std::move(lifted));
}

std::vector<uint8_t> liftedSamples(const std::vector<uint8_t>& valid, Extent plane, uint8_t reach) {
  if (reach == 0) return valid;
  return shownMarks(liftedSamples(sharedBits(valid, plane), reach), {});
}

}  // namespace tetrakis::inline wavelet
