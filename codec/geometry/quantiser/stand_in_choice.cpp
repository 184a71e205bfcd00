// SPDX-License-Identifier: Apache-2.0
// A polyline is refined greedily: the next knot is the value that errs most in the segment that
// errs most (U. Ramer, "An iterative procedure for the polygonal approximation of plane curves",
// 1972; errors are weighted with the number of samples of each value). Each polyline on the way is
// a candidate. A knot pays if it takes off more error a byte than the table itself does later: then
// the product of error and bytes falls.
#include "codec/geometry/quantiser/value_choice.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <functional>

#include "base/samples.hpp"
#include "bitstream/stream/fields.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/values/value_table.hpp"

namespace tetrakis::inline quantiser {

namespace {

/// The part of the table's bytes that knots take at most: tables take up to 3 % of a stream, and a
/// stream of heights with many values is not to pay for its early prefixes. A smaller number gives
/// prefixes more knots.
constexpr size_t kMostOfTable = 32;

/// A stretch of the polyline between two knots, and the place between them that errs most.
struct Segment {
  uint32_t first, last;
  uint32_t worst = 0;
  double squares = 0;
};

class Polylines {
 public:
  Polylines(const HeightSteps& steps, const GeometryHeader& header, double most)
      : table_(steps.table), header_(header), most_(most), samples_(table_.words.size()) {
    for (size_t i = 0; i < steps.steps.size(); ++i) {
      if (steps.valid.empty() || steps.valid[i]) ++samples_[table_.placeOf(steps.steps[i])];
    }
    rounding_ = static_cast<double>(steps.validCount()) / 12;
    for (const ValueInSteps& value : valuesInSteps(table_, header)) {
      const auto place = static_cast<int64_t>(rises_.size());
      rises_.push_back(std::clamp(value.height - 16 * (place - middle()),
                                  -GeometryLayers::kMostRise, GeometryLayers::kMostRise));
    }
  }

  /// Squared error of samples, in steps, with the given knots.
  double squaresOf(const std::vector<TableKnot>& knots) const {
    return withSampleType(static_cast<tks_sample>(header_.sample), [&](auto type) {
      using T = decltype(type);
      const StandIn stand_in(knots, values());
      double squares = 0;
      for (uint32_t place = 0; place < values(); ++place) {
        const auto q = static_cast<int32_t>(place - middle());
        const int32_t whole =
            knots.empty() ? q : wholeStep(stand_in.heightOf(q, 0), StandIn::kFractionBits);
        const auto shown = static_cast<double>(restore<T>(header_.base, header_.step, whole));
        const auto value = static_cast<double>(fromOrder<T>(table_.words[place]));
        const double error = (shown - value) / header_.step;
        if (samples_[place] > 0) squares += samples_[place] * std::min(error * error, most_);
      }
      return squares;
    });
  }

  /// Receives a polyline and its estimated error; the rounding of heights to whole steps counts as
  /// a twelfth.
  using Attempt = std::function<void(const std::vector<TableKnot>& knots, double squares)>;

  /// Attempts polylines, from the one between the ends of the table on, each with one knot more.
  void refine(const Attempt& attempt) const {
    std::vector<TableKnot> knots = {knotAt(0), knotAt(values() - 1)};
    std::vector<Segment> segments = {measured({0, values() - 1})};
    double squares = segments.front().squares + rounding_;
    attempt(knots, squares);
    while (knots.size() < GeometryLayers::kMostKnots) {
      const auto worst = std::max_element(
          segments.begin(), segments.end(),
          [](const Segment& a, const Segment& b) { return a.squares < b.squares; });
      if (worst->squares <= 0) return;
      const Segment split = *worst;
      *worst = measured({split.first, split.worst});
      const Segment right = measured({split.worst, split.last});
      squares -= split.squares - worst->squares - right.squares;
      segments.push_back(right);
      const auto after = std::find_if(knots.begin(), knots.end(),
                                      [&](const TableKnot& k) { return k.place > split.worst; });
      knots.insert(after, knotAt(split.worst));
      attempt(knots, squares);
    }
  }

 private:
  uint32_t values() const { return static_cast<uint32_t>(table_.words.size()); }
  int64_t middle() const { return values() / 2; }
  TableKnot knotAt(uint32_t place) const { return {place, rises_[place]}; }

  Segment measured(Segment segment) const {
    const auto run = static_cast<double>(segment.last - segment.first);
    const auto low = static_cast<double>(rises_[segment.first]);
    const auto high = static_cast<double>(rises_[segment.last]);
    double most = 0;
    for (uint32_t place = segment.first + 1; place < segment.last; ++place) {
      const double line = low + (high - low) * (place - segment.first) / run;
      const double error = (static_cast<double>(rises_[place]) - line) / 16;
      const double squares = samples_[place] * std::min(error * error, most_);
      segment.squares += squares;
      if (squares > most) segment.worst = place;
      most = std::max(most, squares);
    }
    return segment;
  }

  const ValueTable& table_;
  const GeometryHeader& header_;
  double most_;
  double rounding_ = 0;
  std::vector<uint32_t> samples_;  ///< that have each value
  std::vector<int64_t> rises_;     ///< of each value, as TableKnot::rise
};

size_t bytesOf(const std::vector<TableKnot>& knots, uint32_t values) {
  GeometryLayers layers;
  layers.table_bytes = 1;
  layers.table_values = values;
  const auto size = [&] {
    FieldWriter writer;
    layers.visit(writer);
    return writer.bytes.size();
  };
  const size_t without = size();
  layers.table_knots = knots;
  return size() - without;
}

}  // namespace

StandInChoice chooseStandIn(const HeightSteps& steps, const GeometryHeader& header,
                            size_t table_bytes, double most) {
  assert(!steps.table.empty());
  const Polylines polylines(steps, header, most);
  StandInChoice best{{}, polylines.squaresOf({})};
  double least = best.squares * static_cast<double>(table_bytes);
  polylines.refine([&](const std::vector<TableKnot>& knots, double squares) {
    const size_t bytes = bytesOf(knots, static_cast<uint32_t>(steps.table.words.size()));
    const double cost = squares * static_cast<double>(table_bytes + bytes);
    if (bytes > table_bytes / kMostOfTable || cost >= least) return;
    least = cost;
    best.knots = knots;
  });
  best.squares = polylines.squaresOf(best.knots);
  return best;
}

}  // namespace tetrakis::inline quantiser
