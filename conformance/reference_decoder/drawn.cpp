// SPDX-License-Identifier: Apache-2.0
// Reference decoder: drawn textures (docs/FORMAT.md, section 9.1).
#include <algorithm>
#include <array>
#include <optional>

#include "conformance/reference_decoder/drawing.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {
namespace {

using Colour = std::array<int, 4>;

class DrawnDecoder : Drawing {
 public:
  DrawnDecoder(const TextureHeader& header, std::span<const uint8_t> codeword)
      : Drawing(header.width, header.height, {}, codeword),
        header_(header),
        half_(header.sample == kU8 ? 128 : 32768) {}

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
    forEachVertex(width_, height_, [&](const Vertex& v) {
      const int index = indices_[at(v.x, v.y)];
      texels[at(v.x, v.y)] = index >= 0 ? colours_[static_cast<size_t>(index)] : meanOf(texels, v);
    });
    return texels;
  }

 private:
  size_t listed() const override { return colours_.size(); }
  uint32_t difference(int a, int b) const override { return a != b; }

  void append(const std::vector<Candidate>& candidates) override {
    colours_.push_back(newColour(candidates));
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
      colour[c] = std::clamp(expected + residual(residual_[c]), 0, 2 * half_ - 1);
      carried = colour[c] - mean;
    }
    return colour;
  }

  /// FORMAT 9.1, "Fill".
  Colour meanOf(const std::vector<Colour>& texels, const Vertex& v) const {
    if (v.s == 0) return {half_, half_, half_, half_};
    Colour sum = {};
    int k = 0;
    for (int i = 0; i < 4; ++i) {
      const Offset o = v.coarser(i);
      if (!inside(v.x + o.x, v.y + o.y)) continue;
      for (size_t c = 0; c < 4; ++c) sum[c] += texels[at(v.x + o.x, v.y + o.y)][c];
      ++k;
    }
    for (int& channel : sum) channel = (channel + k / 2) / k;
    return sum;
  }

  const TextureHeader& header_;
  int half_;
  std::vector<Colour> colours_;
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
  for (int y = 0; y < header.height; ++y) {
    for (int x = 0; x < header.width; ++x) {
      if (!header.wavelet.domain.forest.shows(level, x, y)) continue;
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
