// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/completed_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "codec/cube/cube_interpolation.hpp"

namespace tetrakis::inline cube {

namespace {

constexpr int64_t kMargin = kTaps / 2;  // columns and rows on all sides
constexpr int64_t kTapsBefore = kTaps / 2 - 1;

}  // namespace

bool CompletedGrid::End::isAtPole() const {
  return std::abs(pole - static_cast<double>(row)) < 1;
}

double CompletedGrid::End::partOfWay(double at) const {
  return (at - static_cast<double>(row)) / (pole - static_cast<double>(row));
}

struct CompletedGrid::Across {
  int64_t first;
  std::array<float, kTaps> weights;

  Across(double column, uint32_t round) {
    column -= std::floor(column / round) * round;
    const auto before = std::min(static_cast<int64_t>(column), int64_t{round} - 1);
    first = before - kTapsBefore;
    weights = cubicWeights(static_cast<float>(column - static_cast<double>(before)));
  }
  float of(const float* row) const {
    return std::inner_product(weights.begin(), weights.end(), row + first, 0.0f);
  }
};

CompletedGrid::CompletedGrid(const GeographicGrid& grid, std::span<const float> samples)
    : round_(grid.columnsRound()),
      height_(grid.extent().height),
      padded_((round_ + 2 * kMargin) * static_cast<size_t>(height_ + 2 * kMargin)) {
  for (int64_t y = 0; y < height_; ++y) {
    const float* const from = samples.data() + static_cast<size_t>(y) * grid.extent().width;
    std::copy(from, from + round_, start(y));
  }
  before_ = endAt(0, -1, grid.poleBefore());
  behind_ = endAt(height_ - 1, 1, grid.poleBehind());
  for (const End& end : {before_, behind_}) goOn(end);
  goRound();
}

const float* CompletedGrid::start(int64_t row) const {
  return padded_.data() + static_cast<size_t>(row + kMargin) * (round_ + 2 * kMargin) + kMargin;
}

float* CompletedGrid::start(int64_t row) {
  return const_cast<float*>(std::as_const(*this).start(row));
}

CompletedGrid::End CompletedGrid::endAt(int64_t row, int64_t beyond, double pole) const {
  const double sum = std::accumulate(start(row), start(row) + round_, 0.0);
  return {row, beyond, pole, static_cast<float>(sum / round_)};
}

/// Rows of the margin. Half a turn away may lie between two columns.
void CompletedGrid::goOn(const End& end) {
  for (int64_t k = 1; k <= kMargin; ++k) {
    const int64_t row = end.row + k * end.beyond;
    const auto mirrored = static_cast<int64_t>(std::lround(2 * end.pole)) - row;
    const float* const from =
        start(end.isAtPole() ? std::clamp<int64_t>(mirrored, 0, height_ - 1) : end.row);
    const auto part = static_cast<float>(std::min(end.partOfWay(static_cast<double>(row)), 1.0));
    float* const to = start(row);
    for (uint32_t x = 0; x < round_; ++x) {
      const uint32_t a = (x + round_ / 2) % round_, b = (x + (round_ + 1) / 2) % round_;
      to[x] = end.isAtPole() ? (from[a] + from[b]) / 2 : from[x] + part * (end.mean - from[x]);
    }
  }
}

void CompletedGrid::goRound() {
  for (int64_t y = -kMargin; y < height_ + kMargin; ++y) {
    float* const row = start(y);
    for (uint32_t k = 1; k <= kMargin; ++k) {
      row[-int64_t{k}] = row[(round_ - k % round_) % round_];
      row[round_ - 1 + k] = row[(k - 1) % round_];
    }
  }
}

float CompletedGrid::at(double column, double row) const {
  const Across across(column, round_);
  for (const End& end : {before_, behind_}) {
    const double part = end.partOfWay(row);
    if (end.isAtPole() || part <= 0) continue;
    const float last = across.of(start(end.row));
    return last + static_cast<float>(part) * (end.mean - last);
  }
  const int64_t y = std::clamp<int64_t>(static_cast<int64_t>(std::floor(row)), -1, height_ - 1);
  const auto down = cubicWeights(static_cast<float>(row - static_cast<double>(y)));
  float sum = 0;
  for (uint32_t k = 0; k < kTaps; ++k) sum += down[k] * across.of(start(y + k - kTapsBefore));
  return sum;
}

}  // namespace tetrakis::inline cube
