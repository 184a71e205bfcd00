// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/flat_areas.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/flat/flat_pass.hpp"

namespace tetrakis::inline flat {

namespace {

/// Marked samples of a row that follow one another.
struct Run {
  uint32_t begin, end;
  uint32_t label;
};

/// The first of a row of marks that is `mark`, from x on; its width if there is none.
uint32_t nextOf(uint8_t mark, std::span<const uint8_t> row, uint32_t x) {
  const void* found = std::memchr(row.data() + x, mark, row.size() - x);
  return static_cast<uint32_t>(found == nullptr ? row.size()
                                                : static_cast<const uint8_t*>(found) - row.data());
}

/// Calls visit(y, run) for the runs of marked samples, row by row, and touch(label, above) for each
/// run above that touches it. Its label is that of the first of these, else the next new one; so
/// labels rise with their first samples, and only one row of runs is known at a time. Returns how
/// many labels there are.
template <class Visit, class Touch>
uint32_t forEachRun(const PlaneView<const uint8_t>& flat, const Visit& visit, const Touch& touch) {
  std::vector<Run> above, runs;
  uint32_t labels = 0;
  for (uint32_t y = 0; y < flat.height; ++y) {
    if (flat.patch_rows > 0 && y % flat.patch_rows == 0) above.clear();
    const std::span row(flat.row(y), flat.width);
    auto first = above.cbegin();  // that may touch the next run
    for (uint32_t x = nextOf(1, row, 0), end = 0; x < flat.width; x = nextOf(1, row, end)) {
      end = nextOf(0, row, x);
      while (first != above.cend() && first->end <= x) ++first;
      const bool touches = first != above.cend() && first->begin < end;
      const Run run{x, end, touches ? first->label : labels++};
      runs.push_back(run);
      for (auto other = first; other != above.cend() && other->begin < end; ++other)
        touch(run.label, other->label);
      visit(y, run);
    }
    above.swap(runs);
    runs.clear();
  }
  return labels;
}

constexpr auto kNothing = [](auto...) {};

}  // namespace

namespace {

/// The labels of samples at the sides of patches, by which areas go on in the next patch.
class SideLabels {
 public:
  explicit SideLabels(const Forest& forest)
      : forest_(forest),
        n_(forest.side() - 1),
        labels_(forest.patches() * Forest::kSides * size_t{n_}, kNone) {}

  /// row: of the raster.
  void note(uint32_t row, const Run& run) {
    const uint32_t y = row % (n_ + 1);
    for (uint32_t x = run.begin; x < run.end; ++x)
      if (x == 0 || x == n_ || y == 0 || y == n_)
        labels_[placeOf(row / (n_ + 1), x, y)] = run.label;
  }
  void join(JoinedLabels& joined) const {
    const auto label = [&](const Forest::Place& at) {
      return labels_[placeOf(at.patch, static_cast<uint32_t>(at.x), static_cast<uint32_t>(at.y))];
    };
    forest_.forEachShared(n_, [&](const Forest::Place& sample, const Forest::Place& owner) {
      if (label(sample) != kNone) joined.join(label(sample), label(owner));
    });
  }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  /// The first and the last row of a patch, then what is left of its first and last column.
  size_t placeOf(uint32_t patch, uint32_t x, uint32_t y) const {
    const size_t before = patch * Forest::kSides * size_t{n_}, width = size_t{n_} + 1;
    if (y == 0 || y == n_) return before + (y == 0 ? 0 : width) + x;
    return before + 2 * width + (x == 0 ? 0 : n_ - 1) + y - 1;
  }

  const Forest& forest_;
  uint32_t n_;
  std::vector<uint32_t> labels_;
};

}  // namespace

/// Labels are joined where they touch, and the first of the joined labels stands for an area. The
/// plane is visited three times, so that labels need not be kept for all samples.
NumberedAreas numberAreas(const PlaneView<const uint8_t>& mask, const Forest* forest) {
  PlaneView<const uint8_t> flat = mask;
  if (forest != nullptr) flat.patch_rows = forest->side();
  assert(flat.extent().samples() <= GeometryLayers::kMostFlatSamples);
  JoinedLabels joined(forEachRun(flat, kNothing, kNothing));
  std::optional<SideLabels> sides;
  if (forest != nullptr) sides.emplace(*forest);
  forEachRun(
      flat,
      [&](uint32_t y, const Run& run) {
        if (sides) sides->note(y, run);
      },
      [&](uint32_t label, uint32_t above) { joined.join(label, above); });
  if (sides) sides->join(joined);
  NumberedAreas areas;
  std::vector<uint32_t> numbers = std::move(joined).earlier();
  for (uint32_t label = 0; label < numbers.size(); ++label) {
    const bool first = numbers[label] == label;
    if (first && areas.count++ == GeometryLayers::kMostFlatAreas) return {};
    numbers[label] = first ? areas.count : numbers[numbers[label]];
  }
  areas.numbers.resize(flat.extent().samples());
  const auto number = [&](uint32_t y, const Run& run) {
    std::fill_n(areas.numbers.begin() + static_cast<ptrdiff_t>(size_t{y} * flat.width + run.begin),
                run.end - run.begin, static_cast<uint16_t>(numbers[run.label]));
  };
  forEachRun(flat, number, kNothing);
  return areas;
}

namespace {

bool holdsAny(const BitPlane& flat) {
  for (uint32_t y = 0; y < flat.extent().height; ++y)
    if (flat.countBefore(flat.extent().width, y) > 0) return true;
  return false;
}

}  // namespace

FlatAreas decodeFlatAreas(std::span<const uint8_t> codeword, Extent plane, const SharedBits& valid,
                          uint32_t areas, const Forest* forest) {
  DecisionDecoding io(codeword);
  NumberedAreas numbered;
  {
    FlatMaskIo<DecisionDecoding<>> mask_io(io, valid.get(), nullptr);
    const BitPlane flat = ValidityPass<FlatMaskIo<DecisionDecoding<>>>(plane, mask_io).run();
    if (!io.stopped() && holdsAny(flat)) {
      std::vector<uint8_t> mask = flat.bytes();
      if (forest != nullptr) shareOwned(*forest, std::span(mask), forest->side() - 1);
      numbered = numberAreas(PlaneView<const uint8_t>(mask, plane), forest);
    }
  }
  if (numbered.count != areas) return {};
  FlatAreas out{std::move(numbered.numbers), std::vector<int32_t>(areas)};
  FlatHeightsPass<DecisionDecoding<>>(io).run(out.heights);
  if (io.stopped()) return {};
  return out;
}

}  // namespace tetrakis::inline flat
