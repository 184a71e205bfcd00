// SPDX-License-Identifier: Apache-2.0
// Reference decoder: which samples there are, level by level of the 4-8 lattice (docs/FORMAT.md,
// section 8.1).
#include <array>
#include <optional>
#include <utility>

#include "conformance/reference_decoder/lattice.hpp"
#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

class ValidityDecoder {
 public:
  /// none: a plane whose voids are 0 without a decision. undecided: what a sample is where its
  /// decision does not count; nothing: as the majority.
  ValidityDecoder(RangeDecoder& decoder, int width, int height, const Plane* none = nullptr,
                  std::optional<int> undecided = std::nullopt)
      : decoder_(decoder),
        width_(width),
        height_(height),
        none_(none),
        undecided_(undecided),
        valid_(static_cast<size_t>(width) * height) {}

  bool ended() const { return ended_; }

  /// The same once more, with the models as they are but for that of roots.
  std::vector<uint8_t> decodeAmong(const Plane& among) {
    none_ = &among;
    undecided_ = 0;
    valid_.assign(valid_.size(), 0);
    root_ = Model();
    return decode();
  }

  std::vector<uint8_t> decode() {
    forEachVertex(width_, height_, [&](const Vertex& v) {
      if (v.s == 0) at(v.x, v.y) = next(v, root_, 1);
      if (v.s > 0) decide(v);
    });
    return valid_;
  }

  /// known: right at the multiples of 8.
  std::vector<uint8_t> decodeAbove(std::vector<uint8_t> known) {
    valid_ = std::move(known);
    forEachVertex(width_, height_, 8, [&](const Vertex& v) {
      if (v.s > 0) decide(v);
    });
    return valid_;
  }

 private:
  uint8_t& at(int x, int y) { return valid_.at(static_cast<size_t>(y) * width_ + x); }
  bool inside(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }

  /// The neighbour at an offset, mirrored if need be; nothing: it is missing.
  std::optional<int> neighbour(int x, int y, Offset o) {
    if (!inside(x + o.x, y)) o.x = -o.x;
    if (!inside(x, y + o.y)) o.y = -o.y;
    if (!inside(x + o.x, y + o.y)) return std::nullopt;
    return at(x + o.x, y + o.y);
  }

  void decide(const Vertex& v) {
    int near = 0, nearCount = 0, there = 0, ring = 0;
    for (int i = 0; i < 12; ++i) {
      const std::optional<int> n = neighbour(v.x, v.y, v.coarser(i));
      if (i >= 4) {
        ring += n.value_or(0);
      } else if (n) {
        near |= *n << i;
        nearCount += *n;
        ++there;
      }
    }
    const int majority = 2 * nearCount >= there;
    const auto before = [&](Offset o) {
      return inside(v.x + o.x, v.y + o.y) ? at(v.x + o.x, v.y + o.y) : majority;
    };
    constexpr int kClass[] = {0, 1, 1, 2, 2, 2, 3, 3, 4};
    const int context = (near * 4 + 2 * before(v.c1()) + before(v.c2())) * 5 + kClass[ring];
    at(v.x, v.y) = next(v, models_[v.centre][static_cast<size_t>(context)], majority);
  }

  uint8_t next(const Vertex& v, Model& model, int otherwise) {
    if (none_ != nullptr && !none_->isValid(v.x, v.y)) return 0;
    try {
      if (!ended_) return static_cast<uint8_t>(model.decode(decoder_));
    } catch (Undecided) {
      ended_ = true;
    }
    return static_cast<uint8_t>(undecided_.value_or(otherwise));
  }

  RangeDecoder& decoder_;
  int width_, height_;
  const Plane* none_;
  std::optional<int> undecided_;
  std::vector<uint8_t> valid_;
  bool ended_ = false;
  Model root_;
  std::array<std::array<Model, 320>, 2> models_;
};

}  // namespace

