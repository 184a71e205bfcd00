// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/lifting/lifting.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
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

namespace {

/// What a step adds to target j.
uint32_t changeOf(const LiftingSources& sources, const StepSources<uint8_t>& exist,
                  const LiftingRule& rule, size_t j) {
  int64_t sum = int64_t{1} << (rule.shift - 1), pair = 0;
  int32_t leading = 0;  // weights of the pairs before the first that is there
  bool found = false;
  for (size_t k = 0; k < rule.step.pairs; ++k) {
    const bool before = exist.before[k][j] != 0, after = exist.after[k][j] != 0;
    if (before || after) {
      pair = int64_t{(before ? sources.before : sources.after)[k][j]} +
             (after ? sources.after : sources.before)[k][j];
      found = true;
    }
    if (!found) {
      leading += rule.step.weights[k];
    } else {
      sum += (rule.step.weights[k] + leading) * pair;
      leading = 0;
    }
  }
  return found ? static_cast<uint32_t>(sum >> rule.shift) : 0;
}

LiftingSources from(const LiftingSources& sources, size_t pairs, size_t j) {
  LiftingSources rest{};
  for (size_t k = 0; k < pairs; ++k) {
    rest.before[k] = sources.before[k] + j;
    rest.after[k] = sources.after[k] + j;
  }
  return rest;
}

}  // namespace

void MaskedStep::lift(const Targets& targets, const LiftingSources& sources,
                      const StepSources<uint8_t>& existing, const LiftingRule& rule) {
  const auto [target, valid, count] = targets;
  findRegular(valid, existing, rule.step.pairs, count);
  const auto lift_all = [&](size_t begin, size_t end) {
    liftStep(targets.values + begin, from(sources, rule.step.pairs, begin), rule, end - begin);
  };
  const uint8_t* const regular = regular_.data();
  size_t done = 0;  // what lies between it and the current block is regular
  for (size_t begin = 0; begin < count; begin += kBlock) {
    const size_t end = std::min(count, begin + kBlock);
    const auto found = std::accumulate(regular + begin, regular + end, size_t{0});
    if (found == end - begin) continue;
    lift_all(done, begin);
    done = end;
    std::array<int32_t, kBlock> before;
    std::copy(target + begin, target + end, before.begin());
    if (found > 0) lift_all(begin, end);
    for (size_t j = begin; j < end; ++j) {
      if (regular[j] != 0) continue;
      const bool adds = rule.direction == Direction::kAnalysis;
      const uint32_t change = valid[j] != 0 ? changeOf(sources, existing, rule, j) : 0;
      const auto value = static_cast<uint32_t>(before[j - begin]);
      target[j] = static_cast<int32_t>(adds ? value + change : value - change);
    }
  }
  lift_all(done, count);
}

void MaskedStep::findRegular(const uint8_t* valid, const StepSources<uint8_t>& exist, size_t pairs,
                             size_t count) {
  regular_.assign(valid, valid + count);
  uint8_t* __restrict regular = regular_.data();
  for (size_t k = 0; k < pairs; ++k) {
    const uint8_t *before = exist.before[k], *after = exist.after[k];
    for (size_t j = 0; j < count; ++j)
      regular[j] = static_cast<uint8_t>(regular[j] & before[j] & after[j]);
  }
}

void liftMaskedColumns(const Rows<int32_t>& rows, const Rows<const uint8_t>& valid, FilterId id,
                       Direction direction) {
  const int shift = liftingFilter(id).shift;
  MaskedStep masked;
  forEachRowStep(rows.count, id, direction, [&](ptrdiff_t t, const LiftingStep& step) {
    masked.lift({rows.row(t), valid.row(t), rows.width}, rows.sources(t, step.pairs),
                valid.sources(t, step.pairs), {step, shift, direction, true});
  });
}

void MaskedRowLifting::run(FilterId id, Direction direction) {
  const int shift = liftingFilter(id).shift;
  forEachStep(id, direction, [&](const LiftingStep& step, bool predicts) {
    step_.lift({values_.targets(predicts), valid_.targets(predicts), values_.count(predicts)},
               values_.sources(predicts, step.pairs), valid_.sources(predicts, step.pairs),
               {step, shift, direction, true});
  });
}

void MaskedRowLifting::analyse(int32_t* row, const uint8_t* valid, uint32_t length, FilterId id) {
  values_.takeApart(row, length);
  valid_.copyFrom(valid, length);
  run(id, Direction::kAnalysis);
  values_.copyTo(row);
}

void MaskedRowLifting::synthesise(int32_t* row, const uint8_t* valid, uint32_t length,
                                  FilterId id) {
  values_.copyFrom(row, length);
  valid_.copyFrom(valid, length);
  run(id, Direction::kSynthesis);
  values_.putTogether(row);
}

}  // namespace tetrakis::inline lifting
