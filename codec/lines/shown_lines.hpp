// SPDX-License-Identifier: Apache-2.0
// ShownLines copies repeated columns and rows (bitstream/stream/line_repeats.hpp) into the samples
// of a view, because planes are coded and decoded without them.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/line_repeats.hpp"

namespace tetrakis::inline lines {

class ShownLines {
 public:
  /// For each line of the view (a column, or a row), the line of the coded view that it shows.
  using Lines = std::vector<uint32_t>;

  /// header: of heights or of a texture, with or without repeats. view: of the lines that are
  /// shown.
  ShownLines(const auto& header, const View& view)
      : ShownLines(header.repeats, header.extent(), view) {}
  /// coded: the lines that are coded.
  ShownLines(const LineRepeats& repeats, Extent coded, const View& view);

  /// No line repeats another.
  bool none() const { return none_; }
  /// The view of the coded lines that holds all that the view needs.
  const View& coded() const { return coded_; }
  const Lines& columns() const { return columns_; }
  const Lines& rows() const { return rows_; }

  /// Makes values of coded lines those of the view, `each` of them for a sample; nothing stays
  /// nothing.
  template <class T>
  std::vector<T> shown(std::vector<T> values, uint32_t each = 1) const {
    if (none_ || values.empty()) return values;
    assert(values.size() == coded_extent_.samples() * each);
    std::vector<T> out;
    out.reserve(columns_.size() * rows_.size() * each);
    for (const uint32_t row : rows_) {
      const T* const from = values.data() + size_t{row} * coded_extent_.width * each;
      for (const uint32_t column : columns_) {
        const T* const sample = from + size_t{column} * each;
        out.insert(out.end(), sample, sample + each);
      }
    }
    return out;
  }

 private:
  bool none_;
  View coded_;
  Extent coded_extent_ = {0, 0};  ///< of the coded view
  Lines columns_, rows_;
};

/// The view of the coded lines that holds all that a view of the shown ones needs.
View codedView(const auto& header, const View& view) {
  return ShownLines(header, view).coded();
}

// encodeRepeats() codes the marks of the columns and rows that repeat the one before them, so that
// a header can state them.

/// columns, rows: 1 where a line repeats the one before, 0 for the first.
LineRepeats encodeRepeats(std::vector<uint8_t> columns, std::vector<uint8_t> rows);

}  // namespace tetrakis::inline lines
