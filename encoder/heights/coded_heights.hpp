// SPDX-License-Identifier: Apache-2.0
// CodedHeights is quantised heights as the tracks and the header of a component. The functions of
// this file make it (from coefficients, as a drawing, or from stored samples, each with the layers
// around it), append corrections to it, measure the errors of its prefixes, and note how it was
// coded, so that the ways of encoder/heights/ways/ only have to choose.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/packet.hpp"
#include "codec/geometry/coding_choice/flat_choice.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/plans/plan.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline heights {

// CodedHeights is the heights as a component of a stream: tracks, which join the codewords of the
// mask, the coefficients and the corrections, and the header that describes them. codeHeights()
// makes it from quantised heights. A value is not changed once it is made: heights that are coded
// in another way are another value, so that attempts can be compared.

struct CodedHeights {
  std::shared_ptr<const QuantisedHeights> quantised;
  GeometryHeader header;  ///< without max_error
  GeometryLayers layers;
  /// The first track holds the codewords of validity and flat areas, then coefficients with a table
  /// and a late mask among them, then corrections; other tracks hold coefficients alone, or
  /// corrections alone.
  std::vector<EncodedTrack> tracks;
  uint64_t correction_bytes = 0;        ///< bytes of corrections in the first track
  double left = 0;                      ///< QuantisedHeights::left, or the error of stored samples
  double shown_void = 0;                ///< squared error, in steps, of a void shown as ground
  FlatLayer flat = {};                  ///< beside which the coefficients were coded
  std::vector<Account> accounts = {};   ///< of an attempt: of the coefficients of each track
  std::optional<double> expected = {};  ///< bytes by the estimate for which they were tried

  /// The complete tracks restore every sample.
  bool restoresSamples() const;
  bool corrects() const { return layers.restoresSamples(); }
  bool hasCorrections() const { return layers.corrections != CorrectionKind::kNone; }
  /// Bytes of the header that only some ways to code heights need.
  uint64_t inHeader() const { return 0; }
  /// Samples that count in the error.
  double counted() const { return quantised->counted(); }
  /// Behind the opening there is one codeword, of coefficients.
  bool holdsCoefficientsAlone() const {
    return tracks.size() == 1 && !header.direct() && !corrects() && layers.table_bytes == 0 &&
           !layers.late_mask;
  }
  CodedTracks accounted() const {
    return {Component::kGeometry, tracks, layers.openingBytes(), correction_bytes,
            static_cast<size_t>(correctionTracks(header, layers))};
  }
};

/// The filters that suit the heights.
WaveletHeader chooseHeightFilters(const QuantisedHeights& heights, Purpose purpose);

/// Codes the coefficients of heights, and no other layer.
std::vector<EncodedTrack> codeCoefficients(const QuantisedHeights& heights,
                                           const WaveletHeader& wavelet,
                                           CoefficientOptions options);

/// The target that coefficients are coded for.
struct HeightTarget {
  Purpose purpose;
  uint64_t bytes = UINT64_MAX;  ///< a budget for them and the opening
  double mean_square = 0;       ///< > 0: the error that is wanted, in squared steps
  MaskRoom mask_room = {};      ///< of a late mask, by the budget

  HeightTarget(Purpose of) : purpose(of) {}
};

/// Codes the heights as a component: coefficients by the filters that suit them, beside the flat
/// areas that pay, and the layers that the heights come with.
CodedHeights codeHeights(std::shared_ptr<const QuantisedHeights> quantised,
                         const HeightTarget& target, const CoefficientOptions& options);

/// The attempt with the byte from which on decoders round, which takes time to find. coded: an
/// attempt.
CodedHeights withRounding(CodedHeights coded);

// drawHeights() and storeHeights() code quantised heights without coefficients: as a drawing of few
// values, or as the samples themselves. The wavelet takes more bytes for heights of few values, and
// for noise.

/// Codes the heights as a drawing, in the place of coefficients; nothing if they have too many
/// values for one.
std::optional<CodedHeights> drawHeights(std::shared_ptr<const QuantisedHeights> quantised);

