// SPDX-License-Identifier: Apache-2.0
#include "wavelet/masked_lifting.hpp"

#include <cstring>

namespace tetrakis {

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

/// How many of the first values, which are 0 or 1, are `value`.
size_t runOf(uint8_t value, const uint8_t* values, size_t count) {
  const void* other = std::memchr(values, 1 - value, count);
  return other == nullptr ? count
                          : static_cast<size_t>(static_cast<const uint8_t*>(other) - values);
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

void MaskedStep::lift(int32_t* target, const uint8_t* valid, const LiftingSources& sources,
                      const StepSources<uint8_t>& exist, const LiftingRule& rule, size_t count) {
  findRegular(valid, exist, rule.step.pairs, count);
  for (size_t j = 0; j < count;) {
    if (const size_t run = runOf(1, regular_.data() + j, count - j); run > 0) {
      liftStep(target + j, from(sources, rule.step.pairs, j), rule, run);
      j += run;
    } else if (const size_t voids = runOf(0, valid + j, count - j); voids > 0) {
      j += voids;
    } else {
      const uint32_t change = changeOf(sources, exist, rule, j);
      const auto value = static_cast<uint32_t>(target[j]);
      const bool adds = rule.direction == Direction::kAnalysis;
      target[j++] = static_cast<int32_t>(adds ? value + change : value - change);
    }
  }
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
    masked.lift(rows.row(t), valid.row(t), rows.sources(t, step.pairs),
                valid.sources(t, step.pairs), {step, shift, direction, true}, rows.width);
  });
}

void MaskedRowLifting::run(FilterId id, Direction direction) {
  const int shift = liftingFilter(id).shift;
  forEachStep(id, direction, [&](const LiftingStep& step, bool predicts) {
    step_.lift(values_.targets(predicts), valid_.targets(predicts),
               values_.sources(predicts, step.pairs), valid_.sources(predicts, step.pairs),
               {step, shift, direction, true}, values_.count(predicts));
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

}  // namespace tetrakis
