// SPDX-License-Identifier: Apache-2.0
// Reference decoder: which samples there are, level by level of the 4-8 lattice (docs/FORMAT.md,
// section 8.1).
#include <algorithm>
#include <array>
#include <optional>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

struct Offset {
  int x, y;
};

/// FORMAT 8.1: "12 coarser neighbours", as offsets on the grid.
std::array<Offset, 12> neighboursOf(bool centre, int s) {
  std::array<Offset, 12> offsets = {};
  size_t count = 0;
  for (Offset o : {Offset{1, 0}, {2, 1}, {1, 2}}) {
    for (int turn = 0; turn < 4; ++turn) {
      const Offset mapped = centre ? Offset{o.x - o.y, o.x + o.y} : o;
      offsets[count++] = {s * mapped.x, s * mapped.y};
      o = {-o.y, o.x};
    }
  }
  return offsets;
}

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

  std::vector<uint8_t> decode() {
    int d = 0;
    while (1 << d < std::max(width_, height_) - 1) ++d;
    const int root = 1 << d;
    for (int y = 0; y < height_; y += root) {
      for (int x = 0; x < width_; x += root) at(x, y) = next(x, y, root_, 1);
    }
    for (int s = root / 2; s >= 1; s /= 2) {
      for (int y = s; y < height_; y += 2 * s) {
        for (int x = s; x < width_; x += 2 * s) decide(true, s, x, y);
      }
      for (int y = 0; y < height_; y += s) {
        for (int x = y / s % 2 == 0 ? s : 0; x < width_; x += 2 * s) decide(false, s, x, y);
      }
    }
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

  void decide(bool centre, int s, int x, int y) {
    int near = 0, nearCount = 0, there = 0, ring = 0;
    const std::array<Offset, 12> offsets = neighboursOf(centre, s);
    for (size_t i = 0; i < offsets.size(); ++i) {
      const std::optional<int> v = neighbour(x, y, offsets[i]);
      if (i >= 4) {
        ring += v.value_or(0);
      } else if (v) {
        near |= *v << i;
        nearCount += *v;
        ++there;
      }
    }
    const int majority = 2 * nearCount >= there;
    const auto before = [&](int dx, int dy) {
      return inside(x + dx, y + dy) ? at(x + dx, y + dy) : majority;
    };
    const int first = centre ? before(-2 * s, 0) : before(-s, -s);
    const int second = centre ? before(0, -2 * s) : before(s, -s);
    constexpr int kClass[] = {0, 1, 1, 2, 2, 2, 3, 3, 4};
    const int context = (near * 4 + 2 * first + second) * 5 + kClass[ring];
    at(x, y) = next(x, y, models_[centre][static_cast<size_t>(context)], majority);
  }

  uint8_t next(int x, int y, Model& model, int otherwise) {
    if (none_ != nullptr && !none_->isValid(x, y)) return 0;
    const std::optional<int> bit = ended_ ? std::nullopt : model.decode(decoder_);
    ended_ = !bit;
    return static_cast<uint8_t>(bit.value_or(undecided_.value_or(otherwise)));
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
