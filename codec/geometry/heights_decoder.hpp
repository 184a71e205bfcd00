// SPDX-License-Identifier: Apache-2.0
// decodeHeights() turns any prefix of the tracks of heights into the heights of a view, in steps
// with corrections. decodeCoefficients() and decodeStoredHeights() do that for the two kinds of
// tracks that have no part of their own: wavelet coefficients, and samples that are stored as they
// are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/frames/frame_masks.hpp"
#include "codec/frames/frame_planes.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/plane_corrections.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/lines/shown_lines.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/pyramid.hpp"
#include "codec/wavelet/region_decoder.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"

namespace tetrakis::inline geometry {

// decodeCoefficients() decodes the coefficients of a height field and turns them into heights in
// steps. It uses integers only.

/// The samples of a plane that are known before its coefficients.
struct KnownSamples {
  SampleMarks valid = {};                 ///< which samples are valid; the others are void
  HeldSamples flat = {};                  ///< of flat areas, which outlive the call
  std::optional<SharedBits> lifted = {};  ///< of liftedSamples(), if voids are bridged
};

/// Decodes the heights of a view; in a window the time follows its size if the plane has regions.
/// codewords: any prefix of the coefficients of each track, one for each of regionsOf(). known: of
/// the whole plane. Safe on any bytes and on any header that readHeader() accepts. The memory is
/// that of earlier calls with the same header, known samples and view, which is no window.
/// Of a window, valid and lifted may be those around it.
DecodedGeometry decodeCoefficients(const GeometryHeader& header, const Codewords& codewords,
                                   KnownSamples known = {}, const View& view = {},
                                   const DecodeContext<TrackMemory>& context = {});

// ShownSignificance marks the vertices of a view that have a significant coefficient. They make the
// coded mesh of that view.

/// Collects the marks of vertices from the tracks of a view. The pyramid outlives it.
class ShownSignificance {
 public:
  ShownSignificance(const Pyramid& pyramid, const View& view, size_t tracks);

  /// Takes the bands of a track, one for each part. Called for different tracks at the same time.
  void take(size_t track, std::span<const Band> bands, std::span<const BandPart> parts);

  /// Writes the marks of the vertices, and the number of finest levels without a mark, into the
  /// heights of the view.
  void giveTo(DecodedGeometry& geometry);

 private:
  void mark(const Band& band, const Subband& subband, const BandPart& part);

  const Pyramid& pyramid_;
  int level_;
  const LowBand& low_;
  ShownLow shown_low_;
  Window shown_;  ///< samples of the low band
  bool is_window_;
  std::vector<uint8_t> marks_;  ///< of those
  std::vector<int> quiet_;      ///< of each track, the finest levels without such a coefficient
};

// decodeStoredHeights() decodes heights that are stored sample by sample, because coding them would
// take more bytes.

/// Returns the samples of a view. Their steps are those nearest to the samples, and corrections
/// restore the samples. A sample that has no byte yet is that of step 0. bytes: any prefix of the
/// stored bytes of a geometry with header.stored(). valid: of the whole plane.
DecodedHeights decodeStoredHeights(const GeometryHeader& header, std::span<const uint8_t> bytes,
                                   const SharedBits& valid, const View& view);

// decodeHeights() decodes heights from the layers of their tracks: validity, flat areas,
// coefficients or a drawing with the layers among them, corrections
// (bitstream/stream/geometry_header.hpp), or stored samples.

/// The memory of one call of decodeHeights() for the next call, whose tracks begin with the same
/// bytes. It is empty before the first call.
struct HeightsMemory {
  SharedBits valid;    ///< once it is whole
  SharedBits lifted;   ///< if voids are bridged, once all before the coefficients is there
  FlatAreas flat;      ///< likewise
  TrackMemory tracks;  ///< likewise: what exists of them follows from those
  CorrectedParts parts = CorrectedParts(0);
  FrameMasks frame_masks = {};  ///< of heights in frames, once they are whole
  KeptFrames frames = {};       ///< likewise: all frames of the last view
  /// Of encoders, which have all of a drawing: the heights that its first bytes show behind the
  /// opening.
  std::function<DecodedGeometry(uint64_t bytes)> drawing = {};
  /// Of encoders, which have all corrections: the heights behind the first bytes of these.
  std::function<DecodedHeights(uint64_t bytes)> corrected = {};

  uint64_t bytes() const;
};

/// The part of the coded lines that a view needs. A stored sample's place depends on the voids
/// before it, contexts of drawings come from the whole plane, and contexts of corrections from the
/// samples before and from the corrected heights (correctedView()).
View decodedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view);

/// Decodes the heights of a view. In a window the time follows its size if there are regions.
/// Levels above 0 have no corrections, which belong to the samples. codewords: any prefix of each
/// track; the layers are those of the first. Safe on any bytes. The memory is that of earlier calls
/// with the same headers and view, which is no window.
DecodedHeights decodeHeights(const GeometryHeader& header, const GeometryLayers& layers,
                             const Codewords& codewords, const View& view = {},
                             const DecodeContext<HeightsMemory>& context = {});

/// The heights of all coded lines before their corrections. Samples that several patches share are
/// right in the patch that owns them alone. codewords: of decodeHeights(), without corrections.
DecodedHeights decodeUncorrected(const GeometryHeader& header, const GeometryLayers& layers,
                                 const Codewords& codewords);

/// What heights in frames say of their planes.
FrameLayout frameLayoutOf(const GeometryHeader& header);

/// Decodes the masks of all frames; null: every sample is valid.
FrameMasks frameMasksOf(const TakenLayers& taken, HeightsMemory* memory = nullptr);

/// Decodes the heights of a view of heights in frames, in steps.
DecodedGeometry decodeFrame(const TakenLayers& taken, const View& view,
                            const DecodeContext<HeightsMemory>& context);

/// The last frame of heights in frames, as the next group goes on from it.
FrameReference lastFrame(const GeometryHeader& header, const GeometryLayers& layers,
                         const Codewords& codewords,
                         const DecodeContext<HeightsMemory>& context = {});

/// Decodes which samples of a view are valid, and nothing else; empty: all are valid.
std::vector<uint8_t> decodeValidityLayer(const GeometryHeader& header, const GeometryLayers& layers,
                                         const Codewords& codewords, const View& view);

}  // namespace tetrakis::inline geometry
