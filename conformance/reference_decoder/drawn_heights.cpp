// SPDX-License-Identifier: Apache-2.0
// Reference decoder: drawn heights (docs/FORMAT.md, section 8.4).
#include <algorithm>
#include <array>
#include <bit>

#include "conformance/reference_decoder/drawing.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {
namespace {

class DrawnHeights : Drawing {
 public:
  using Drawing::Drawing;

  /// v of all samples, with f = 4.
  std::vector<int32_t> decode() {
    decodeIndices();
    std::vector<int32_t> values(indices_.size());
    forEachVertex(width_, height_, [&](const Vertex& v) {
      const int index = indices_[at(v.x, v.y)];
      values[at(v.x, v.y)] =
          index >= 0 ? wrap(int64_t{steps_[static_cast<size_t>(index)]} * 16) : fill(values, v);
    });
    for (size_t i = 0; i < values.size(); ++i) {
      if (!isValid(i)) values[i] = 0;
    }
    return values;
  }

 private:
  size_t listed() const override { return steps_.size(); }

  uint32_t difference(int a, int b) const override {
    const int64_t d = int64_t{steps_[static_cast<size_t>(a)]} - steps_[static_cast<size_t>(b)];
    const auto size = static_cast<uint64_t>(d < 0 ? -d : d);
    const int bits = static_cast<int>(std::bit_width(size));
    const int kind = size < 6 ? static_cast<int>(size) : std::min(bits + 3, 16);
    return static_cast<uint32_t>(d < 0 ? 17 - kind : 17 + kind);
  }

  void append(const std::vector<Candidate>& candidates) override {
    int64_t expected = 0;
    if (!candidates.empty()) {
      const int64_t a = steps_[static_cast<size_t>(candidates[0].index)];
      const int64_t b = steps_[static_cast<size_t>(candidates[candidates.size() > 1].index)];
      expected = (a + b) >> 1;
    }
    const int32_t difference = residual(residual_);
    steps_.push_back(wrap(expected + difference));
  }

  /// FORMAT 8.4, "Fill".
  int32_t fill(const std::vector<int32_t>& values, const Vertex& v) const {
    if (v.s == 0) return 0;
    std::vector<int64_t> all, valid;
    for (int i = 0; i < 4; ++i) {
      const Offset o = v.coarser(i);
      if (!inside(v.x + o.x, v.y + o.y)) continue;
      const size_t near = at(v.x + o.x, v.y + o.y);
      all.push_back(values[near]);
      if (isValid(near)) valid.push_back(values[near]);
    }
    const std::vector<int64_t>& counted = valid.empty() ? all : valid;
    const auto k = static_cast<int64_t>(counted.size());
    int64_t sum = k / 2;
    for (const int64_t value : counted) sum += value;
    int64_t mean = sum / k;
    if (mean * k > sum) --mean;
    return static_cast<int32_t>(mean);
  }

  std::vector<int32_t> steps_;
  std::array<Model, 32> residual_;
};

}  // namespace

std::vector<int32_t> decodeDrawnHeights(const GeometryHeader& header,
                                        std::span<const uint8_t> codeword,
                                        const std::vector<uint8_t>& valid) {
  return DrawnHeights(header.width, header.height, valid, codeword).decode();
}

}  // namespace tetrakis::reference
