// SPDX-License-Identifier: Apache-2.0
// Reference decoder: order of passes and their decisions (docs/FORMAT.md, sections 5 and 6).
#include "conformance/reference_decoder/track.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <iterator>
#include <map>
#include <tuple>

#include "conformance/reference_decoder/activity.hpp"
#include "conformance/reference_decoder/models.hpp"

namespace tetrakis::reference {
namespace {

enum Kind { kLikely, kRest, kRefine };

struct Pass {
  int key, plane;
  size_t band;
  int priority;
  Kind kind;
};

/// FORMAT 5, "Order of passes".
class PassOrder {
 public:
  PassOrder(int planes, const std::vector<Band>& bands) : bands_(bands) {
    for (size_t b = 0; b < bands.size() && planes > 0; ++b) {
      for (int priority = 0; priority < 8; ++priority) {
        if (bands[b].existing(priority) > 0) makePending({0, planes - 1, b, priority, kLikely});
      }
    }
  }

  bool neededPending() const {
    return std::any_of(pending_.begin(), pending_.end(),
                       [&](const Pass& p) { return bands_[p.band].needed; });
  }

  Pass next() const {
    return *std::min_element(pending_.begin(), pending_.end(), [](const Pass& x, const Pass& y) {
      return std::tuple(-x.key, -x.plane, x.band, -x.priority, x.kind) <
             std::tuple(-y.key, -y.plane, y.band, -y.priority, y.kind);
    });
  }

  void hasRun(const Pass& pass) {
    const auto same = [&](const Pass& p) {
      return p.band == pass.band && p.priority == pass.priority;
    };
    pending_.erase(std::find_if(pending_.begin(), pending_.end(),
                                [&](const Pass& p) { return same(p) && p.kind == pass.kind; }));
    if (pass.kind == kLikely) {
      makePending({0, pass.plane, pass.band, pass.priority, kRest});
      makePending({0, pass.plane, pass.band, pass.priority, kRefine});
    } else if (pass.plane > 0 && std::none_of(pending_.begin(), pending_.end(), same)) {
      makePending({0, pass.plane - 1, pass.band, pass.priority, kLikely});
    }
  }

 private:
  /// The key of the pass is not known yet.
  void makePending(Pass pass) {
    constexpr int kLikelyDelay[] = {0, 1, 2, 2, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4};
    constexpr int kRestDelay[] = {6, 6, 7, 8, 8, 9, 10, 10, 11, 12, 14, 14, 15, 16, 16};
    const Band& band = bands_[pass.band];
    uint32_t significant = 0;
    for (const Coefficient& c : band.coefficients)
      significant += c.priority == pass.priority && c.magnitude > 0;
    const uint32_t existing = band.existing(pass.priority);
    const int d = std::min<int>(std::bit_width(existing / std::max(1u, significant)), 15);
    const int delay = pass.kind == kRefine   ? 12
                      : pass.kind == kLikely ? kLikelyDelay[d - 1]
                                             : kRestDelay[d - 1];
    pass.key = 16 * (pass.plane + pass.priority) + band.logNorm - delay;
    if (band.leastKey) pass.key = std::max(pass.key, 16 * pass.priority + *band.leastKey);
    pending_.push_back(pass);
  }

  const std::vector<Band>& bands_;
  std::vector<Pass> pending_;
};

/// Decodes one track.
class TrackDecoder {
 public:
  TrackDecoder(std::span<const uint8_t> codeword, std::vector<Band>& bands)
      : decoder_(codeword), bands_(bands) {}

  /// FORMAT 6, "Band", and the order of blocks.
  void run(const Pass& pass) {
    pass_ = pass;
    Band& band = bands_.at(pass.band);
    if (!band.marked.at(pass.priority)) {
      if (pass.kind != kRest) return;
      if (models().band.decode(decoder_) == 0) {
        for (Coefficient& c : band.coefficients) {
          if (c.priority == pass.priority) c.plane = pass.plane;
        }
        return;
      }
      band.marked.at(pass.priority) = true;
    }
    for (int row = 0; row < band.blockRows(); ++row) {
      for (int column = 0; column < band.blockColumns(); ++column) runBlock(row, column);
    }
  }

