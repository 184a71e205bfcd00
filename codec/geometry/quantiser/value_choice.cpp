// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/value_choice.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "base/samples.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/values/value_table.hpp"

namespace tetrakis::inline quantiser {

namespace {

/// A table with more than one value for this number of samples is not examined: it would not pay. A
/// smaller number takes the time of more trials.
constexpr size_t kSamplesForAValue = 4;
/// At most one in this number of samples may have a value that the table leaves out. A smaller
/// number allows shorter tables, with more exceptions, and takes the time of more trials.
constexpr size_t kSamplesForAnException = 16;
/// A table of nearly all numbers in the range saves nothing. A larger share takes time.
constexpr double kNearlyAll = 0.9;
/// A gain below this is within the error of the estimates. A larger share takes tables whose
/// prefixes lose more than the bytes gain.
constexpr double kClearly = 0.98;
/// The samples that a value of the table has at least, in each trial. More trials find shorter
/// tables, and take time.
constexpr std::array<uint32_t, 3> kLeastUses = {1, 2, 4};

/// A value that samples have: its word (codec/geometry/steps/sample_order.hpp), and the number of
/// these samples.
struct Value {
  uint32_t word;
  uint32_t samples;
};

/// The values of a height field in the order in which they are met, found by a hash table with open
/// addresses.
class Values {
 public:
  explicit Values(size_t most) : most_(most), slots_(1024, kEmpty) {}

  void count(uint32_t word) {
    uint32_t& slot = slots_[slotOf(word)];
    if (slot != kEmpty) {
      ++values_[slot].samples;
      return;
    }
    slot = static_cast<uint32_t>(values_.size());
    values_.push_back({word, 1});
    if (2 * values_.size() > slots_.size()) grow();
  }
  /// The number of the value of a word that was counted.
  uint32_t numberOf(uint32_t word) const { return slots_[slotOf(word)]; }
  bool tooMany() const { return values_.size() > most_; }
  size_t size() const { return values_.size(); }
  const Value& operator[](size_t number) const { return values_[number]; }

 private:
  static constexpr uint32_t kEmpty = UINT32_MAX;

  /// The slot of the word, or the slot where it may be put.
  size_t slotOf(uint32_t word) const {
    const size_t last = slots_.size() - 1;
    size_t at = (word * 0x9e3779b1u >> 11) & last;
    while (slots_[at] != kEmpty && values_[slots_[at]].word != word) at = (at + 1) & last;
    return at;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (size_t i = 0; i < values_.size(); ++i)
      slots_[slotOf(values_[i].word)] = static_cast<uint32_t>(i);
  }

  size_t most_;
  std::vector<uint32_t> slots_;
  std::vector<Value> values_;
};

/// Steps with a table, and their cost. bits: the geometric mean of the bits of the whole and of its
/// prefixes.
struct Candidate {
  HeightSteps steps;
  double bits = std::numeric_limits<double>::infinity();
};

class TableChoice {
 public:
  TableChoice(const tks_heights& heights, const HeightSteps& multiples)
      : heights_(heights),
        multiples_(multiples),
        samples_(multiples.validCount()),
        values_(std::min<size_t>(samples_ / kSamplesForAValue, GeometryLayers::kMostValues)) {}

  /// Whether the values are few enough for a table to be tried.
  bool hasFewValues() {
    int32_t low = INT32_MAX, high = INT32_MIN;
    withSampleType(heights_.sample, [&](auto type) {
      const auto* samples = static_cast<const decltype(type)*>(heights_.data);
      for (size_t i = 0; i < multiples_.steps.size() && !values_.tooMany(); ++i) {
        if (!isValid(i)) continue;
        values_.count(orderOf(samples[i]));
        low = std::min(low, multiples_.steps[i]);
        high = std::max(high, multiples_.steps[i]);
      }
    });
    if (values_.tooMany() || values_.size() < 2) return false;
    const double range = 1.0 + high - low;
    return !multiples_.exact || static_cast<double>(values_.size()) < kNearlyAll * range;
  }

  /// The best table, if it takes fewer bits than multiples.
  std::optional<HeightSteps> best() {
    sortValues();
    Candidate best;
    best.bits = exactBits(heights_, multiples_) * kClearly;
    for (const uint32_t least : kLeastUses) {
      const size_t rare = rarerThan(least);
      if (rare > samples_ / kSamplesForAnException) break;
      if (least > 1 && rare == rarerThan(least / 2)) continue;
      Candidate table = tableOf(least);
      if (table.bits < best.bits) best = std::move(table);
    }
    if (best.steps.table.empty()) return {};
    return std::move(best.steps);
  }

 private:
  bool isValid(size_t i) const { return multiples_.valid.empty() || multiples_.valid[i]; }

