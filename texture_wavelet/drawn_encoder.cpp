// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn_encoder.hpp"

#include <unordered_map>
#include <utility>
#include <vector>

#include "bitstream/range_encoder.hpp"
#include "texture_wavelet/drawn_fill.hpp"
#include "texture_wavelet/drawn_pass.hpp"

namespace tetrakis {

namespace {

/// The image with a number for each of its colours, in any order.
struct Numbered {
  std::vector<ColourIndex> numbers;  ///< of each texel
  std::vector<DrawnColour> colours;
};

std::optional<Numbered> number(const Texels& texels) {
  Numbered out;
  out.numbers.resize(size_t{texels.width} * texels.height);
  std::unordered_map<uint64_t, ColourIndex> known;
  const uint16_t* from = texels.samples.data();
  for (ColourIndex& n : out.numbers) {
    DrawnColour colour{};
    uint64_t key = 0;
    for (uint32_t c = 0; c < texels.channels; ++c) {
      colour[c] = *from++;
      key = key << 16 | colour[c];
    }
    const auto [entry, added] = known.emplace(key, static_cast<ColourIndex>(out.colours.size()));
    if (added) {
      if (out.colours.size() == kMostColours) return {};
      out.colours.push_back(colour);
    }
    n = entry->second;
  }
  return out;
}

/// Colours have an index from the moment on when they are first coded.
class EncodingIo {
 public:
  EncodingIo(const Texels& texels, const Numbered& image, std::span<const ColourIndex> indices,
             const DrawnColours& colours)
      : texels_(texels),
        image_(image),
        indices_(indices),
        colours_(colours),
        index_(image.colours.size(), kNoColour) {
    measure(0);
  }

  ColourIndex target(size_t texel) {
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
  void levelDone(const Level& level) {
    const bool measured = level.kind == LevelKind::kMidpoints && level.step <= kCoarsestMeasured;
    if (measured && level.step > 1) measure(encoder_.decidedBytes());
  }

  EncodedTrack finish() {
    EncodedTrack track;
    track.codeword = encoder_.finish();
    if (track.codeword.empty()) track.codeword.push_back(0);
    track.points = std::move(points_);
    track.points.push_back({track.codeword.size(), 0});
    track.planes = kDrawnPlanes;
    return track;
  }

 private:
  static constexpr uint32_t kCoarsestMeasured = 32;

  /// What a decoder reaches that knows the colours so far.
  void measure(uint64_t bytes) {
    Texels decoded{texels_.width, texels_.height, texels_.channels, texels_.bits, {}};
    decoded.samples.resize(texels_.samples.size());
    fillDrawn(indices_, colours_, 1, decoded);
    double squares = 0;
    for (size_t i = 0; i < decoded.samples.size(); ++i) {
      const double difference = double{1} * decoded.samples[i] - texels_.samples[i];
      squares += difference * difference;
    }
    const bool first = points_.empty();
    if (first ||
        (squares > 0 && squares < points_.back().distortion && bytes > points_.back().bytes))
      points_.push_back({bytes, squares});
  }

  const Texels& texels_;
  const Numbered& image_;
  std::span<const ColourIndex> indices_;
  const DrawnColours& colours_;
  std::vector<ColourIndex> index_;  ///< of each number
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
  const std::optional<Numbered> image = number(texels);
  if (!image || !looksDrawn(*image, texels.width)) return {};
  std::vector<ColourIndex> indices(image->numbers.size(), kNoColour);
  DrawnColours colours;
  EncodingIo io(texels, *image, indices, colours);
  DrawnPass<EncodingIo>(texels, indices, colours, io).run();
  EncodedTexture encoded;
  encoded.header.width = texels.width;
  encoded.header.height = texels.height;
  encoded.header.channels = static_cast<uint8_t>(texels.channels);
  encoded.header.sample = texels.bits == 8 ? TKS_U8 : TKS_U16;
  encoded.header.planes = kDrawnPlanes;
  encoded.tracks.push_back(io.finish());
  return encoded;
}

}  // namespace tetrakis
