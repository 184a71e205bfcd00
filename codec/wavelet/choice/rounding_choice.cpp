// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/filter_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bitstream/track/track_decoder.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline choice {

namespace {

/// Samples along a side of the parts that are decoded with roundings and without. Larger parts find
/// the place better, and take time.
constexpr uint32_t kPartSide = 64;
/// The least and the greatest squared error of coefficients, for each coded sample, from which on
/// rounding may be found to help. A wider range takes the time of decoding the parts twice for each
/// halving.
constexpr double kMostError = 1, kLeastError = 1.0 / 2048;
/// Parts of fewer bits a sample, such as still water, say nothing: their codewords are hardly
/// longer than the bytes that a range coder ends with. A larger number leaves out parts that tell.
constexpr double kLeastBits = 0.125;

size_t codedIn(std::span<const uint8_t> valid, std::span<const uint16_t> held, size_t samples) {
  size_t coded = 0;
  for (size_t i = 0; i < samples; ++i)
    coded += (valid.empty() || valid[i] != 0) && (held.empty() || held[i] == 0);
  return coded;
}

/// Where the account of a track falls to so many squares, within a pass by the line between its
/// ends.
uint64_t bytesAt(std::span<const RatePoint> points, double squares) {
  const auto after = std::find_if(points.begin(), points.end(), [&](const RatePoint& point) {
    return point.squares() <= squares;
  });
  if (after == points.end()) return points.back().bytes;
  if (after == points.begin()) return after->bytes;
  const RatePoint &a = *(after - 1), &b = *after;
  const double rest = (squares - b.squares()) / (a.squares() - b.squares());
  return b.bytes - static_cast<uint64_t>(rest * static_cast<double>(b.bytes - a.bytes));
}

/// A part of the plane as a stream of its own.
class CodedPart {
 public:
  CodedPart(PlanePart part, const WaveletHeader& wavelet)
      : part_(std::move(part)),
        coded_(static_cast<double>(codedIn(part_.valid, part_.held, part_.values.size()))),
        spec_(specOf(wavelet)) {
    const PlaneLayout layout(spec_,
                             Pyramid(part_.extent, part_.valid, {part_.held, part_.area_values}));
    std::vector<int32_t> values = part_.values;
    forwardWavelet(spec_, layout.pyramid(), values);
    bands_ = layout.parts(regionsOf(part_.extent.width, part_.extent.height, 0).front());
    TrackSource source;
    source.plan = layout.marked(bands_, layout.plan(bands_));
    for (size_t i = 0; i < bands_.size(); ++i) {
      source.bands.push_back({layout.gather(values, bands_[i]), layout.energy(bands_[i].subband)});
      clearAbsent(source.plan[i], source.bands[i].values);
    }
    track_ = std::move(encodeTracks({source}, {}).front());
    growing_.emplace(std::move(source.plan), track_.planes);
  }

  bool tells() const {
    return coded_ > 0 && 8 * static_cast<double>(track_.codeword.size()) >= kLeastBits * coded_;
  }

  /// Squared errors of the prefix whose coefficients are off by so much, inverted without roundings
  /// and with them. Asked for falling errors.
  std::array<double, 2> squares(double coefficient_error) {
    const uint64_t bytes = bytesAt(track_.points, coefficient_error * coded_);
    const TrackState& state = growing_->decode(std::span(track_.codeword).first(bytes));
    return {squaresWith(state, unroundedBits(track_.planes)), squaresWith(state, 0)};
  }

 private:
  double squaresWith(const TrackState& state, int fraction_bits) const {
    const std::vector<int32_t> areas = withFractions(part_.area_values, fraction_bits);
    const PlaneLayout layout(spec_, Pyramid(part_.extent, part_.valid, {part_.held, areas}));
    ViewSynthesis synthesis(spec_, layout.pyramid(), {});
    synthesis.allocate();
    for (size_t i = 0; i < bands_.size(); ++i)
      synthesis.put(state.bands[i], fraction_bits, bands_[i]);
    std::vector<int32_t> shown = synthesis.run(1);
    clearUnmarked(std::span(shown), part_.valid);
    double squares = 0;
    for (size_t i = 0; i < shown.size(); ++i) {
      const double error = std::ldexp(shown[i], -fraction_bits) - part_.values[i];
      squares += error * error;
    }
    return squares;
  }

  PlanePart part_;
  double coded_;
  WaveletSpec spec_;
  std::vector<BandPart> bands_;
  EncodedTrack track_;
  std::optional<GrowingTrack> growing_;
};

}  // namespace

double roundedSquares(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                      const WaveletHeader& wavelet) {
  WaveletHeader of_part = wavelet;
  of_part.ring = false;
  of_part.forest = nullptr;
  std::vector<std::unique_ptr<CodedPart>> parts;
  for (PlanePart& cut : typicalPartsOf(std::span(&plane, 1), held, kPartSide)) {
    auto part = std::make_unique<CodedPart>(std::move(cut), of_part);
    if (part->tells()) parts.push_back(std::move(part));
  }
  double first = 0;
  for (double tried = kMostError; tried >= kLeastError; tried /= 2) {
    std::array<double, 2> sums{};
    for (const auto& part : parts) {
      const std::array<double, 2> squares = part->squares(tried);
      sums[0] += squares[0];
      sums[1] += squares[1];
    }
    if (sums[1] > sums[0])
      first = 0;
    else if (first == 0)
      first = tried;
  }
  const size_t coded = codedIn(plane.valid.bytes(), held.numbers, plane.extent().samples());
  return first * static_cast<double>(coded);
}

std::vector<Account> accountsOf(std::span<const EncodedTrack> tracks) {
  std::vector<Account> accounts;
  for (const EncodedTrack& track : tracks) accounts.push_back(track.points);
  return accounts;
}

uint64_t roundedBytes(std::span<const Account> accounts, double squares) {
  uint64_t bytes = 0;
  for (const Account& account : accounts)
    bytes += bytesAt(account, squares / static_cast<double>(accounts.size()));
  return bytes;
}

uint64_t roundedBytes(std::span<const EncodedTrack> tracks, double squares) {
  const uint64_t exact = exactBytes(tracks);
  return exact > bytesOf(tracks) ? exact : roundedBytes(accountsOf(tracks), squares);
}

}  // namespace tetrakis::inline choice
