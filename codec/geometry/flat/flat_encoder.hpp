// SPDX-License-Identifier: Apache-2.0
// FlatFinder finds the flat areas of heights in steps, encodeFlatAreas() codes the chosen ones
// (flat_pass.hpp), and sampleParts() gives the parts of the plane on which they are chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "base/view.hpp"
#include "codec/geometry/flat/flat_areas.hpp"

namespace tetrakis::inline flat {

/// The areas that are wanted.
struct FlatShape {
  uint32_t least;     ///< samples of an area, at least
  uint8_t reach = 0;  ///< > 0: opened by squares of that reach (codec/wavelet/morphology.hpp)
};

/// The areas of one height in a plane, of any size.
class FlatFinder {
 public:
  /// The values of the heights, and the forest that they are the raster of, outlive this object.
  /// forest: null: of none.
  explicit FlatFinder(const PlaneView<const int32_t>& heights, const Forest* forest = nullptr);

  Extent extent() const { return heights_.extent(); }

  /// The number of samples in a window that belong to areas of `least` samples or more.
  uint64_t samplesOf(uint32_t least, const Window& window) const;

  /// The areas of a shape as a window shows them, without the samples that touch larger areas of
  /// another height. None if the window shows no area, or too many.
  FlatAreas areas(const FlatShape& shape, const Window& window) const;

 private:
  std::vector<uint8_t> marked(uint32_t least, const Window& window) const;
  static constexpr uint32_t kFirst = uint32_t{1} << 31;
  static constexpr uint32_t kMostSize = kFirst - 1;

  /// Whether the window is all of a forest.
  bool isForest(const Window& window) const {
    return forest_ != nullptr && window.extent() == extent();
  }
  bool none() const { return areas_.empty(); }
  /// The size of the area of a sample; 0 for voids.
  uint32_t sizeAt(size_t sample) const {
    const uint32_t area = areas_[sample];
    return (area >= kFirst ? area : areas_[area]) & kMostSize;
  }

  PlaneView<const int32_t> heights_;
  const Forest* forest_;
  /// Of the first sample of an area kFirst and the area's size, at most kMostSize; of another
  /// sample the place of the first one.
  std::vector<uint32_t> areas_;
};

/// valid: the samples that are not void. There are areas.
std::vector<uint8_t> encodeFlatAreas(const FlatAreas& areas, Extent plane, Mask valid);

// sampleParts() chooses parts of a plane in which flat areas and other heights meet. The encoder
// decides on these parts which flat areas save bytes, as they stand for the rest of the plane.

struct SampledPart {
  Window window;
  double stands_for;  ///< how many times its own samples
};

/// Returns one part, the whole plane, if that is small; else parts of each of three kinds: those
/// with samples of areas of at least `large` samples and others, those of the rest with samples of
/// areas of at least `small`, and those without. They are taken at equal distances along the rows
/// of parts of their kind. patch_rows: as of PlaneView; no part reaches into two patches.
std::vector<SampledPart> sampleParts(const FlatFinder& finder, uint32_t large, uint32_t small,
                                     uint32_t patch_rows = 0);

}  // namespace tetrakis::inline flat
