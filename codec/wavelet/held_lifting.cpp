// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/held_lifting.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tetrakis::inline wavelet {

namespace {

HeldStates statesOf(const std::vector<int32_t>& values, const LiftedSignals& signals) {
  const LiftingFilter filter = liftingFilter(signals.id);
  HeldStates states = {values, values};
  for (const LiftingStep& step : filter.steps) {
    std::vector<int32_t> next = states[states.size() - 2];
    LiftingSources sources{};
    sources.before.fill(states.back().data());
    sources.after = sources.before;
    liftStep(next.data(), sources, {step, filter.shift, Direction::kAnalysis, signals.wide},
             next.size());
    states.push_back(std::move(next));
  }
  return states;
}

/// Which step of a filter it is.
size_t numberOf(const LiftingStep& step, FilterId id) {
  return static_cast<size_t>(&step - liftingFilter(id).steps.data());
}

/// What a step leaves in held samples.
std::span<const int32_t> valuesAfter(const HeldStates& states, size_t step, Direction direction) {
  return states[direction == Direction::kAnalysis ? step + 2 : step];
}

bool masked(const Pyramid& pyramid) {
  return !pyramid.allExist();
}

}  // namespace

std::span<const int32_t> HeldLevel::after(bool high_x, bool high_y) const {
  const HeldStates& states = columns(high_x).empty() ? rows : columns(high_x);
  const bool high = columns(high_x).empty() ? high_x : high_y;
  return states[states.size() - (high ? 2 : 1)];
}

HeldLadder::HeldLadder(const WaveletSpec& spec, const Pyramid& pyramid)
    : spec_(spec), pyramid_(&pyramid) {
  const std::span<const int32_t> values = pyramid.held().values;
  values_.emplace_back(values.begin(), values.end());
  for (int l = 1; l <= pyramid.levels(); ++l) {
    const HeldLevel states = level(l);
    const std::span<const int32_t> low = states.after(false, false);
    std::vector<int32_t>& next = values_.emplace_back(low.begin(), low.end());
    if (!spec.doubles(l)) continue;
    for (int32_t& v : next) v <<= 1;
  }
}

HeldLevel HeldLadder::level(int level) const {
  const LiftedSignals signals{spec_.filter(level), Direction::kAnalysis,
                              spec_.wide(level) || masked(*pyramid_)};
  const std::vector<int32_t>& values = values_[static_cast<size_t>(level - 1)];
  HeldLevel states;
  if (pyramid_->splitsX(level)) states.rows = statesOf(values, signals);
  if (!pyramid_->splitsY(level)) return states;
  const HeldStates& rows = states.rows;
  states.low_columns = statesOf(rows.empty() ? values : rows.back(), signals);
  if (!rows.empty()) states.high_columns = statesOf(rows[rows.size() - 2], signals);
  return states;
}

HeldBlock::HeldBlock(const Pyramid& pyramid, const HeldLevel& states, int level,
                     const Window& block)
    : states_(&states) {
  const LowBand& band = pyramid.low(level - 1);
  assert(!pyramid.held().none() && block.isInside(band.extent));
  const size_t width = pyramid.plane().width, sample = size_t{1} << band.splits_x;
  row_ = width << band.splits_y;
  half_ = pyramid.splitsX(level) ? sample : 0;
  column_ = half_ > 0 ? 2 * sample : sample;
  first_ = pyramid.held().numbers.data() + block.y * row_ + block.x * sample;
}

HeldLine HeldBlock::line(ptrdiff_t row, bool high_x) const {
  return {first_ + static_cast<size_t>(row) * row_ + (high_x ? half_ : 0), column_};
}

void hold(const HeldLine& line, std::span<const int32_t> values, std::span<int32_t> samples) {
  const uint16_t* number = line.first;
  for (int32_t& sample : samples) {
    if (*number != 0) sample = values[size_t{*number} - 1];
    number += line.pitch;
  }
}

void liftHeldColumns(const Rows<int32_t>& rows, const Rows<const uint8_t>* valid,
                     const HeldColumns& columns, const LiftedSignals& signals) {
  const auto [id, direction, wide] = signals;
  const int shift = liftingFilter(id).shift;
  const HeldBlock& block = *columns.block;
  const uint32_t begin = columns.begin, end = begin + rows.width;
  const uint32_t middle = std::clamp(columns.lows, begin, end);
  MaskedStep masked;
  const auto lift = [&, direction = direction, wide = wide, id = id](ptrdiff_t t,
                                                                     const LiftingStep& step) {
    int32_t* const row = rows.row(t);
    const LiftingRule rule{step, shift, direction, wide || valid != nullptr};
    if (valid != nullptr) {
      masked.lift({row, valid->row(t), rows.width}, rows.sources(t, step.pairs),
                  valid->sources(t, step.pairs), rule);
    } else {
      liftStep(row, rows.sources(t, step.pairs), rule, rows.width);
    }
    for (const bool high : {false, true}) {
      const uint32_t from = high ? middle : begin, to = high ? end : middle;
      if (from == to) continue;
      hold(block.line(t, high).from(from - (high ? columns.lows : 0)),
           valuesAfter(block.states().columns(high), numberOf(step, id), direction),
           {row + (from - begin), to - from});
    }
  };
  forEachRowStep(rows.count, id, direction, lift);
}

void HeldRowLifting::lift(std::span<int32_t> row, const uint8_t* valid, const HeldBlock& block,
                          ptrdiff_t number, const LiftedSignals& signals) {
  const auto length = static_cast<uint32_t>(row.size());
  const bool analyses = signals.direction == Direction::kAnalysis;
  analyses ? values_.takeApart(row.data(), length) : values_.copyFrom(row.data(), length);
  if (valid != nullptr) valid_.copyFrom(valid, length);
  const int shift = liftingFilter(signals.id).shift;
  forEachStep(signals.id, signals.direction, [&](const LiftingStep& step, bool predicts) {
    const LiftingRule rule{step, shift, signals.direction, signals.wide || valid != nullptr};
    int32_t* const targets = values_.targets(predicts);
    const size_t count = values_.count(predicts);
    if (valid != nullptr) {
      step_.lift({targets, valid_.targets(predicts), count}, values_.sources(predicts, step.pairs),
                 valid_.sources(predicts, step.pairs), rule);
    } else {
      liftStep(targets, values_.sources(predicts, step.pairs), rule, count);
    }
    hold(block.line(number, predicts),
         valuesAfter(block.states().rows, numberOf(step, signals.id), signals.direction),
         {targets, count});
  });
  analyses ? values_.copyTo(row.data()) : values_.putTogether(row.data());
}

}  // namespace tetrakis::inline wavelet
