// SPDX-License-Identifier: Apache-2.0
#include "wavelet/rounding_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bitstream/track/track_decoder.hpp"
#include "wavelet/band_plan.hpp"
#include "wavelet/typical_parts.hpp"
#include "wavelet/view_synthesis.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline wavelet {

namespace {

constexpr uint32_t kPartSide = 64;
constexpr int kTries = 12;
constexpr double kBitsPerTry = 0.15;

/// A part of the plane as a stream of its own.
class CodedPart {
 public:
  CodedPart(const PlaneView<const int32_t>& plane, const View& view, const WaveletHeader& wavelet)
      : extent_(view.extentIn(plane.extent())),
        samples_(cut(std::span<const int32_t>(plane.values()), plane.extent(), view)),
        valid_(cut(plane.valid.bytes(), plane.extent(), view)),
        spec_(specOf(wavelet)),
        layout_(spec_, extent_, valid_),
        parts_(layout_.parts(regionsOf(extent_.width, extent_.height, 0).front())) {
    clearUnmarked(std::span(samples_), valid_);
    std::vector<int32_t> values = samples_;
    forwardWavelet(spec_, {values, extent_, valid_});
    TrackSource source;
    source.plan = layout_.plan(parts_, 0, 0, 0);
    layout_.markAbsent(parts_, source.plan);
    for (const BandPart& part : parts_)
      source.bands.push_back({layout_.gather(values, part), layout_.energy(part.subband)});
    track_ = std::move(encodeTracks({source}, {}).front());
    growing_.emplace(std::move(source.plan), track_.planes);
  }

  /// Squared errors of a prefix, inverted without roundings and with them. Asked for rising bytes.
  std::array<double, 2> squares(double missing_bits) {
    const double missing = missing_bits * static_cast<double>(extent_.samples()) / 8;
    const double bytes = std::max(static_cast<double>(track_.codeword.size()) - missing, 0.0);
    const TrackState& state =
        growing_->decode(std::span(track_.codeword).first(static_cast<size_t>(bytes)));
    return {squaresWith(state, {unroundedBits(track_.planes), false}),
            squaresWith(state, {0, true})};
  }

 private:
  double squaresWith(const TrackState& state, Precision precision) const {
    ViewSynthesis synthesis(spec_, layout_.pyramid(), {});
    synthesis.allocate();
    for (size_t i = 0; i < parts_.size(); ++i)
      synthesis.put(state.bands[i], precision.fraction_bits, parts_[i]);
    std::vector<int32_t> shown = synthesis.run(1, precision.rounds);
    clearUnmarked(std::span(shown), valid_);
    double squares = 0;
    for (size_t i = 0; i < shown.size(); ++i) {
      const double error = std::ldexp(shown[i], -precision.fraction_bits) - samples_[i];
      squares += error * error;
    }
    return squares;
  }

  Extent extent_;
  std::vector<int32_t> samples_;
  std::vector<uint8_t> valid_;
  WaveletSpec spec_;
  PlaneLayout layout_;
  std::vector<BandPart> parts_;
  EncodedTrack track_;
  std::optional<GrowingTrack> growing_;
};

}  // namespace

double roundedBits(const PlaneView<const int32_t>& plane, const WaveletHeader& wavelet) {
  std::vector<std::unique_ptr<CodedPart>> parts;
  for (const Window& window : typicalParts(plane.extent(), kPartSide))
    parts.push_back(std::make_unique<CodedPart>(plane, View{0, window}, wavelet));
  int first = 0;  // of the tries from which on rounding is better
  for (int tried = kTries; tried > 0; --tried) {
    std::array<double, 2> sums{};
    for (const auto& part : parts) {
      const std::array<double, 2> squares = part->squares(tried * kBitsPerTry);
      sums[0] += squares[0];
      sums[1] += squares[1];
    }
    if (sums[1] > sums[0])
      first = 0;
    else if (first == 0)
      first = tried;
  }
  return first * kBitsPerTry;
}

uint64_t roundedBytes(std::span<const EncodedTrack> tracks, double missing_bits) {
  const uint64_t exact = exactBytes(tracks), missing = static_cast<uint64_t>(missing_bits / 8);
  if (exact > bytesOf(tracks)) return exact;
  return exact - std::min(exact, missing);
}

}  // namespace tetrakis::inline wavelet
