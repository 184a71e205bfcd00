// SPDX-License-Identifier: Apache-2.0
// lookAtPairs() measures the pictures of pairs of prefixes of a stream's two tracks, which span the
// plane of heights and textures (thesis, 6.3 and figures 6.6 to 6.8), and withPaths() finds the
// ways through it that spend bytes best.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "apps/tools/report/comparison.hpp"
#include "apps/tools/report/split_stream.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// A pair of prefixes, and dB over all cameras; infinity: exact.
struct SeenPair {
  Split split;
  double psnr = 0;
};

struct PairPlane {
  std::vector<uint64_t> heights, textures;  ///< bytes, rising at equal ratios
  std::vector<double> psnr;                 ///< one row of textures after the other
  std::vector<SeenPair> hull;    ///< exhaustive search: corners of the lower hull of all pairs
  std::vector<SeenPair> greedy;  ///< marginal analysis, from all bytes down to the fewest
  size_t looked = 0;             ///< pairs that it had to look at
  std::vector<Split> shipped;    ///< what the stream's own order gives either track
  std::vector<SeenPair> equal_psnr, equal_bytes;  ///< models to be marked; may be empty

  size_t pairs() const { return heights.size() * textures.size(); }
  double at(size_t height, size_t texture) const {
    return psnr[height * textures.size() + texture];
  }
};

/// Which pairs are looked at: of each track at most so many prefixes, from few bytes to all.
struct PlaneGrid {
  size_t most = 6;
  double ratio = 2.5;  ///< of the bytes of two neighbours, at most; 0: as the number needs it
};

/// The plane with its hull, and with the path of the marginal analysis (thesis 6.3.2): it begins
/// with all bytes and gives up those of either track that cost least error a byte, one step of the
/// grid at a time.
PairPlane withPaths(PairPlane plane);

/// Told the part of the pairs that are drawn, from 0 to 1.
using PlaneProgress = std::function<void(double done)>;

/// Draws all pairs. comparer: has cameras. triangles: as Comparer::measure() has them.
Result<PairPlane> lookAtPairs(Comparer& comparer, const SplitStream& tracks, const PlaneGrid& grid,
                              uint32_t triangles, const PlaneProgress& progress);

}  // namespace tetrakis::tools
