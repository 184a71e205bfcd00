// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/region_masks.hpp"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/stream/fields.hpp"
#include "bitstream/track/track.hpp"
#include "codec/lattice/validity.hpp"

namespace tetrakis::inline geometry {

static_assert(SampleMarks::kLevelLog2 == kRegionLevels && kFinerLevels == kRegionLevels);

namespace {

/// Samples of the plane of a group around a window that three levels of any filter reach, at most
/// 7 * 18 (encoder/mosaic/mosaic_grid.hpp).
constexpr uint64_t kReach = 128;

/// The samples of a window that are at multiples of 2^shift, in numbers of these.
Window sparse(const Window& window, int shift) {
  const auto up = [&](uint32_t end) { return ((end - 1) >> shift) + 1; };
  const uint32_t x = window.x >> shift, y = window.y >> shift;
  return {x, y, up(window.x + window.width) - x, up(window.y + window.height) - y};
}

/// A window with all that lies within a distance.
Window grown(const Window& window, uint64_t distance, Extent plane) {
  const auto low = [&](uint32_t from) {
    return static_cast<uint32_t>(from - std::min<uint64_t>(from, distance));
  };
  const auto high = [&](uint32_t to, uint32_t side) {
    return static_cast<uint32_t>(std::min<uint64_t>(to + distance, side));
  };
  const uint32_t x = low(window.x), y = low(window.y);
  return {x, y, high(window.x + window.width, plane.width) - x,
          high(window.y + window.height, plane.height) - y};
}

/// The finest group of whose samples a view needs the mask.
size_t finestGroup(const std::vector<RegionGroup>& groups, const View& view) {
  return std::min(static_cast<size_t>(view.level / kRegionLevels), groups.size());
}

/// The regions of each group whose masks a view needs: those that its coefficients lie in, and
/// those that lie above them. None of groups that are finer than the view.
std::vector<Window> neededRegions(const std::vector<RegionGroup>& groups, const View& view,
                                  Extent plane) {
  std::vector<Window> needed(groups.size());
  Window samples{0, 0, plane.width, plane.height};
  if (view.window) {
    samples = {view.firstColumn(), view.firstRow(), ((view.window->width - 1) << view.level) + 1,
               ((view.window->height - 1) << view.level) + 1};
  }
  for (size_t g = finestGroup(groups, view); g < groups.size(); ++g) {
    samples = grown(samples, kReach << (kRegionLevels * g), plane);
    needed[g] = groups[g].meeting(samples);
    samples = groups[g].samplesOf(needed[g]);
  }
  return needed;
}

/// The marks of some regions of a group, above those of the next group.
LevelMarks decodeGroup(const TakenLayers& taken, const RegionGroup& group, const Window& regions,
                       int shift, const LevelMarks& above) {
  const Window samples = sparse(group.samplesOf(regions), shift);
  LevelMarks out{samples, BitPlane(samples.extent())};
  for (uint32_t row = regions.y; row < regions.y + regions.height; ++row) {
    for (uint32_t column = regions.x; column < regions.x + regions.width; ++column) {
      const Window all = group.samplesOf(column, row), region = sparse(all, shift);
      Window coarse = sparse(all, shift + kRegionLevels);
      coarse.x -= above.samples.x;
      coarse.y -= above.samples.y;
      const size_t track = static_cast<size_t>(group.numberOf(column, row));
      out.marks.mark(decodeFinerValidity(taken.region_validity[track - 1], region.extent(),
                                         above.marks.cut(coarse)),
                     region.x - samples.x, region.y - samples.y);
    }
  }
  return out;
}

/// Takes a mask with its length off the front of a codeword. Returns whether all of it is there.
bool takeMask(std::span<const uint8_t>& codeword, std::span<const uint8_t>& validity) {
  FieldReader reader(codeword);
  const uint64_t bytes = reader.take();
  codeword = codeword.subspan(reader.ok() ? reader.position() : codeword.size());
  validity = codeword.first(static_cast<size_t>(std::min<uint64_t>(bytes, codeword.size())));
  codeword = codeword.subspan(validity.size());
  return reader.ok() && validity.size() == bytes;
}

/// Calls visit(track, above) for the regions of all groups, from the coarsest on. above: the track
/// of the region of the next group that it lies under; 0: the base.
template <class Visit>
void forEachRegion(const std::vector<RegionGroup>& groups, const Visit& visit) {
  for (size_t g = groups.size(); g-- > 0;) {
    for (uint32_t row = 0; row < groups[g].rows; ++row) {
      for (uint32_t column = 0; column < groups[g].columns; ++column) {
        uint64_t above = 0;
        if (g + 1 < groups.size()) {
          const Window region = groups[g + 1].meeting(groups[g].samplesOf(column, row));
          assert(region.width == 1 && region.height == 1);
          above = groups[g + 1].numberOf(region.x, region.y);
        }
        visit(static_cast<size_t>(groups[g].numberOf(column, row)), static_cast<size_t>(above));
      }
    }
  }
}

std::vector<RegionGroup> groupsOf(const GeometryHeader& header) {
  return regionGroups(header.extent(), header.regions.side_log2);
}

}  // namespace

void takeRegionMasks(TakenLayers& taken) {
  taken.region_validity.resize(taken.other_coefficients.size());
  std::vector<bool> whole(1 + taken.other_coefficients.size(), true);
  // What lies under a region of which not all is known may change, even where it is known itself.
  forEachRegion(groupsOf(taken.header), [&](size_t track, size_t above) {
    std::span<const uint8_t>& codeword = taken.other_coefficients[track - 1];
    const bool any = !codeword.empty();
    whole[track] = takeMask(codeword, taken.region_validity[track - 1]) && whole[above];
    taken.masks_whole = taken.masks_whole && (whole[track] || !any);
  });
}

SampleMarks decodeRegionMasks(const TakenLayers& taken, const View& view) {
  const Extent plane = taken.header.extent();
  const std::vector<RegionGroup> groups = groupsOf(taken.header);
  const Window all{0, 0, plane.width, plane.height};
  const std::vector<Window> needed = neededRegions(groups, view, plane);
  const size_t finest = finestGroup(groups, view);
  const Window base = sparse(all, kRegionLevels * static_cast<int>(groups.size()));
  std::vector<LevelMarks> levels = {{base, decodeValidity(taken.validity, base.extent())}};
  for (size_t g = groups.size(); g-- > finest;)
    levels.push_back(decodeGroup(taken, groups[g], needed[g], kRegionLevels * static_cast<int>(g),
                                 levels.back()));
  if (view.isWhole()) return shared(std::move(levels.back().marks));
  std::reverse(levels.begin(), levels.end());
  return SampleMarks(std::move(levels), static_cast<int>(finest));
}

uint64_t regionMaskBytes(const GeometryHeader& header, const View& view) {
  const Extent plane = header.extent();
  const std::vector<RegionGroup> groups = groupsOf(header);
  const Window all{0, 0, plane.width, plane.height};
  const std::vector<Window> needed = neededRegions(groups, view, plane);
  const auto sparseBytes = [](const Window& samples, size_t group) {
    return validityBytes(sparse(samples, kRegionLevels * static_cast<int>(group)).extent());
  };
  uint64_t bytes = sparseBytes(all, groups.size());
  for (size_t g = finestGroup(groups, view); g < groups.size(); ++g) {
    const Window samples = groups[g].samplesOf(needed[g]);
    // The last region of a group is its largest in each direction, or as large as the others.
    const Window last = groups[g].samplesOf(groups[g].columns - 1, groups[g].rows - 1);
    const uint32_t side = uint32_t{1} << groups[g].side_log2;
    const Window largest{0, 0, std::max(last.width, std::min(side, plane.width)),
                         std::max(last.height, std::min(side, plane.height))};
    bytes += sparseBytes(samples, g) + 2 * sparseBytes(largest, g);
  }
  return bytes;
}

void addMaskTracks(const GeometryHeader& header, std::vector<bool>& needed) {
  std::vector<size_t> tracks_above(needed.size());
  forEachRegion(groupsOf(header), [&](size_t track, size_t above) { tracks_above[track] = above; });
  for (size_t track = tracks_above.size(); track-- > 1;)
    if (needed[track]) needed[tracks_above[track]] = true;
}

}  // namespace tetrakis::inline geometry
