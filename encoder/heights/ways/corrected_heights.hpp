// SPDX-License-Identifier: Apache-2.0
// codeCorrected() cuts the coefficients of heights and adds corrections for every sample that is
// then off by more than a largest error, which may be 0. Near a bound this takes fewer bytes than
// coding the last bit-planes, which are mostly noise
// (codec/geometry/coding_choice/corrected_cut.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// Heights that can be cut and corrected.
struct Correctable {
  std::shared_ptr<const QuantisedHeights> quantised;  ///< without corrections
  Purpose purpose;                                    ///< of the coefficients
  CoefficientOptions options;
  int32_t largest = 0;  ///< error, in steps, that corrections leave
};

/// The cut that is wanted.
struct CutTarget {
  std::optional<double> mean_square = {};  ///< that it leaves, in steps; nothing: fewest bytes
  uint64_t rival = UINT64_MAX;             ///< heights that clearly take more bytes are of no use
};

/// Codes heights with corrections, beside the flat areas and with the filters that suit the cut. If
/// no sample is off, there are no corrections.
CodedHeights codeCorrected(const Correctable& heights, const CutTarget& target);

/// Lossy heights cut at an RMSE, in steps, with corrections of all samples that are still off.
/// Prefixes up to the cut are those of the lossy heights, and the end is exact. Nothing if heights
/// in regions do not reach this RMSE. lossy: of exact steps without a table.
std::optional<CodedHeights> codeCorrected(const EncodeInputs& inputs, const CodedHeights& lossy,
                                          double rmse);

/// The RMSE, in steps, of a cut that by the estimate takes, with its corrections, far fewer than
/// `bytes` bytes; nothing if there is none. lossy: of exact steps without a table.
std::optional<double> farShorterCut(const CodedHeights& lossy, uint64_t bytes);

}  // namespace tetrakis::inline ways
