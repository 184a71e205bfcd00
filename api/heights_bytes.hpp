// SPDX-License-Identifier: Apache-2.0
// HeightsBytes computes from the header how many bytes of memory it takes to decode a view of the
// heights.
#pragma once

#include <cstdint>

#include "api/plane_bytes.hpp"

namespace tetrakis::inline api {

/// Bytes for a view of the heights of a decoder, which has some.
class HeightsBytes {
 public:
  HeightsBytes(const tks_decoder& decoder, const View& view);

  /// What is left when a level is decoded: heights, marks, masks, corrections.
  uint64_t kept() const;
  /// What decoding takes.
  uint64_t decoding() const;
  /// What decoding the mask alone takes.
  uint64_t validity() const;

 private:
  /// The same heights, of which another view of the coded lines is decoded.
  HeightsBytes(const HeightsBytes& of, const View& lines);

  uint64_t decodingLines() const;
  uint64_t decodingTaken() const;
  uint64_t drawing() const;
  uint64_t wholeMasks() const;
  uint64_t openingMaskBytes() const;
  uint64_t copyBytes() const;
  uint64_t rows() const;
  uint64_t parts() const;
  uint64_t tableBytes() const;
  uint64_t joinedBytes() const;
  uint64_t flatBytes() const;
  uint64_t flatOpeningBytes() const;
  uint64_t low() const;

  const tks_decoder& decoder_;
  const GeometryHeader& header_;
  const GeometryLayers& layers_;
  View view_;
  uint64_t shown_;   ///< samples of the view, of coded lines
  uint64_t copied_;  ///< of the view; 0: no lines are copied
  bool voids_;
  bool flat_;
  bool table_;
  bool corrected_;  ///< corrections, or all samples directly, are decoded
};

}  // namespace tetrakis::inline api