 private:
  Band& band() { return bands_[pass_.band]; }
  Models& models() { return models_[band().modelClass]; }

  /// FORMAT 6, "Block": whether one of its coefficients becomes significant.
  int decodeBlock(int row, int column) {
    const Band& b = band();
    if (b.blocks.size() == 1) return 1;
    if (!existsIn(row, column)) return 0;
    const int n = b.blockMarked(row, column - 1) + b.blockMarked(row, column + 1) +
                  b.blockMarked(row - 1, column) + b.blockMarked(row + 1, column);
    return models().block[n].decode(decoder_);
  }

  bool existsIn(int blockRow, int blockColumn) {
    for (int r = 8 * blockRow; r < std::min(8 * blockRow + 8, band().rows); ++r) {
      for (int a = 32 * blockColumn; a < std::min(32 * blockColumn + 32, band().columns); ++a) {
        const Coefficient& c = band().at(r, a);
        if (!c.absent && c.priority == pass_.priority) return true;
      }
    }
    return false;
  }

  void runBlock(int row, int column) {
    int answer = 1;
    auto& marked = band().blocks.at(size_t(row) * band().blockColumns() + column);
    if (!marked.at(pass_.priority)) {
      if (pass_.kind != kRest) return;
      answer = decodeBlock(row, column);
      if (answer) marked.at(pass_.priority) = true;
    }
    const int rowEnd = std::min(8 * row + 8, band().rows);
    const int columnEnd = std::min(32 * column + 32, band().columns);
    for (int r = 8 * row; r < rowEnd; ++r) {
      for (int a = 32 * column; a < columnEnd; ++a) {
        Coefficient& c = band().at(r, a);
        if (answer) visit(r, a);
        if (!answer && c.priority == pass_.priority) c.plane = pass_.plane;
      }
    }
  }

  /// FORMAT 6: which coefficients a pass decides on.
  void visit(int r, int a) {
    const Coefficient& c = band().at(r, a);
    if (!isOpen(c) || (c.magnitude > 0) != (pass_.kind == kRefine)) return;
    if (pass_.kind == kRefine) return refine(r, a);
    if (pass_.kind == kLikely && isQuiet(r, a)) return;
    return pass_.kind == kRest && isGroup(r, a) ? decodeGroup(r, a) : decodeSignificance(r, a);
  }

  /// FORMAT 6, "open" and "quiet".
  bool isOpen(const Coefficient& c) const {
    return !c.absent && c.priority == pass_.priority && c.plane > pass_.plane;
  }
  bool isQuiet(int r, int a) {
    const Neighbours n = band().neighboursOf(r, a);
    const auto significant = [](const Coefficient& c) { return c.magnitude > 0; };
    return std::none_of(std::begin(n.along), std::end(n.along), significant) &&
           std::none_of(std::begin(n.across), std::end(n.across), significant) &&
           std::none_of(std::begin(n.far), std::end(n.far), significant);
  }

  int levelAt(int r, int a) { return activity(band().neighboursOf(r, a), pass_.plane); }

  /// FORMAT 6, "rest": whether four columns are decoded together.
  bool isGroup(int r, int a) {
    if (a % 4 != 0 || a + 4 > band().columns) return false;
    for (int i = a; i < a + 4; ++i) {
      const Coefficient& c = band().at(r, i);
      if (!isOpen(c) || c.magnitude > 0 || !isQuiet(r, i)) return false;
    }
    return true;
  }

  /// FORMAT 6, h(m).
  int hintClass(uint32_t m) const {
    return std::min(static_cast<int>(std::bit_width(m >> pass_.plane)), 7);
  }
  uint32_t magnitudeIn(size_t index, int r, int a) const {
    return index == Band::kNone ? 0 : bands_.at(index).get(r, a).magnitude;
  }

