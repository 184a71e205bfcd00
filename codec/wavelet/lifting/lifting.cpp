// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/lifting/lifting.hpp"

#include <cstddef>
#include <vector>

namespace tetrakis::inline lifting {

namespace {

/// Columns one by one: the kernel takes about as long for a few values as for a vector of them.
void liftSingleColumns(const Rows<int32_t>& rows, FilterId id, Direction direction, bool wide) {
  RowLifting lifting(rows.count, Ends::kMirrored);
  std::vector<int32_t> column(rows.count);
  for (uint32_t x = 0; x < rows.width; ++x) {
    int32_t* const first = rows.first + x;
    for (size_t y = 0; y < rows.count; ++y) column[y] = first[y * rows.pitch];
    lifting.liftInPlace(column, id, direction, wide);
    for (size_t y = 0; y < rows.count; ++y) first[y * rows.pitch] = column[y];
  }
}

}  // namespace

void liftColumns(const Rows<int32_t>& rows, FilterId id, Direction direction, bool wide) {
  constexpr uint32_t kVector = 8;  // values of a vector of AVX2
  if (rows.width < kVector) return liftSingleColumns(rows, id, direction, wide);
  const int shift = liftingFilter(id).shift;
  forEachRowStep(rows.count, id, direction, [&](ptrdiff_t t, const LiftingStep& step) {
    liftStep(rows.row(t), rows.sources(t, step.pairs), {step, shift, direction, wide}, rows.width);
  });
}

void RowLifting::run(FilterId id, Direction direction, bool wide) {
  const int shift = liftingFilter(id).shift;
  forEachStep(id, direction, [&](const LiftingStep& step, bool predicts) {
    liftStep(halves_.targets(predicts), halves_.sources(predicts, step.pairs),
             {step, shift, direction, wide}, halves_.count(predicts));
  });
}

void RowLifting::analyse(int32_t* row, uint32_t length, FilterId id, bool wide) {
  halves_.takeApart(row, length);
  run(id, Direction::kAnalysis, wide);
  halves_.copyTo(row);
}

void RowLifting::synthesise(int32_t* row, uint32_t length, FilterId id, bool wide) {
  halves_.copyFrom(row, length);
  run(id, Direction::kSynthesis, wide);
  halves_.putTogether(row);
}

void RowLifting::liftInPlace(std::span<int32_t> signal, FilterId id, Direction direction,
                             bool wide) {
  halves_.takeApart(signal.data(), static_cast<uint32_t>(signal.size()));
  run(id, direction, wide);
  halves_.putTogether(signal.data());
}

}  // namespace tetrakis::inline lifting
