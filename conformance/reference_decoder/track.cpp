// SPDX-License-Identifier: Apache-2.0
// Reference decoder: order of passes, contexts, decisions (docs/FORMAT.md, sections 5 and 6).
#include "conformance/reference_decoder/track.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

enum Kind { kLikely, kRefine, kRest };

/// FORMAT 5, "Models": one set for every class.
struct Models {
  Model significance[11][8], refinement[9], sign[5], block[5], band;
};

struct Pass {
  int key, plane;
  size_t band;
  Kind kind;
};

/// FORMAT 5, "Order of passes".
std::vector<Pass> orderPasses(int planes, const std::vector<Band>& bands) {
  std::vector<Pass> passes;
  for (size_t b = 0; b < bands.size(); ++b) {
    for (int p = 0; p < planes && !bands[b].empty(); ++p) {
      const int key = 16 * p + bands[b].logNorm;
      passes.push_back({key, p, b, kLikely});
      passes.push_back({key - 10, p, b, kRefine});
      passes.push_back({key - 6, p, b, kRest});
    }
  }
  std::sort(passes.begin(), passes.end(), [](const Pass& x, const Pass& y) {
    return std::tuple(-x.key, -x.plane, x.band, x.kind) <
           std::tuple(-y.key, -y.plane, y.band, y.kind);
  });
  return passes;
}

/// FORMAT 5, table of neighbours: two near pairs, then four far ones.
struct Neighbours {
  Coefficient near[4], far[4];
};

Neighbours neighboursOf(const Band& band, int r, int a) {
  const auto c = [&](int row, int column) { return band.get(row, column); };
  if (!band.staggered) {
    return {{c(r, a - 1), c(r, a + 1), c(r - 1, a), c(r + 1, a)},
            {c(r - 1, a - 1), c(r - 1, a + 1), c(r + 1, a - 1), c(r + 1, a + 1)}};
  }
  const int w = r % 2 == 0 ? 0 : -1;
  return {{c(r - 1, a + w), c(r + 1, a + w + 1), c(r - 1, a + w + 1), c(r + 1, a + w)},
          {c(r, a - 1), c(r, a + 1), c(r - 2, a), c(r + 2, a)}};
}

/// FORMAT 6: L(S), "S modulo 2^32".
int activity(const Neighbours& n, int p) {
  uint32_t sum = 0;
  for (const Coefficient& c : n.near) sum += 2 * (c.magnitude >> p);
  for (const Coefficient& c : n.far) sum += c.magnitude >> p;
  if (sum < 5) return static_cast<int>(sum);
  constexpr uint32_t kLast[] = {6, 9, 13, 19, 29};
  int level = 5;
  for (const uint32_t last : kLast) level += sum > last;
  return level;
}

/// Decodes one track. Its functions return false, or nothing, when the track ends.
class TrackDecoder {
 public:
  TrackDecoder(std::span<const uint8_t> codeword, std::vector<Band>& bands)
      : decoder_(codeword), bands_(bands) {}

  /// FORMAT 6, "Band", and the order of blocks.
  bool run(const Pass& pass) {
    Band& band = bands_[pass.band];
    if (!band.marked) {
      if (pass.kind != kRest) return true;
      const std::optional<int> answer = models_[band.modelClass].band.decode(decoder_);
      if (!answer || *answer == 0) return answer.has_value();
      band.marked = true;
    }
    for (int row = 0; row < band.blockRows(); ++row) {
      for (int column = 0; column < band.blockColumns(); ++column) {
        if (!runBlock(pass, band, row, column)) return false;
      }
    }
    return true;
  }

 private:
  /// FORMAT 6, "Block": whether one of its coefficients becomes significant.
  std::optional<int> decodeBlock(const Band& band, int row, int column) {
    if (band.blocks.size() == 1) return 1;
    const int n = band.blockMarked(row, column - 1) + band.blockMarked(row, column + 1) +
                  band.blockMarked(row - 1, column) + band.blockMarked(row + 1, column);
    return models_[band.modelClass].block[n].decode(decoder_);
  }

