// SPDX-License-Identifier: Apache-2.0
#include "wavelet/lifting/lifting.hpp"

namespace tetrakis::inline lifting {

void liftColumns(const Rows<int32_t>& rows, FilterId id, Direction direction, bool wide) {
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

}  // namespace tetrakis::inline lifting