/// Stores the samples without coding them. threads: nothing depends on them.
CodedHeights storeHeights(std::shared_ptr<const QuantisedHeights> quantised, uint32_t threads);

// followedBy() appends corrections to coded heights: at the end of the first track or, of heights
// in regions, as a track for each region (bitstream/stream/geometry_header.hpp), so that a window
// needs no corrections of other regions. These tracks come last in the stream, because a correction
// means nothing for another height than the one it was made for.

/// Appends corrections to heights. heights: without corrections. layers: those of the heights, with
/// what the header says of corrections. corrections: the codeword of each part of the plane.
/// corrected_to: the squared error, in steps, that the corrections leave.
CodedHeights followedBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double corrected_to);

/// The same with corrections that restore every sample. left: the least squared error, in steps,
/// that coefficients alone leave, above 0: steps that seem exact may lack the last bits.
CodedHeights restoredBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double left);

// joinLayers() joins the layers of heights into the codeword of their first track, which
// codec/geometry/plane_corrections.hpp takes apart again. In front lie the mask of the valid
// samples and the flat areas; a table of values and a late mask lie among the coefficients, where
// their bytes take off as much error as the coefficients beside them; corrections follow.

/// The layers around coefficients, and the options for coding the coefficients.
struct HeightLayers {
  GeometryLayers stated;    ///< as the header states them
  MaskRoom mask_room = {};  ///< of a late mask
  WaveletHeader wavelet;
  PriorityHeader priorities;
  FlatLayer flat = {};
};

/// The layers that the heights have, with flat areas. The heights outlive the result.
HeightLayers layersAround(const QuantisedHeights& heights, FlatChoice choice,
                          const PriorityMap* priorities);

/// The header of heights whose coefficients have `planes` bit-planes and these layers around them.
GeometryHeader headerOf(const QuantisedHeights& heights, const HeightLayers& layers, int planes);

/// Joins the layers around coefficients, or around a drawing or stored samples. A table of values
/// lies where its bytes take off as much error as those of the coefficients; corrections are those
/// of the heights. region_log2: that with which the coefficients were coded.
CodedHeights joinLayers(std::shared_ptr<const QuantisedHeights> quantised,
                        const HeightLayers& layers, std::vector<EncodedTrack> coefficients,
                        int region_log2);

// squaresOf() and sampleErrorsOf() decode prefixes of coded heights, as a decoder would, and
// measure how far the decoded samples are from the input. The account of a track only estimates
// that error.

/// Sum of squared errors of the samples, in steps, including voids whose place is not known yet.
/// prefix: of the codeword of each track. memory: that of calls for fewer bytes of a component with
/// one track.
double squaresOf(const CodedHeights& heights, const Codewords& prefix, uint32_t threads,
                 HeightsMemory* memory = nullptr);

/// The memory for the first call of squaresOf().
HeightsMemory memoryFor(const CodedHeights& heights);

/// Decoded samples against the input's, over the valid ones; in sample units.
struct SampleErrors {
  double mean_square = 0, largest = 0;
};
SampleErrors sampleErrorsOf(const CodedHeights& heights, const Codewords& prefix, uint32_t threads);

// planOf() reads the plan of coded heights from their header, so that a plan cannot differ from
// what was coded. note() and noteExpected() tell the notes of an encoding, if somebody asked for
// them, of heights that were weighed.

Plan planOf(const CodedHeights& coded);

/// The plan of heights that are not coded yet, as far as it is known before: without filters, flat
/// areas or a residual.
Plan planOf(const QuantisedHeights& quantised, Coding base);

/// Notes heights that were coded. need: bytes of its tracks that the target needs, at most.
void note(const EncodeInputs& inputs, const CodedHeights& coded, Verdict verdict,
          uint64_t need = UINT64_MAX);

/// Notes a plan that is not tried, because it is expected to take too many bytes. An estimate that
/// is infinite, as of heights without samples, says nothing and is not noted.
void noteExpected(const EncodeInputs& inputs, Plan plan, double bytes);

}  // namespace tetrakis::inline heights