  void sortValues() {
    sorted_.resize(values_.size());
    std::iota(sorted_.begin(), sorted_.end(), 0u);
    std::sort(sorted_.begin(), sorted_.end(), [&](uint32_t a, uint32_t b) {
      const uint32_t x = values_[a].word, y = values_[b].word;
      return heights_.sample == TKS_U32 ? x < y : static_cast<int32_t>(x) < static_cast<int32_t>(y);
    });
  }

  /// How many samples have a value that occurs in fewer than `least` samples.
  size_t rarerThan(uint32_t least) const {
    size_t rare = 0;
    for (size_t i = 0; i < values_.size(); ++i)
      rare += values_[i].samples < least ? values_[i].samples : 0;
    return rare;
  }

  /// The table of the values that occur in `least` samples or more. All other samples get the place
  /// of the next smaller value in the table.
  Candidate tableOf(uint32_t least) const {
    Candidate out;
    std::vector<uint32_t>& words = out.steps.table.words;
    std::vector<int32_t> place(values_.size());
    std::vector<uint32_t> samples;  // that have each of them
    Exceptions exceptions;
    for (const uint32_t number : sorted_) {
      const Value& value = values_[number];
      if (value.samples >= least || words.empty()) {
        words.push_back(value.word);
        samples.push_back(value.samples);
      } else {
        exceptions.add(value.word - words.back(), value.samples);
      }
      place[number] = static_cast<int32_t>(words.size()) - 1;
    }
    if (words.size() < 2) return {};
    const ValueGaps gaps(samplesOf(words));
    addBridges(gaps, words, place);
    describe(place, out.steps);
    out.steps.exact = exceptions.count == 0;
    const double table_bits = 8.0 * static_cast<double>(encodeValueTable(out.steps.table).size());
    const double bits = bitsOfSteps(heights_, out.steps) + table_bits + exceptions.bits(samples_);
    const double uneven = gaps.unevenness(samples) * static_cast<double>(samples_);
    out.bits = std::sqrt(bits * (bits + uneven));
    return out;
  }

  std::vector<double> samplesOf(const std::vector<uint32_t>& words) const {
    std::vector<double> samples;
    withSampleType(heights_.sample, [&](auto type) {
      for (const uint32_t word : words)
        samples.push_back(static_cast<double>(fromOrder<decltype(type)>(word)));
    });
    return samples;
  }

  /// Adds bridges to the words of a table. place: of each value, which moves behind the bridges
  /// before it.
  void addBridges(const ValueGaps& gaps, std::vector<uint32_t>& words,
                  std::vector<int32_t>& place) const {
    std::vector<uint32_t> bridged;
    std::vector<int32_t> moved;
    withSampleType(heights_.sample, [&](auto type) {
      using T = decltype(type);
      for (size_t i = 0; i < words.size(); ++i) {
        const T next = fromOrder<T>(words[i]);
        for (const double value : gaps.bridge(i)) {
          const T between = restore<T>(value, 0, 0);
          if (between > fromOrder<T>(bridged.back()) && between < next)
            bridged.push_back(orderOf(between));
        }
        moved.push_back(static_cast<int32_t>(bridged.size()));
        bridged.push_back(words[i]);
      }
    });
    if (bridged.size() > GeometryLayers::kMostValues) return;
    words = std::move(bridged);
    for (int32_t& p : place) p = moved[static_cast<size_t>(p)];
  }

  /// Describes the steps, which count from the middle of the table, and the line that comes nearest
  /// to its values.
  void describe(const std::vector<int32_t>& place, HeightSteps& out) const {
    const std::vector<uint32_t>& words = out.table.words;
    const auto middle = static_cast<int32_t>(words.size() / 2);
    withSampleType(heights_.sample, [&](auto type) {
      using T = decltype(type);
      const auto value = [](uint32_t word) { return static_cast<double>(fromOrder<T>(word)); };
      const double range = value(words.back()) - value(words.front());
      out.step =
          range > 0 ? range / static_cast<double>(words.size() - 1) : 1;  // 0: it is 0 and -0
      out.base = value(words[static_cast<size_t>(middle)]);
      out.valid = multiples_.valid;
      out.steps.resize(multiples_.steps.size());
      const auto* samples = static_cast<const T*>(heights_.data);
      for (size_t i = 0; i < out.steps.size(); ++i) {
        if (isValid(i)) out.steps[i] = place[values_.numberOf(orderOf(samples[i]))] - middle;
      }
    });
    out.range_bits = static_cast<int>(std::bit_width(words.size()));
  }

  const tks_heights& heights_;
  const HeightSteps& multiples_;
  size_t samples_;
  Values values_;
  std::vector<uint32_t> sorted_;  ///< numbers of values, smallest sample first
};

}  // namespace

HeightSteps fewerBits(const tks_heights& heights, HeightSteps multiples) {
  TableChoice choice(heights, multiples);
  if (!choice.hasFewValues()) return multiples;
  std::optional<HeightSteps> table = choice.best();
  return table ? std::move(*table) : std::move(multiples);
}

}  // namespace tetrakis::inline quantiser
