// SPDX-License-Identifier: Apache-2.0
// Reference decoder: exact corrections (docs/FORMAT.md, section 8.1).
#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/samples.hpp"

namespace tetrakis::reference {

namespace {

/// The correction of a sample; nothing if a decision does not count.
class ExactCorrections {
 public:
  explicit ExactCorrections(RangeDecoder& decoder)
      : decoder_(decoder), any_(20 * 8), more_(20 * 32), sign_(4 * 8), high_(33) {}

  std::optional<uint32_t> next(int l, int g) {
    int k = 0;
    for (; k < 32; ++k) {
      Model& model =
          k == 0 ? any_[static_cast<size_t>(l * 8 + g)] : more_[static_cast<size_t>(l * 32 + k)];
      const std::optional<int> more = model.decode(decoder_);
      if (!more) return std::nullopt;
      if (!*more) break;
    }
    if (k == 0) return 0;
    const auto negative = sign_[static_cast<size_t>((std::min(k, 4) - 1) * 8 + g)].decode(decoder_);
    if (!negative) return std::nullopt;
    uint32_t magnitude = 1;
    for (int i = 1; i < k; ++i) {
      const std::optional<int> bit =
          i == 1 ? high_[static_cast<size_t>(k)].decode(decoder_) : decoder_.decode(1 << 15);
      if (!bit) return std::nullopt;
      magnitude = 2 * magnitude + static_cast<uint32_t>(*bit);
    }
    return *negative != 0 ? 0 - magnitude : magnitude;
  }

 private:
  RangeDecoder& decoder_;
  std::vector<Model> any_, more_, sign_, high_;
};

int levelOf(int64_t n) {
  const int bits = static_cast<int>(std::bit_width(static_cast<uint64_t>(n)));
  return n < 4 ? bits : std::min(2 * bits - 3 + static_cast<int>(n >> (bits - 2) & 1), 19);
}

}  // namespace

void makeExact(std::span<const uint8_t> codeword, Plane& plane, int f) {
  constexpr int kNeighbours[6][2] = {{-1, 0}, {0, -1}, {-1, -1}, {1, -1}, {-2, 0}, {0, -2}};
  RangeDecoder decoder(codeword);
  ExactCorrections corrections(decoder);
  std::vector<int64_t> errors(plane.values.size(), 0);
  std::array<int64_t, 6> e, w = {};
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      int64_t p = 1 << 15, squares = 64;
      for (size_t i = 0; i < 6; ++i) {
        const int nx = x + kNeighbours[i][0], ny = y + kNeighbours[i][1];
        const bool inside = nx >= 0 && nx < plane.width && ny >= 0;
        e[i] = inside ? errors[static_cast<size_t>(ny) * plane.width + nx] : 0;
        p += w[i] * e[i];
        squares += e[i] * e[i];
      }
      p >>= 16;
      int32_t& v = plane.values[static_cast<size_t>(y) * plane.width + x];
      const auto u = static_cast<int32_t>(v + p);
      const int32_t r = stepOf(u, f);
      const int64_t b = u - (int64_t{r} << f);
      const int g = static_cast<int>(std::min<int64_t>((std::abs(b) * 16) >> f, 7));
      const int l =
          levelOf(2 * (std::abs(e[0]) + std::abs(e[1])) + std::abs(e[2]) + std::abs(e[3]));
      const std::optional<uint32_t> c = corrections.next(l, g);
      if (!c) return;
      const uint32_t q = b < 0 ? static_cast<uint32_t>(r) - *c : static_cast<uint32_t>(r) + *c;
      const auto whole = static_cast<int32_t>(q << f);
      const int64_t error = std::clamp<int64_t>(int64_t{whole} - v, -(1 << 15), 1 << 15);
      errors[static_cast<size_t>(y) * plane.width + x] = error;
      const int64_t d = (error - p) * (1 << 12) / squares;
      for (size_t i = 0; i < 6; ++i)
        w[i] = std::clamp<int64_t>(w[i] + ((d * e[i]) >> 4), -(1 << 18), 1 << 18);
      v = whole;
    }
  }
}

}  // namespace tetrakis::reference
