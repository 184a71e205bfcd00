// SPDX-License-Identifier: Apache-2.0
// Heights of which columns and rows repeat others (bitstream/stream/line_repeats.hpp) are decoded
// without the repeats, and these are copied here into what a view shows.
#pragma once

#include <cstdint>
#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline repeats {

/// The view of the coded lines that holds all that a view of the shown ones needs.
View codedView(const GeometryHeader& header, const View& view);

class ShownLines {
 public:
  /// header: with or without repeats. view: of the lines that are shown.
  ShownLines(const GeometryHeader& header, const View& view);

  const View& coded() const { return coded_; }
  /// Makes a mask of coded lines that of the view; an empty one stays empty.
  std::vector<uint8_t> shown(const std::vector<uint8_t>& mask) const;
  /// Makes heights of coded lines those of the view. A vertex is that of a coded sample where that
  /// is shown first.
  DecodedHeights shown(DecodedHeights decoded) const;

 private:
  /// For each line of the view (a column, or a row), the line of the coded view that it shows.
  using Lines = std::vector<uint32_t>;
  template <class T>
  std::vector<T> copied(const std::vector<T>& values) const;

  bool none_;
  View coded_;
  Extent coded_extent_;  ///< of the coded view
  Lines columns_, rows_;
};

}  // namespace tetrakis::inline repeats
