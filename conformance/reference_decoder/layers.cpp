// SPDX-License-Identifier: Apache-2.0
// Reference decoder: validity and corrections (docs/FORMAT.md, section 7.1).
#include "conformance/reference_decoder/layers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 7.1, "Validity".
class ValidityDecoder {
 public:
  ValidityDecoder(std::span<const uint8_t> codeword, int width, int height)
      : decoder_(codeword), grid_{width, height, std::vector<int32_t>(size_t(width) * height)} {}

  std::vector<uint8_t> decode(const Lattice& lattice) {
    for (size_t i = 0; i < lattice.places.size(); ++i)
      decodeBand(lattice.places[i], lattice.bands[i]);
    return {grid_.values.begin(), grid_.values.end()};
  }

 private:
  void decodeBand(const LatticeBand& band, const Band& shape) {
    for (int r = 0; r < shape.rows; ++r) {
      for (int a = 0; a < shape.columnsOf(r); ++a) decide(band, band.x(r, a), band.y(r));
    }
  }

  void decide(const LatticeBand& band, int x, int y) {
    if (band.shape == kRoots) {
      grid_.at(x, y) = next(root_, 1);
      return;
    }
    int near = 0, nearCount = 0, there = 0, ring = 0;
    const std::vector<Tap> taps = tapsOf(band);
    for (int t = 0; t < 12; ++t) {
      Tap tap = taps[static_cast<size_t>(t)];
      if (!mirror(x, grid_.width, tap.dx) || !mirror(y, grid_.height, tap.dy)) continue;
      const int v = grid_.at(x + tap.dx, y + tap.dy);
      if (t < 4) {
        near |= v << t;
        nearCount += v;
        ++there;
      } else {
        ring += v;
      }
    }
    const int majority = 2 * nearCount >= there, s = band.step;
    const auto before = [&](int dx, int dy) {
      const bool inside = x + dx >= 0 && x + dx < grid_.width && y + dy >= 0;
      return inside ? grid_.at(x + dx, y + dy) : majority;
    };
    const bool centre = band.shape == kCentres;
    const int first = centre ? before(-2 * s, 0) : before(-s, -s);
    const int second = centre ? before(0, -2 * s) : before(s, -s);
    constexpr int kClass[] = {0, 1, 1, 2, 2, 2, 3, 3, 4};
    const int context = (near * 4 + 2 * first + second) * 5 + kClass[ring];
    grid_.at(x, y) = next(models_[centre][static_cast<size_t>(context)], majority);
  }

  int next(Model& model, int otherwise) {
    if (ended_) return otherwise;
    const std::optional<int> bit = model.decode(decoder_);
    ended_ = !bit;
    return bit.value_or(otherwise);
  }

  RangeDecoder decoder_;
  Grid grid_;
  bool ended_ = false;
  Model root_;
  std::array<std::array<Model, 320>, 2> models_;
};

/// FORMAT 7.1, "Corrections".
class CorrectionDecoder {
 public:
  CorrectionDecoder(std::span<const uint8_t> codeword, const Grid& grid)
      : decoder_(codeword), grid_(grid), models_(32 * 10) {}

  std::vector<uint32_t> decode(const std::vector<int>& hints) {
    std::vector<uint32_t> corrections(grid_.values.size());
    classes_.assign(grid_.values.size(), 0);
    for (int y = 0; y < grid_.height; ++y) {
      for (int x = 0; x < grid_.width; ++x) {
        if (!grid_.isValid(x, y)) continue;
        const size_t i = static_cast<size_t>(y) * grid_.width + x;
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
    const bool inside = x >= 0 && x < grid_.width && y >= 0;
    return inside ? classes_[static_cast<size_t>(y) * grid_.width + x] : 0;
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
  const Grid& grid_;
  std::vector<std::array<Model, 32>> models_;
  std::vector<int> classes_;
  bool negative_ = false;
};

}  // namespace

std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, int width, int height,
                                    const Lattice& lattice) {
  return ValidityDecoder(codeword, width, height).decode(lattice);
}

std::vector<uint32_t> decodeCorrections(std::span<const uint8_t> codeword, const Grid& grid,
                                        const std::vector<int>& hints) {
  return CorrectionDecoder(codeword, grid).decode(hints);
}

}  // namespace tetrakis::reference
