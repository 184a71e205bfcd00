// SPDX-License-Identifier: Apache-2.0
// Receivers of bench/transmission: what each fetches for a camera, and what it then shows.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/report/scene.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Heights in their unit, and an 8-bit RGB image over them.
struct Ground {
  tools::Surface heights;
  tools::ImageFile image;
  GroundFrame frame;
  double step = 1;  ///< of the heights' samples, in the unit
};

/// What one exchange took.
struct Exchange {
  uint64_t bytes = 0;    ///< that came
  uint64_t again = 0;    ///< of these, had come before
  uint64_t control = 0;  ///< that went to the server
};

class Receiver {
 public:
  virtual ~Receiver() = default;
  /// Asks for at most so many bytes, knowing this camera, and takes them.
  virtual Result<Exchange> fetch(const Camera& camera, uint64_t bytes) = 0;
  /// Whether it asks for each part of the bytes, a latency before that comes.
  virtual bool asks() const = 0;
  virtual Result<Ground> shown() const = 0;
};

/// The stream in its order.
Result<std::unique_ptr<Receiver>> prefixReceiver(std::span<const uint8_t> stream,
                                                 const Ground& truth);

/// tks_plan for the camera, tks_put for what comes.
Result<std::unique_ptr<Receiver>> planningReceiver(std::span<const uint8_t> stream,
                                                   const Ground& truth);

enum class TileCodec { kTetrakis, kJpeg2000 };

/// A pyramid of tiles, each a file of its own: 128 x 128 heights and the texels over them, coarse
/// levels first, at each level the tiles that the camera sees. All files together take `bytes`, of
/// which `heights_share` for heights. Tetrakis tiles show what there is of them, JPEG 2000 tiles
/// when they are whole.
Result<std::unique_ptr<Receiver>> tileReceiver(const Ground& truth, TileCodec codec, uint64_t bytes,
                                               double heights_share);

}  // namespace tetrakis::bench