  /// FORMAT 6, m of a coefficient.
  uint32_t sumOfHints(int r, int a) {
    uint32_t m = magnitudeIn(band().parent, r / 2, a / 2) + magnitudeIn(band().companion, r, a);
    for (const size_t sibling : band().siblings) m += magnitudeIn(sibling, r, a);
    return m;
  }

  /// FORMAT 6, m of a group.
  uint32_t bitsOfHints(int r, int a) {
    uint32_t m =
        magnitudeIn(band().parent, r / 2, a / 2) | magnitudeIn(band().parent, r / 2, a / 2 + 1);
    for (int i = a; i < a + 4; ++i) {
      m |= magnitudeIn(band().companion, r, i);
      for (const size_t sibling : band().siblings) m |= magnitudeIn(sibling, r, i);
    }
    return 2 * m;
  }

  /// FORMAT 6, "rest": 0, 1 or 2, by how far the nearest significant coefficient is.
  int reachOf(int r, int a) {
    for (int reach = 0; reach < 2; ++reach) {
      const int distance = reach + 2;
      for (int y = r - distance; y <= r + distance; ++y) {
        for (int x = a - distance; x < a + 4 + distance; ++x) {
          if (band().get(y, x).magnitude > 0) return reach;
        }
      }
    }
    return 2;
  }

  void decodeGroup(int r, int a) {
    Model& model = models().group[reachOf(r, a)][hintClass(bitsOfHints(r, a))];
    int zeros = 4;
    if (model.decode(decoder_)) {
      const int high = models().place[0].decode(decoder_);
      zeros = 2 * high + models().place[1 + high].decode(decoder_);
      becomeSignificant(r, a + zeros);
    }
    for (int i = 0; i < zeros; ++i) band().at(r, a + i).plane = pass_.plane;
  }

  void decodeSignificance(int r, int a) {
    Model& model = models().significance[levelAt(r, a)][hintClass(sumOfHints(r, a))];
    if (model.decode(decoder_)) return becomeSignificant(r, a);
    band().at(r, a).plane = pass_.plane;
  }

  /// FORMAT 6, "Sign".
  void becomeSignificant(int r, int a) {
    const Neighbours n = band().neighboursOf(r, a);
    const int context = 3 * std::clamp(n.along[0].sign + n.along[1].sign, -1, 1) +
                        std::clamp(n.across[0].sign + n.across[1].sign, -1, 1);
    const int bit = models().sign[std::abs(context)].decode(decoder_);
    const bool negative = (bit == 1) != (context < 0);
    band().at(r, a) = {1u << pass_.plane, negative ? -1 : 1, pass_.plane, pass_.priority};
  }

  /// FORMAT 6, "refine".
  void refine(int r, int a) {
    Coefficient& c = band().at(r, a);
    const uint32_t known = c.magnitude >> (pass_.plane + 1);
    const int level = levelAt(r, a);
    const int context = known == 1 ? level / 2 : known <= 3 ? 6 + (level > 6) : 8;
    const int bit = models().refinement[context].decode(decoder_);
    c.magnitude |= static_cast<uint32_t>(bit) << pass_.plane;
    c.plane = pass_.plane;
  }

  RangeDecoder decoder_;
  std::vector<Band>& bands_;
  std::map<int, Models> models_;  ///< by class
  Pass pass_ = {};
};

}  // namespace

void decodeTrack(std::span<const uint8_t> codeword, int planes, std::vector<Band>& bands) {
  for (Band& band : bands) {
    for (Coefficient& c : band.coefficients) c.plane = planes;
  }
  TrackDecoder decoder(codeword, bands);
  PassOrder passes(planes, bands);
  try {
    while (passes.neededPending()) {
      const Pass pass = passes.next();
      decoder.run(pass);
      passes.hasRun(pass);
    }
  } catch (Undecided) {
  }
}

}  // namespace tetrakis::reference
