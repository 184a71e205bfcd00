// SPDX-License-Identifier: Apache-2.0
#include "codec/frames/frames_encoder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <iterator>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "codec/frames/frame_lifting.hpp"
#include "codec/frames/frame_reference.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline frames {

namespace {

/// The planes of colour c of all frames.
FrameViews framesOf(Planes& planes, uint32_t c, uint32_t colours) {
  FrameViews frames;
  for (size_t p = c; p < planes.size(); p += colours) frames.emplace_back(planes[p]);
  return frames;
}

/// Lifts the frames of a source over time, and leaves of the first plane of each colour what
/// differs from the reference. fraction_bits: of the planes.
void liftOverTime(const FrameSource& source, TimeFilter filter, int fraction_bits, Planes& planes) {
  FramesHeader header = source.layout.frames;
  header.filter = filter;
  const uint32_t colours = source.layout.colours();
  const std::shared_ptr<const FrameReference> before = source.before();
  for (uint32_t c = 0; c < colours; ++c) {
    forwardFrames(header, fraction_bits, framesOf(planes, c, colours));
    if (before != nullptr) takeReference(before->planes[c], fraction_bits, planes[c]);
  }
}

Planes lifted(const FrameSource& source, TimeFilter filter) {
  Planes planes = source.planes;
  liftOverTime(source, filter, 0, planes);
  return planes;
}

/// Bits of the values of the planes, sign included.
int bitsOf(const Planes& planes) {
  uint32_t most = 0;
  for (const std::vector<int32_t>& plane : planes)
    for (const int32_t value : plane) most |= static_cast<uint32_t>(value < 0 ? ~value : value);
  return static_cast<int>(std::bit_width(most)) + 1;
}

/// The planes of the first colour one below the other, as a plane of its own: some stand for all.
struct Stack {
  std::vector<int32_t> values;
  std::vector<uint8_t> marks;
  Extent extent;

  explicit Stack(const FrameSource& source) : extent{source.layout.extent.width, 0} {}

  /// The mean over time has few of the samples of a group, and counts as one plane of `every`.
  static Stack ofEvery(size_t every, const Planes& planes, const FrameSource& source) {
    const FrameLayout& layout = source.layout;
    const size_t frames = layout.frames.count;
    Stack stack(source);
    for (size_t t = 0; t < frames; t += every) stack.append(planes[t * layout.colours()], source);
    for (size_t t = 1; every > 1 && t < frames; t += 2 * every)
      stack.append(planes[t * layout.colours()], source);
    return stack;
  }
  PlaneView<const int32_t> view() const { return {values, extent, marks}; }

  void append(const std::vector<int32_t>& plane, const FrameSource& source) {
    values.insert(values.end(), plane.begin(), plane.end());
    extent.height += source.layout.extent.height;
    if (source.lifted == nullptr) return;
    const std::vector<uint8_t> more = source.lifted->bytes();
    marks.insert(marks.end(), more.begin(), more.end());
  }
};

/// Bits that the planes of the first colour take to the last bit, estimated from parts of them. The
/// mean over time counts by itself: parts of all planes would miss it.
double bitsOfAll(const Planes& planes, const FrameSource& source, int bits) {
  const FrameLayout& layout = source.layout;
  Stack mean(source), others(source);
  for (size_t t = 0; t < layout.frames.count; ++t)
    (t == 0 ? mean : others).append(planes[t * layout.colours()], source);
  const double first = losslessBits(mean.view(), bits);
  return layout.frames.count > 1 ? first + losslessBits(others.view(), bits) : first;
}

/// Bits of lifted values: wider ones have no room for what the wavelet in space adds to 30.
constexpr int kMostBits = 26;
/// Every how manyth frame the choice of filters looks at.
constexpr size_t kLookedAt = 4;

}  // namespace

TimeCoding chooseTimeCoding(const FrameSource& source, int bits) {
  constexpr std::array kFilters = {TimeFilter::kNone, TimeFilter::kHaar, TimeFilter::kFiveThree};
  const bool is_moving = source.layout.frames.count > 1;
  const int most = std::max(kMostBits, bitsOf(source.planes));
  TimeCoding best;
  for (const TimeFilter filter : kFilters) {
    if (filter != TimeFilter::kNone && !is_moving) continue;
    const Planes planes = lifted(source, filter);
    if (bitsOf(planes) > most) continue;
    const double cost = bitsOfAll(planes, source, bits);
    if (filter == TimeFilter::kNone || cost < best.bits) best = {filter, cost};
  }
  return best;
}

WaveletHeader chooseFrameWavelet(const FrameSource& source, TimeFilter filter, int bits,
                                 Purpose purpose) {
  const Planes left = lifted(source, filter);
  const size_t every = source.layout.frames.count > 2 * kLookedAt ? kLookedAt : 1;
  return chooseWavelet(Stack::ofEvery(every, left, source).view(), std::max(bits, bitsOf(left)),
                       purpose);
}

namespace {

/// Planes of coefficients, and what tracks are made of them with.
struct TransformedFrames {
  const FramePlan& plan;
  const FrameSource& source;

  TrackSource trackOf(size_t region) const {
    const std::vector<BandPart> parts = plan.parts(region);
    const double unit = source.share * portable::exp2(-2 * source.layout.wavelet.fraction_bits);
    TrackSource track{plan.bands(parts), {}};
    for (uint32_t p = 0; p < source.layout.planes(); ++p) {
      const double weight = unit * source.squares[p % source.layout.colours()];
      for (const BandPart& part : parts) {
        track.bands.push_back(
            {plan.layout().gather(source.planes[p], part), weight * plan.energy(p, part.subband)});
        clearAbsent(track.plan[track.bands.size() - 1], track.bands.back().values);
      }
    }
    return track;
  }
};

void transform(const FramePlan& plan, FrameSource& source, uint32_t threads) {
  const FrameLayout& layout = source.layout;
  liftOverTime(source, layout.frames.filter, layout.wavelet.fraction_bits, source.planes);
  const std::vector<uint8_t> bytes = shownMarks(source.lifted, {});
  parallelFor(threads, source.planes.size(), [&](size_t p) {
    clearUnmarked(std::span(source.planes[p]), bytes);
    forwardWavelet(specOf(layout.wavelet), plan.layout().pyramid(), source.planes[p], 1);
  });
}

}  // namespace

std::vector<EncodedTrack> encodeFramePlanes(FrameSource source, const TrackOptions& options) {
  const FrameLayout& layout = source.layout;
  assert(source.planes.size() == layout.planes() && source.squares.size() == layout.colours());
  const int fraction_bits = layout.wavelet.fraction_bits;
  for (std::vector<int32_t>& plane : source.planes) plane = withFractions(plane, fraction_bits);
  const FramePlan plan(layout, source.lifted);
  transform(plan, source, options.threads);
  const TransformedFrames frames{plan, source};
  const size_t regions = plan.regions().size();
  const auto source_of = [&](size_t region) { return frames.trackOf(region); };
  if (regions > 1 && options.toTheEnd())
    return encodeWholeTracks(regions, source_of, options.threads);
  std::vector<TrackSource> sources(regions);
  parallelFor(options.threads, regions, [&](size_t i) { sources[i] = source_of(i); });
  return encodeTracks(sources, options);
}

}  // namespace tetrakis::inline frames
