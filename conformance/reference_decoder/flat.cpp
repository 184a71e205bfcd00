// SPDX-License-Identifier: Apache-2.0
// Reference decoder: flat areas (docs/FORMAT.md, section 8.1).
#include <array>
#include <list>
#include <optional>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 8.1, "Areas": 0 outside of them, 1 in the first one, …
std::vector<uint32_t> areasOf(const std::vector<uint8_t>& flat, int width, const Forest& forest,
                              uint32_t& count) {
  std::vector<uint32_t> areas(flat.size());
  std::vector<std::vector<size_t>> shared(flat.size());  // of each owner
  for (size_t i = 0; i < flat.size(); ++i) shared[forest.ownerOf(i)].push_back(i);
  const size_t rows = flat.size() / width / forest.patches();
  for (size_t i = 0; i < flat.size(); ++i) {
    if (!flat[i] || areas[i] > 0) continue;
    std::list<size_t> open = {i};
    areas[i] = ++count;
    while (!open.empty()) {
      const size_t at = open.front(), w = static_cast<size_t>(width), x = at % w;
      open.pop_front();
      const auto visit = [&](bool inside, size_t next) {
        if (!inside || !flat[next] || areas[next] > 0) return;
        areas[next] = count;
        open.push_back(next);
      };
      const size_t y = at / w % rows;
      visit(x > 0, at - 1);
      visit(x + 1 < w, at + 1);
      visit(y > 0, at - w);
      visit(y + 1 < rows, at + w);
      for (const size_t same : shared[forest.ownerOf(at)]) visit(true, same);
    }
  }
  return areas;
}

/// FORMAT 8.1, "Flat areas": the heights.
class AreaHeightDecoder {
 public:
  explicit AreaHeightDecoder(RangeDecoder& decoder) : decoder_(decoder) {}

  uint32_t height() {
    size_t place = 0;
    for (auto known = recent_.begin(); known != recent_.end(); ++known, ++place) {
      if (!hit_[place].decode(decoder_)) continue;
      recent_.splice(recent_.begin(), recent_, known);
      return recent_.front();
    }
    const uint32_t change = signedNumber(decoder_, bits_);
    const uint32_t height = (recent_.empty() ? 0 : recent_.front()) + change;
    if (recent_.size() == 8) recent_.pop_back();
    recent_.push_front(height);
    return height;
  }

 private:
  RangeDecoder& decoder_;
  std::list<uint32_t> recent_;
  std::array<Model, 8> hit_;
  std::array<Model, 32> bits_;
};

}  // namespace

Flat decodeFlat(std::span<const uint8_t> codeword, const Plane& plane, uint32_t areas,
                const Forest& forest) {
  RangeDecoder decoder(codeword);
  std::optional<std::vector<uint8_t>> mask = decodeFlatMask(decoder, plane);
  if (!mask) return {};
  forest.share(*mask);
  uint32_t count = 0;
  Flat flat{areasOf(*mask, plane.width, forest, count), {}};
  if (count != areas) return {};
  AreaHeightDecoder heights(decoder);
  try {
    for (uint32_t i = 0; i < areas; ++i)
      flat.heights.push_back(static_cast<int32_t>(heights.height()));
  } catch (Undecided) {
    return {};
  }
  return flat;
}

}  // namespace tetrakis::reference
