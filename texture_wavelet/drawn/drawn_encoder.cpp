// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_encoder.hpp"

#include <algorithm>
#include <cassert>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bitstream/coder/range_encoder.hpp"
#include "texture_wavelet/drawn/drawn_fill.hpp"
#include "texture_wavelet/drawn/drawn_pass.hpp"
#include "texture_wavelet/mask/cutout.hpp"

namespace tetrakis::inline drawn {

namespace {

/// The image with a number for each of its colours, in any order.
struct Numbered {
  std::vector<ColourIndex> numbers;  ///< of each texel
  std::vector<DrawnColour> colours;
};

/// seen_through: 1 for texels that get the number 0; empty: there are none.
std::optional<Numbered> number(const Texels& texels, std::span<const uint8_t> seen_through) {
  Numbered out;
  if (!seen_through.empty()) out.colours.push_back(greyOf(texels));
  out.numbers.resize(size_t{texels.width} * texels.height);
  std::unordered_map<uint64_t, ColourIndex> known;
  uint64_t last_key = 0;
  ColourIndex last = kNoColour;
  const uint16_t* from = texels.samples.data();
  for (size_t i = 0; i < out.numbers.size(); ++i) {
    DrawnColour colour{};
    uint64_t key = 0;
    for (uint32_t c = 0; c < texels.channels; ++c) {
      colour[c] = *from++;
      key = key << 16 | colour[c];
    }
    ColourIndex& n = out.numbers[i];
    n = kSeeThrough;
    if (!seen_through.empty() && seen_through[i] != 0) continue;
    if (last == kNoColour || key != last_key) {
      const auto [entry, added] =
          known.try_emplace(key, static_cast<ColourIndex>(out.colours.size()));
      if (added) {
        if (out.colours.size() == kMostColours) return {};
        out.colours.push_back(colour);
      }
      last_key = key;
      last = entry->second;
    }
    n = last;
  }
  return out;
}

/// Colours have an index from the moment on when they are first coded.
class EncodingIo {
 public:
  /// measured: the image, to measure what prefixes show of it; null: that does not matter.
  EncodingIo(const Numbered& image, std::span<const ColourIndex> indices,
             const DrawnColours& colours, const Texels* measured)
      : image_(image),
        indices_(indices),
        colours_(colours),
        measured_(measured),
        index_(image.colours.size(), kNoColour) {
    for (ColourIndex i = 0; i < colours.size(); ++i) index_[i] = i;
    if (measured_ != nullptr) measure(0);
  }

  /// Gives a colour that has not appeared yet its index.
  ColourIndex target(size_t texel) {
    if (measured_ != nullptr && encoder_.decidedBytes() >= next_) measure(encoder_.decidedBytes());
    ColourIndex& index = index_[image_.numbers[texel]];
    const ColourIndex known = index;
    if (known == kNoColour) index = static_cast<ColourIndex>(colours_.size());
    return known;
  }
  const DrawnColour& colour(size_t texel) const { return image_.colours[image_.numbers[texel]]; }
  bool bit(AdaptiveBit& model, bool ours) {
    encoder_.encode(model, ours);
    return ours;
  }
  bool evenBit(bool ours) {
    encoder_.encodeEven(ours);
    return ours;
  }
  bool stopped() const { return false; }

  std::vector<uint8_t> finish() {
    std::vector<uint8_t> codeword = encoder_.finish();
    if (codeword.empty()) codeword.push_back(0);  // a track has at least one packet
    return codeword;
  }

  EncodedTrack finishTrack() {
    EncodedTrack track;
    track.codeword = finish();
    track.points = std::move(points_);
    const uint64_t bytes = track.codeword.size();
    track.points.push_back({bytes, 0, bytes <= kDippingBytes});
    track.planes = kDrawnPlanes;
    return track;
  }

 private:
  static constexpr size_t kLargeImage = size_t{1} << 20;
  static constexpr uint64_t kLeastStep = 32;
  /// In so many bytes a vertex stands for so many texels that a wrong one makes the image worse.
  static constexpr uint64_t kDippingBytes = 512;

  /// The image is measured as often as the codeword has grown by so much; large ones less often,
  /// because each time takes a good part of that of coding them.
  double growth() const { return image_.numbers.size() > kLargeImage ? 2.0 : 1.4; }

  /// What a decoder reaches that knows the colours so far.
  void measure(uint64_t bytes) {
    const Texels& texels = *measured_;
    Texels decoded{texels.width, texels.height, texels.channels, texels.bits, {}};
    decoded.samples.resize(texels.samples.size());
    fillDrawn(levelsOf(decoded.width, decoded.height), indices_, colours_, decoded);
    const double squares = countedSquares(texels, decoded, {});
    next_ = std::max(kLeastStep, static_cast<uint64_t>(growth() * static_cast<double>(bytes)));
    if (squares == 0) next_ = UINT64_MAX;  // nothing is left to be found
    const bool better = points_.empty() || (squares > 0 && squares < points_.back().distortion);
    if (better) points_.push_back({bytes, squares, bytes > 0 && bytes <= kDippingBytes});
  }

  const Numbered& image_;
  std::span<const ColourIndex> indices_;
  const DrawnColours& colours_;
  const Texels* measured_;
  std::vector<ColourIndex> index_;  ///< of each number
  uint64_t next_ = 0;               ///< bytes at which the image is measured again
  RangeEncoder encoder_;
  std::vector<RatePoint> points_;
};

bool looksDrawn(const Numbered& image, size_t width) {
  const std::vector<ColourIndex>& n = image.numbers;
  size_t alike = 0;
  for (size_t i = 1; i < n.size(); ++i)
    alike += n[i] == n[i - 1] || (i >= width && n[i] == n[i - width]);
  return 2 * alike >= n.size();
}

}  // namespace

std::optional<EncodedTexture> encodeDrawn(const Texels& texels) {
  const std::optional<Numbered> image = number(texels, {});
  if (!image || !looksDrawn(*image, texels.width)) return {};
  std::vector<ColourIndex> indices(image->numbers.size(), kNoColour);
  DrawnColours colours;
  EncodingIo io(*image, indices, colours, &texels);
  DrawnPass<EncodingIo>(texels, indices, colours, io).run(levelsOf(texels.width, texels.height));
  EncodedTexture encoded;
  encoded.header.width = texels.width;
  encoded.header.height = texels.height;
  encoded.header.channels = static_cast<uint8_t>(texels.channels);
  encoded.header.sample = texels.bits == 8 ? TKS_U8 : TKS_U16;
  encoded.header.planes = kDrawnPlanes;
  encoded.tracks.push_back(io.finishTrack());
  return encoded;
}

std::vector<uint8_t> encodeOverlay(const Texels& texels, Mask photograph) {
  const std::optional<Numbered> image = number(texels, photograph.bytes());
  assert(image.has_value());
  std::vector<ColourIndex> indices(image->numbers.size(), kNoColour);
  DrawnColours colours;
  colours.add(greyOf(texels));
  EncodingIo io(*image, indices, colours, nullptr);
  DrawnPass<EncodingIo>(texels, indices, colours, io).run(levelsOf(texels.width, texels.height));
  return io.finish();
}

}  // namespace tetrakis::inline drawn
