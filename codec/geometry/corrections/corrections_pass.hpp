// SPDX-License-Identifier: Apache-2.0
// codeCorrections() walks over the corrections of a plane for both sides: row by row, one
// correction for each sample that exists, with a hint of the caller for each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"

namespace tetrakis::inline corrections {

/// The knowledge of both sides about the samples: a hint for each, below kHints. Samples that do
/// not exist have no correction.
using CorrectionHints = PlaneView<const uint8_t>;
inline constexpr int kHints = 32;

/// Codes all corrections. Io: as of CorrectionCoder. known(sample): the correction, or any number
/// in decoders. take(first, row): takes the corrections row by row, up to the first undecided one.
template <class Io, class KnownCorrection, class TakeRow>
void codeCorrections(const CorrectionHints& hints, Io& io, const KnownCorrection& known,
                     const TakeRow& take) {
  CorrectionCoder<Io> coder(hints.width, kHints, io);
  std::vector<int32_t> row(hints.width);
  for (uint32_t y = 0; y < hints.height; ++y) {
    const size_t first = size_t{y} * hints.width;
    coder.nextRow();
    for (uint32_t x = 0; x < hints.width; ++x) {
      row[x] = 0;
      if (!hints.valid[first + x]) continue;
      row[x] = coder.code(x, hints.data[first + x], known(first + x));
      if (io.stopped()) return take(first, std::span<const int32_t>(row).first(x));
    }
    take(first, std::span<const int32_t>(row));
  }
}

}  // namespace tetrakis::inline corrections
