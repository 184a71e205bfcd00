// SPDX-License-Identifier: Apache-2.0
// Reference decoder: drawn textures (docs/FORMAT.md, section 9.1).
#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {
namespace {

struct Offset {
  int x, y;
};

using Colour = std::array<int, 4>;

/// Thrown away with the vertex: the decision that was asked for does not count.
struct TrackEnd {};

struct Candidate {
  int index;
  uint32_t pattern = 0;

  int near() const { return std::popcount(pattern & 15); }
  int causal() const { return std::popcount(pattern >> 4 & 3); }
  int ring() const { return std::popcount(pattern >> 6); }
  int votes() const { return 6 * near() + 4 * causal() + ring(); }
};

class DrawnDecoder {
 public:
  DrawnDecoder(const TextureHeader& header, std::span<const uint8_t> codeword)
      : header_(header),
        half_(header.sample == kU8 ? 128 : 32768),
        decoder_(codeword),
        indices_(static_cast<size_t>(header.width) * header.height, -1),
        pair_(1 << 18),
        single_(1 << 16),
        plain_(1 << 12),
        rival_(1 << 18),
        pattern_(6 << 14) {}

  /// FORMAT 9.2: the list begins with grey, which is what is seen through.
  std::vector<std::optional<Colour>> decodeOverlay() {
    colours_.push_back({half_, half_, half_, half_});
    decodeIndices();
    std::vector<std::optional<Colour>> texels;
    for (const int index : indices_) {
      texels.push_back(index > 0 ? std::optional(colours_[static_cast<size_t>(index)])
                                 : std::nullopt);
    }
    return texels;
  }

  std::vector<Colour> decode() {
    decodeIndices();
    std::vector<Colour> texels(indices_.size());
    forEachVertex([&](bool centre, int s, int x, int y) {
      const int index = indices_[at(x, y)];
      texels[at(x, y)] =
          index >= 0 ? colours_[static_cast<size_t>(index)] : meanOf(texels, centre, s, x, y);
    });
    return texels;
  }

 private:
  void decodeIndices() {
    try {
      forEachVertex([&](bool centre, int s, int x, int y) {
        const std::vector<Candidate> candidates = candidatesOf(centre, s, x, y);
        indices_[at(x, y)] = next(candidates, centre);
      });
    } catch (TrackEnd) {
    }
  }

  bool inside(int x, int y) const {
    return x >= 0 && x < header_.width && y >= 0 && y < header_.height;
  }
  size_t at(int x, int y) const { return static_cast<size_t>(y) * header_.width + x; }

  /// FORMAT 8.1, the order of the vertices; s = 0 for roots.
  template <class Visit>
  void forEachVertex(Visit visit) const {
    int root = 1;
    while (root < std::max(header_.width, header_.height) - 1) root *= 2;
    for (int y = 0; y < header_.height; y += root) {
      for (int x = 0; x < header_.width; x += root) visit(false, 0, x, y);
    }
    for (int s = root / 2; s >= 1; s /= 2) {
      for (int y = s; y < header_.height; y += 2 * s) {
        for (int x = s; x < header_.width; x += 2 * s) visit(true, s, x, y);
      }
      for (int y = 0; y < header_.height; y += s) {
        for (int x = y / s % 2 == 0 ? s : 0; x < header_.width; x += 2 * s) visit(false, s, x, y);
      }
    }
  }

  /// The i-th of the twelve offsets of FORMAT 8.1.
  static Offset coarser(bool centre, int s, int i) {
    constexpr Offset kFirst[] = {{1, 0}, {2, 1}, {1, 2}};
    Offset o = kFirst[i / 4];
    for (int turn = 0; turn < i % 4; ++turn) o = {-o.y, o.x};
    if (centre) o = {o.x - o.y, o.x + o.y};
    return {s * o.x, s * o.y};
  }

