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
std::vector<uint32_t> areasOf(const std::vector<uint8_t>& flat, int width, uint32_t& count) {
  std::vector<uint32_t> areas(flat.size());
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
      visit(x > 0, at - 1);
      visit(x + 1 < w, at + 1);
      visit(at >= w, at - w);
      visit(at + w < flat.size(), at + w);
    }
  }
  return areas;
}

/// FORMAT 8.1, "Flat areas": the heights. Nothing: a decision does not count.
class AreaHeightDecoder {
 public:
  explicit AreaHeightDecoder(RangeDecoder& decoder) : decoder_(decoder) {}

  std::optional<uint32_t> height() {
    size_t place = 0;
    for (auto known = recent_.begin(); known != recent_.end(); ++known, ++place) {
      const std::optional<int> hit = hit_[place].decode(decoder_);
      if (!hit) return std::nullopt;
      if (!*hit) continue;
      recent_.splice(recent_.begin(), recent_, known);
      return recent_.front();
    }
    const std::optional<uint32_t> change = difference();
    if (!change) return std::nullopt;
    const uint32_t height = (recent_.empty() ? 0 : recent_.front()) + *change;
    if (recent_.size() == 8) recent_.pop_back();
    recent_.push_front(height);
    return height;
  }

 private:
  std::optional<uint32_t> difference() {
    int k = 0;
    for (; k < 32; ++k) {
      const std::optional<int> more = bits_[static_cast<size_t>(k)].decode(decoder_);
      if (!more) return std::nullopt;
      if (!*more) break;
    }
    if (k == 0) return 0;
    uint32_t magnitude = 1;
    for (int i = 1; i < k; ++i) {
      const std::optional<int> bit = decoder_.decode(1 << 15);
      if (!bit) return std::nullopt;
      magnitude = 2 * magnitude + static_cast<uint32_t>(*bit);
    }
    const std::optional<int> negative = decoder_.decode(1 << 15);
    if (!negative) return std::nullopt;
    return *negative ? 0 - magnitude : magnitude;
  }

  RangeDecoder& decoder_;
  std::list<uint32_t> recent_;
  std::array<Model, 8> hit_;
  std::array<Model, 32> bits_;
};

}  // namespace

Flat decodeFlat(std::span<const uint8_t> codeword, const Plane& plane, uint32_t areas) {
  RangeDecoder decoder(codeword);
  const std::optional<std::vector<uint8_t>> mask = decodeFlatMask(decoder, plane);
  if (!mask) return {};
  uint32_t count = 0;
  Flat flat{areasOf(*mask, plane.width, count), {}};
  if (count != areas) return {};
  AreaHeightDecoder heights(decoder);
  for (uint32_t i = 0; i < areas; ++i) {
    const std::optional<uint32_t> height = heights.height();
    if (!height) return {};
    flat.heights.push_back(static_cast<int32_t>(*height));
  }
  return flat;
}

}  // namespace tetrakis::reference