std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, int width, int height) {
  RangeDecoder decoder(codeword);
  return ValidityDecoder(decoder, width, height).decode();
}

namespace {

/// The samples at multiples of 2^log2 of a rectangle of a plane.
struct SparseGrid {
  int log2;
  int64_t x0, y0, x1, y1;

  int width() const { return static_cast<int>(((x1 - 1 - x0) >> log2) + 1); }
  int height() const { return static_cast<int>(((y1 - 1 - y0) >> log2) + 1); }

  std::vector<uint8_t> of(const std::vector<uint8_t>& plane, int64_t pitch) const {
    std::vector<uint8_t> values;
    for (int64_t y = y0; y < y1; y += int64_t{1} << log2) {
      for (int64_t x = x0; x < x1; x += int64_t{1} << log2)
        values.push_back(plane.at(static_cast<size_t>(y * pitch + x)));
    }
    return values;
  }
  void put(const std::vector<uint8_t>& values, int64_t pitch, std::vector<uint8_t>& plane) const {
    size_t i = 0;
    for (int64_t y = y0; y < y1; y += int64_t{1} << log2) {
      for (int64_t x = x0; x < x1; x += int64_t{1} << log2)
        plane.at(static_cast<size_t>(y * pitch + x)) = values.at(i++);
    }
  }
};

}  // namespace

std::vector<uint8_t> decodeRegionMasks(std::span<const uint8_t> base,
                                       const std::vector<std::span<const uint8_t>>& masks,
                                       const std::vector<Region>& regions) {
  std::vector<uint8_t> valid(static_cast<size_t>(regions[0].x1 * regions[0].y1));
  for (size_t i = 0; i < regions.size(); ++i) {
    const Region& region = regions[i];
    const SparseGrid grid{region.firstLevel - 1, region.x0, region.y0, region.x1, region.y1};
    const int64_t pitch = regions[0].x1;
    RangeDecoder decoder(i == 0 ? base : masks.at(i - 1));
    ValidityDecoder mask(decoder, grid.width(), grid.height());
    grid.put(i == 0 ? mask.decode() : mask.decodeAbove(grid.of(valid, pitch)), pitch, valid);
  }
  return valid;
}

std::vector<std::vector<uint8_t>> decodeFrameMasks(std::span<const uint8_t> codeword, int width,
                                                   int height, int frames) {
  RangeDecoder decoder(codeword);
  std::vector<std::vector<uint8_t>> masks = {ValidityDecoder(decoder, width, height).decode()};
  std::array<ValidityDecoder, 2> changes = {ValidityDecoder(decoder, width, height),
                                            ValidityDecoder(decoder, width, height)};
  std::array<Model, 2> any;
  const auto changed = [&](size_t k, const std::vector<uint8_t>& among) {
    try {
      if (any[k].decode(decoder)) return changes[k].decodeAmong({width, height, {}, among});
    } catch (Undecided) {
    }
    return std::vector<uint8_t>(among.size());
  };
  while (masks.size() < static_cast<size_t>(frames)) {
    std::vector<uint8_t> mask = masks.back(), others = mask;
    for (uint8_t& valid : others) valid = !valid;
    const std::vector<uint8_t> arrive = changed(0, others), go = changed(1, mask);
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = (mask[i] | arrive[i]) & !go[i];
    masks.push_back(mask);
  }
  return masks;
}

std::vector<uint8_t> decodeLateValidity(std::span<const uint8_t> codeword, const Plane& lifted) {
  RangeDecoder decoder(codeword);
  return ValidityDecoder(decoder, lifted.width, lifted.height, &lifted, 1).decode();
}

std::optional<std::vector<uint8_t>> decodeFlatMask(RangeDecoder& decoder, const Plane& plane) {
  ValidityDecoder mask(decoder, plane.width, plane.height, &plane);
  std::vector<uint8_t> flat = mask.decode();
  if (mask.ended()) return std::nullopt;
  return flat;
}

}  // namespace tetrakis::reference
