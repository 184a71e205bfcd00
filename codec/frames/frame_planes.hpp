// SPDX-License-Identifier: Apache-2.0
// FramePlan lists the bands of all planes of a group of frames, and decodeFramePlanes() turns any
// prefix of the tracks of such a group into the planes of its frames.
//
// Each frame of heights is one plane, and each frame of a texture a plane for each colour. Planes
// are lifted over time (frame_lifting.hpp), and then each is transformed in space. A track of a
// region holds what lies in it of all planes, in one order of passes: the norms over time and the
// priorities of colours count in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/stream/packet.hpp"
#include "codec/frames/frame_lifting.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/region_decoder.hpp"

namespace tetrakis::inline frames {

/// What the header of a component says of the planes of its frames.
struct FrameLayout {
  Extent extent;
  FramesHeader frames;
  WaveletHeader wavelet;
  RegionHeader regions;
  int bit_planes = 0;
  std::vector<int> priorities = {0};  ///< of the colours of a frame, or of heights alone

  uint32_t colours() const { return static_cast<uint32_t>(priorities.size()); }
  /// Plane c of frame t is number t * colours() + c.
  uint32_t planes() const { return frames.count * colours(); }
};

class FramePlan {
 public:
  /// lifted: the samples that have coefficients; null: all. norms: those of an earlier plan.
  FramePlan(const FrameLayout& of, const SharedBits& lifted,
            const std::optional<SynthesisNorms>& norms = {});

  const PlaneLayout& layout() const { return layout_; }
  const std::vector<Region>& regions() const { return regions_; }
  std::vector<BandPart> parts(size_t region) const { return layout_.parts(regions_[region]); }
  /// The bands of a track: those of plane p begin at p * parts.size(), in the order of the parts.
  std::vector<BandPlan> bands(std::span<const BandPart> parts) const;
  /// The squared error of the frames for a unit squared error of a coefficient.
  double energy(uint32_t plane, size_t subband) const {
    return norms_.energy(plane / of_.colours()) * layout_.energy(subband);
  }

 private:
  /// The plane whose coefficients tell of the magnitudes of those of another one: of a colour the
  /// one before it, of heights and of the first colour that of the coarser time.
  std::optional<uint32_t> companionOf(uint32_t plane) const;

  FrameLayout of_;
  PlaneLayout layout_;
  std::vector<Region> regions_;
  FrameNorms norms_;
};

/// All planes of a view.
struct FramePlanes {
  std::vector<std::vector<int32_t>> planes;  ///< in units of 2^-fraction_bits
  int fraction_bits = 0;
  std::vector<uint8_t> significant =
      {};                     ///< of heights alone: as of DecodedGeometry, of all frames
  uint32_t quiet_levels = 0;  ///< likewise

  uint64_t bytes() const;
};

/// Takes the bands of a track, those of plane p from p * parts.size() on. It may be called for
/// different tracks at the same time.
using TakeBands =
    std::function<void(size_t track, std::span<const Band> bands, std::span<const BandPart> parts)>;

/// What frames go on from; null: nothing.
inline std::shared_ptr<const FrameReference> referenceOf(const FramesHeader& frames) {
  return frames.before.none() ? nullptr : frames.before.decode();
}

/// Decodes what a view shows of all frames. codewords: any prefix of the coefficients of each
/// track, one for each region. Safe on any bytes. before: what the frames go on from; null:
/// nothing. The memory is that of earlier calls with the same plan. take: is told the
/// bands as well; empty: nobody is.
FramePlanes decodeFramePlanes(const FrameLayout& of, const FramePlan& plan,
                              const Codewords& codewords, const View& view,
                              const FrameReference* before,
                              const DecodeContext<TrackMemory>& context = {},
                              const TakeBands& take = {});

/// The planes of the view that the last call asked for, kept for calls that show another frame.
struct KeptFrames {
  View view;
  uint64_t known = 0;  ///< bytes that they were decoded from
  std::shared_ptr<const FramePlanes> planes = nullptr;

  uint64_t bytes() const { return planes != nullptr ? planes->bytes() : 0; }
  bool holds(const View& asked, uint64_t bytes_known) const {
    return planes != nullptr && known == bytes_known && view.level == asked.level &&
           view.window == asked.window;
  }
};

}  // namespace tetrakis::inline frames
