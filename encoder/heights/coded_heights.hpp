// SPDX-License-Identifier: Apache-2.0
// CodedHeights is the heights as a component of a stream: tracks, which join the codewords of the
// mask, the coefficients and the corrections, and the header that describes them. codeHeights()
// makes it from quantised heights. A value is not changed once it is made: heights that are coded
// in another way are another value, so that attempts can be compared.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/stream/correction_tracks.hpp"
#include "codec/geometry/coding_choice/flat_choice.hpp"
#include "codec/geometry/coefficients_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/rounding_choice.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "ratecontrol/curves/coded_tracks.hpp"

namespace tetrakis::inline heights {

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

/// The same as codeHeights(), for one of several attempts: withRounding() follows for the best one.
CodedHeights tryHeights(std::shared_ptr<const QuantisedHeights> quantised,
                        const HeightTarget& target, const CoefficientOptions& options);

/// The attempt with the byte from which on decoders round, which takes time to find. coded: an
/// attempt.
CodedHeights withRounding(CodedHeights coded);

}  // namespace tetrakis::inline heights
