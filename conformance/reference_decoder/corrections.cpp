// SPDX-License-Identifier: Apache-2.0
// Reference decoder: corrections of steps and of samples (docs/FORMAT.md, section 8.1).
#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 8.1, "Corrections".
class CorrectionDecoder {
 public:
  CorrectionDecoder(std::span<const uint8_t> codeword, const Plane& plane)
      : decoder_(codeword), plane_(plane), models_(32 * 10) {}

  std::vector<uint32_t> decode(const std::vector<int>& hints) {
    std::vector<uint32_t> corrections(plane_.values.size());
    classes_.assign(plane_.values.size(), 0);
    for (int y = 0; y < plane_.height; ++y) {
      for (int x = 0; x < plane_.width; ++x) {
        if (!plane_.isValid(x, y)) continue;
        const size_t i = static_cast<size_t>(y) * plane_.width + x;
        const std::optional<uint32_t> correction = one(hints[i], neighbours(x, y));
        if (!correction) return corrections;
        corrections[i] = *correction;
        const uint32_t magnitude = negative_ ? 0 - *correction : *correction;
        classes_[i] = static_cast<int>(std::bit_width(magnitude));
      }
    }
    return corrections;
  }

 private:
  int classAt(int x, int y) const {
    const bool inside = x >= 0 && x < plane_.width && y >= 0;
    return inside ? classes_[static_cast<size_t>(y) * plane_.width + x] : 0;
  }
  int neighbours(int x, int y) const {
    return 2 * (classAt(x - 1, y) + classAt(x, y - 1)) + classAt(x - 1, y - 1) +
           classAt(x + 1, y - 1);
  }

  std::optional<uint32_t> one(int hint, int sum) {
    const int context = sum < 6 ? sum : std::min(6 + (sum - 6) / 12, 9);
    auto& unary = models_[static_cast<size_t>(hint * 10 + context)];
    negative_ = false;
    int bits = 0;
    for (; bits < 32; ++bits) {
      const std::optional<int> more = unary[static_cast<size_t>(bits)].decode(decoder_);
      if (!more) return std::nullopt;
      if (!*more) break;
    }
    if (bits == 0) return 0;
    uint32_t magnitude = uint32_t{1} << (bits - 1);
    for (int position = bits - 2; position >= 0; --position) {
      const std::optional<int> bit = decoder_.decode(1 << 15);
      if (!bit) return std::nullopt;
      magnitude |= static_cast<uint32_t>(*bit) << position;
    }
    const std::optional<int> sign = decoder_.decode(1 << 15);
    if (!sign) return std::nullopt;
    negative_ = *sign;
    return negative_ ? 0 - magnitude : magnitude;
  }

  RangeDecoder decoder_;
  const Plane& plane_;
  std::vector<std::array<Model, 32>> models_;
  std::vector<int> classes_;
  bool negative_ = false;
};

}  // namespace

std::vector<uint32_t> decodeCorrections(std::span<const uint8_t> codeword, const Plane& plane,
                                        const std::vector<int>& hints) {
  return CorrectionDecoder(codeword, plane).decode(hints);
}

}  // namespace tetrakis::reference