  std::vector<Candidate> candidatesOf(bool centre, int s, int x, int y) const {
    std::vector<Candidate> found;
    uint32_t bit = 1;
    const auto meet = [&](Offset o) {
      if (inside(x + o.x, y + o.y)) {
        const int index = indices_[at(x + o.x, y + o.y)];
        auto same = std::find_if(found.begin(), found.end(),
                                 [&](const Candidate& c) { return c.index == index; });
        if (same == found.end()) same = found.insert(found.end(), Candidate{index});
        same->pattern |= bit;
      }
      bit *= 2;
    };
    if (s == 0) return found;
    for (int i = 0; i < 4; ++i) meet(coarser(centre, s, i));
    meet(centre ? Offset{-2 * s, 0} : Offset{-s, -s});
    meet(centre ? Offset{0, -2 * s} : Offset{s, -s});
    for (int i = 4; i < 12; ++i) meet(coarser(centre, s, i));
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.votes() > b.votes(); });
    return found;
  }

  int next(const std::vector<Candidate>& candidates, bool centre) {
    const int n = static_cast<int>(candidates.size());
    for (int i = 0; i < std::min(n, 3); ++i) {
      const Candidate& c = candidates[static_cast<size_t>(i)];
      int more = 0;
      if (i == 0 && n > 1) more = std::min(candidates[1].near(), 3);
      if (i == 1) more = std::min(n, 4) - 1;
      const int count =
          ((((i * 4 + more) * 5 + c.near()) * 3 + c.causal()) * 9 + c.ring()) * 2 + centre;
      const uint32_t pattern = static_cast<uint32_t>(2 * i + centre) * 16384 + c.pattern;
      const uint32_t rival = n > 1 ? candidates[i == 0 ? 1 : 0].pattern % 64 : 0;
      if (decide({&rival_[hash(64 * pattern + rival, 18)], &pattern_[pattern],
                  &count_.at(static_cast<size_t>(count))})) {
        return c.index;
      }
    }
    if (colours_.empty() || (colours_.size() < 4096 && decide(fresh_))) {
      colours_.push_back(newColour(candidates));
      return static_cast<int>(colours_.size()) - 1;
    }
    return listed(candidates);
  }

  int listed(const std::vector<Candidate>& candidates) {
    const uint32_t k1 = candidates.empty() ? 4096 : candidates[0].index;
    const uint32_t k2 = candidates.size() < 2 ? 4096 : candidates[1].index;
    uint32_t node = 1;
    while (node < 4096) {
      const int bit = decide({&pair_[hash((k1 * 4099 + k2) * 4099 + node, 18)],
                              &single_[hash(k1 * 4099 + node, 16)], &plain_[node]});
      node = 2 * node + bit;
    }
    return std::min(static_cast<int>(node) - 4096, static_cast<int>(colours_.size()) - 1);
  }

  Colour newColour(const std::vector<Candidate>& candidates) {
    Colour colour = {};
    int carried = 0;
    for (int c = 0; c < header_.channels; ++c) {
      int mean = half_;
      if (!candidates.empty()) {
        const Candidate& second = candidates[candidates.size() > 1];
        mean = (colours_[static_cast<size_t>(candidates[0].index)][c] +
                colours_[static_cast<size_t>(second.index)][c]) /
               2;
      }
      const int expected = std::clamp(mean + carried, 0, 2 * half_ - 1);
      colour[c] = std::clamp(expected + residual(c), 0, 2 * half_ - 1);
      carried = colour[c] - mean;
    }
    return colour;
  }

  int residual(int channel) {
    int size = 0;
    while (size < 17 && decide(residual_[channel][size])) ++size;
    if (size == 0) return 0;
    int magnitude = 1;
    for (int i = 1; i < size; ++i) magnitude = 2 * magnitude + even();
    return even() ? -magnitude : magnitude;
  }

  /// FORMAT 9.1, "Fill".
  Colour meanOf(const std::vector<Colour>& texels, bool centre, int s, int x, int y) const {
    if (s == 0) return {half_, half_, half_, half_};
    Colour sum = {};
    int k = 0;
    for (int i = 0; i < 4; ++i) {
      const Offset o = coarser(centre, s, i);
      if (!inside(x + o.x, y + o.y)) continue;
      for (size_t c = 0; c < 4; ++c) sum[c] += texels[at(x + o.x, y + o.y)][c];
      ++k;
    }
    for (int& v : sum) v = (v + k / 2) / k;
    return sum;
  }

  /// FORMAT 9.1: "The first of three models".
  int decide(const std::array<Model*, 3>& models) {
    Model* asked = models[2];
    if (models[1]->seen() >= 2) asked = models[1];
    if (models[0]->seen() >= 2) asked = models[0];
    const int bit = decide(*asked);
    for (Model* model : models) {
      if (model != asked) model->learn(bit);
    }
    return bit;
  }
  static uint32_t hash(uint32_t context, int bits) {
    return (context * 2654435761u) >> (32 - bits);
  }

  int decide(Model& model) { return counted(model.decode(decoder_)); }
  int even() { return counted(decoder_.decode(0x8000)); }
  static int counted(std::optional<int> bit) {
    if (!bit) throw TrackEnd{};
    return *bit;
  }

  const TextureHeader& header_;
  int half_;
  RangeDecoder decoder_;
  std::vector<int> indices_;
  std::vector<Colour> colours_;
  std::array<Model, 3 * 4 * 5 * 3 * 9 * 2> count_;
  Model fresh_;
  std::vector<Model> pair_, single_, plain_, rival_, pattern_;
  std::array<std::array<Model, 17>, 4> residual_;
};

}  // namespace

std::vector<std::optional<Colour>> decodeOverlay(const TextureHeader& header,
                                                 std::span<const uint8_t> codeword) {
  return DrawnDecoder(header, codeword).decodeOverlay();
}

std::vector<uint8_t> decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword,
                                 int level) {
  const std::vector<Colour> texels = DrawnDecoder(header, codeword).decode();
  std::vector<uint8_t> samples;
  for (int y = 0; y < header.height; y += 1 << level) {
    for (int x = 0; x < header.width; x += 1 << level) {
      for (int c = 0; c < header.channels; ++c) {
        const int value = texels[static_cast<size_t>(y) * header.width + x][c];
        samples.push_back(static_cast<uint8_t>(value));
        if (header.sample == kU16) samples.push_back(static_cast<uint8_t>(value >> 8));
      }
    }
  }
  return samples;
}

}  // namespace tetrakis::reference
