// SPDX-License-Identifier: Apache-2.0
// Reference decoder: one correction after the other (docs/FORMAT.md, section 8.1).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// FORMAT 8.1, "Corrections".
class CorrectionDecoder {
 public:
  CorrectionDecoder(RangeDecoder& decoder, const Plane& plane)
      : decoder_(decoder), plane_(plane), any_(32 * 6 * 41), unary_(32 * 10 * 32) {
    corrections_.assign(plane_.values.size(), 0);
  }

  /// The correction of the next valid sample.
  uint32_t next(int hint, int x, int y) {
    return corrections_[static_cast<size_t>(y) * plane_.width + x] = one(hint, x, y);
  }

 private:
  int32_t at(int x, int y) const {
    const bool inside = x >= 0 && x < plane_.width && y >= 0;
    return inside ? static_cast<int32_t>(corrections_[static_cast<size_t>(y) * plane_.width + x])
                  : 0;
  }
  int classAt(int x, int y) const {
    const auto c = static_cast<uint32_t>(at(x, y));
    return static_cast<int>(std::bit_width(at(x, y) < 0 ? 0 - c : c));
  }
  int signAt(int x, int y) const { return (at(x, y) > 0) - (at(x, y) < 0); }

  uint32_t one(int hint, int x, int y) {
    const int n = 2 * classAt(x - 1, y) + 2 * classAt(x, y - 1) + classAt(x - 1, y - 1) +
                  classAt(x + 1, y - 1);
    const int m = n < 6 ? n : std::min(6 + (n - 6) / 12, 9);
    const int t = 27 * signAt(x - 1, y) + 9 * signAt(x, y - 1) + 3 * signAt(x - 1, y - 1) +
                  signAt(x + 1, y - 1);
    const int bits = ones(32, [&](int i) {
      Model& model = i == 0 && m < 6 ? any_[static_cast<size_t>((hint * 6 + m) * 41 + std::abs(t))]
                                     : unary_[static_cast<size_t>((hint * 10 + m) * 32 + i)];
      return model.decode(decoder_);
    });
    if (bits == 0) return 0;
    const int sign = sign_[static_cast<size_t>(std::abs(t))].decode(decoder_);
    const uint32_t magnitude = digits(decoder_, bits, high_);
    return (sign != 0) != (t < 0) ? 0 - magnitude : magnitude;
  }

  RangeDecoder& decoder_;
  const Plane& plane_;
  std::vector<Model> any_, unary_;
  std::array<Model, 41> sign_;
  std::array<Model, 33> high_;
  std::vector<uint32_t> corrections_;
};

}  // namespace tetrakis::reference
