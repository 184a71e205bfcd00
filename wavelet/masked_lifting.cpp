// SPDX-License-Identifier: Apache-2.0
#include "wavelet/masked_lifting.hpp"

#include <algorithm>

namespace tetrakis {

namespace {

/// A line of samples in their order, with what is valid of it.
struct Line {
  std::span<int32_t> values;
  std::span<const uint8_t> valid;

  /// Sum of the pair at a distance from t, if any of it is valid. The line is mirrored at its ends.
  bool pairSum(ptrdiff_t t, ptrdiff_t distance, int64_t& sum) const {
    const auto n = static_cast<ptrdiff_t>(values.size());
    const ptrdiff_t before = mirror(t - distance, n), after = mirror(t + distance, n);
    const bool has_before = valid[static_cast<size_t>(before)] != 0,
               has_after = valid[static_cast<size_t>(after)] != 0;
    if (!has_before && !has_after) return false;
    sum = int64_t{values[static_cast<size_t>(has_before ? before : after)]} +
          values[static_cast<size_t>(has_after ? after : before)];
    return true;
  }
};

/// What a step adds to element t.
uint32_t changeOf(const Line& line, const LiftingStep& step, int shift, ptrdiff_t t) {
  int64_t sum = int64_t{1} << (shift - 1), pair = 0;
  int32_t leading = 0;  // weights of the pairs before the first that is there
  bool found = false;
  for (size_t k = 0; k < step.pairs; ++k) {
    found |= line.pairSum(t, static_cast<ptrdiff_t>(2 * k + 1), pair);
    if (!found) {
      leading += step.weights[k];
    } else {
      sum += (step.weights[k] + leading) * pair;
      leading = 0;
    }
  }
  return found ? static_cast<uint32_t>(sum >> shift) : 0;
}

}  // namespace

MaskedLifting::MaskedLifting(Validity valid, uint32_t plane_width, const RowSet& rows, int splits_x,
                             int splits_y)
    : valid_(valid),
      plane_width_(plane_width),
      rows_(rows),
      splits_x_(splits_x),
      splits_y_(splits_y) {}

bool MaskedLifting::valid(uint32_t x, uint32_t y) const {
  return valid_[(size_t{y} << splits_y_) * plane_width_ + (size_t{x} << splits_x_)] != 0;
}

/// Place in the unsplit row of what lies in column x.
uint32_t MaskedLifting::sampleColumn(uint32_t x, bool split_rows) const {
  if (!split_rows) return x;
  const uint32_t lows = rows_.width - rows_.width / 2;
  return x < lows ? 2 * x : 2 * (x - lows) + 1;
}

bool MaskedLifting::columnIsWhole(uint32_t x, bool split_rows) const {
  const uint32_t column = sampleColumn(x, split_rows);
  for (uint32_t y = 0; y < rows_.count; ++y) {
    if (!valid(column, y)) return false;
  }
  return true;
}

void MaskedLifting::liftLine(FilterId id, Direction direction) {
  const LiftingFilter filter = liftingFilter(id);
  const Line line{line_, line_valid_};
  const size_t steps = filter.steps.size();
  for (size_t i = 0; i < steps; ++i) {
    const bool forward = direction == Direction::kAnalysis;
    const size_t index = forward ? i : steps - 1 - i;
    for (size_t t = index % 2 == 0 ? 1 : 0; t < line_.size(); t += 2) {
      if (!line_valid_[t]) continue;
      const uint32_t change =
          changeOf(line, filter.steps[index], filter.shift, static_cast<ptrdiff_t>(t));
      const auto value = static_cast<uint32_t>(line_[t]);
      line_[t] = static_cast<int32_t>(forward ? value + change : value - change);
    }
  }
}

void MaskedLifting::liftRows(RowLifting& fast, FilterId id, Direction direction, bool wide) {
  const uint32_t width = rows_.width;
  const bool forward = direction == Direction::kAnalysis;
  line_.resize(width);
  line_valid_.resize(width);
  for (uint32_t y = 0; y < rows_.count; ++y) {
    int32_t* row = rows_.first + y * rows_.pitch;
    for (uint32_t x = 0; x < width; ++x) line_valid_[x] = valid(x, y);
    if (std::find(line_valid_.begin(), line_valid_.end(), 0) == line_valid_.end()) {
      forward ? fast.analyse(row, width, id, wide) : fast.synthesise(row, width, id, wide);
      continue;
    }
    for (uint32_t x = 0; x < width; ++x) line_[forward ? x : sampleColumn(x, true)] = row[x];
    liftLine(id, direction);
    for (uint32_t x = 0; x < width; ++x) row[x] = line_[forward ? sampleColumn(x, true) : x];
  }
}

void MaskedLifting::liftColumns(FilterId id, Direction direction, bool wide, bool split_rows) {
  line_.resize(rows_.count);
  line_valid_.resize(rows_.count);
  for (uint32_t x = 0; x < rows_.width;) {
    uint32_t end = x;
    while (end < rows_.width && columnIsWhole(end, split_rows)) ++end;
    if (end > x) {
      tetrakis::liftColumns({rows_.first + x, rows_.pitch, rows_.count, end - x}, id, direction,
                            wide);
      x = end;
      continue;
    }
    const uint32_t column = sampleColumn(x, split_rows);
    for (uint32_t y = 0; y < rows_.count; ++y) {
      line_[y] = rows_.first[y * rows_.pitch + x];
      line_valid_[y] = valid(column, y);
    }
    liftLine(id, direction);
    for (uint32_t y = 0; y < rows_.count; ++y) rows_.first[y * rows_.pitch + x] = line_[y];
    ++x;
  }
}

}  // namespace tetrakis