  bool runBlock(const Pass& pass, Band& band, int row, int column) {
    if (!band.blockMarked(row, column)) {
      if (pass.kind != kRest) return true;
      const std::optional<int> answer = decodeBlock(band, row, column);
      if (!answer || *answer == 0) return answer.has_value();
      band.blocks[row * band.blockColumns() + column] = true;
    }
    for (int r = 8 * row; r < std::min(8 * row + 8, band.rows); ++r) {
      const int end = std::min(32 * column + 32, band.columnsOf(r));
      for (int a = 32 * column; a < end; ++a) {
        if (!visit(pass, band, r, a)) return false;
      }
    }
    return true;
  }

  /// FORMAT 6: which coefficients a pass decides on.
  bool visit(const Pass& pass, Band& band, int r, int a) {
    Coefficient& c = band.at(r, a);
    if (c.plane <= pass.plane || (c.magnitude > 0) != (pass.kind == kRefine)) return true;
    const Neighbours neighbours = neighboursOf(band, r, a);
    const int level = activity(neighbours, pass.plane);
    if (pass.kind == kRefine) return refine(models_[band.modelClass], c, pass.plane, level);
    if (pass.kind == kLikely && level == 0) return true;
    const uint32_t hint = band.hint ? band.hint(bands_, r, a) : 0;
    const int h = std::min(static_cast<int>(std::bit_width(hint >> pass.plane)), 7);
    Models& models = models_[band.modelClass];
    const std::optional<int> significant = models.significance[level][h].decode(decoder_);
    if (!significant) return false;
    if (*significant) {
      const std::optional<int> sign = decodeSign(models, neighbours);
      if (!sign) return false;
      c.magnitude = 1u << pass.plane;
      c.sign = *sign;
    }
    c.plane = pass.plane;
    return true;
  }

  /// FORMAT 6, "Significance": the sign, -1 or 1.
  std::optional<int> decodeSign(Models& models, const Neighbours& n) {
    const int context = 3 * std::clamp(n.near[0].sign + n.near[1].sign, -1, 1) +
                        std::clamp(n.near[2].sign + n.near[3].sign, -1, 1);
    const std::optional<int> bit = models.sign[std::abs(context)].decode(decoder_);
    if (!bit) return bit;
    const bool negative = (*bit == 1) != (context < 0);
    return negative ? -1 : 1;
  }

  /// FORMAT 6, "refine".
  bool refine(Models& models, Coefficient& c, int p, int level) {
    const uint32_t known = c.magnitude >> (p + 1);
    const int context = known == 1 ? level / 2 : known <= 3 ? 6 + (level > 6) : 8;
    const std::optional<int> bit = models.refinement[context].decode(decoder_);
    if (!bit) return false;
    c.magnitude |= static_cast<uint32_t>(*bit) << p;
    c.plane = p;
    return true;
  }

  RangeDecoder decoder_;
  std::vector<Band>& bands_;
  std::map<int, Models> models_;  ///< by class
};

}  // namespace

int32_t Coefficient::value() const {
  if (magnitude == 0) return 0;
  const auto middle = static_cast<uint32_t>(((uint64_t{1} << plane) * 7) >> 4);
  const uint32_t size = magnitude + middle;
  return static_cast<int32_t>(sign < 0 ? 0u - size : size);
}

Band::Band(int rowCount, int evenColumns, int oddColumns, bool isStaggered)
    : rows(rowCount), columns{evenColumns, oddColumns}, staggered(isStaggered) {
  coefficients.resize(size_t(rows) * size_t(widest()));
  blocks.resize(size_t(blockRows()) * size_t(blockColumns()));
}

bool Band::empty() const {
  return rows == 0 || (columns[0] == 0 && (rows == 1 || columns[1] == 0));
}

Coefficient& Band::at(int r, int a) {
  return coefficients[size_t(r) * widest() + a];
}

Coefficient Band::get(int r, int a) const {
  if (r < 0 || r >= rows || a < 0 || a >= columnsOf(r)) return {};
  return coefficients[size_t(r) * widest() + a];
}

bool Band::blockMarked(int row, int column) const {
  if (row < 0 || row >= blockRows() || column < 0 || column >= blockColumns()) return false;
  return blocks[row * blockColumns() + column];
}

bool decodeTrack(std::span<const uint8_t> codeword, int planes, std::vector<Band>& bands) {
  TrackDecoder decoder(codeword, bands);
  for (const Pass& pass : orderPasses(planes, bands)) {
    if (!decoder.run(pass)) return false;
  }
  return true;
}

}  // namespace tetrakis::reference
