// SPDX-License-Identifier: Apache-2.0
// Longitudes and latitudes for receivers that know few reference systems, as browsers do: GDAL
// tells them, and the stream takes them along. It follows the command line
// (apps/tools/files/place).
#pragma once

#include <memory>
#include <string>

#include <gdal_priv.h>
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

struct CopiedHeights;
struct CopiedTexture;

/// From columns and rows of a dataset to longitude and latitude, for as long as it is kept.
class WebGround {
 public:
  /// Null where browsers know `crs` themselves, or GDAL knows no way.
  static std::unique_ptr<WebGround> of(GDALDataset& dataset, const std::string& crs);
  /// A tks_locator; user: the WebGround.
  static int locate(void* user, double column, double row, double* longitude, double* latitude);

  struct Destroy {
    void operator()(void* transformer) const;
  };

 private:
  std::unique_ptr<void, Destroy> transformer_;
};

/// Gives heights, texture or both their positions where browsers need them and `most_bytes` hold
/// them; either may be null. A warning about `name` tells which cannot be fitted.
void addPositions(const std::string& name, CopiedHeights* heights, CopiedTexture* texture,
                  uint64_t most_bytes);

/// What they may take: a 64th of the stream, or of a byte a sample where nothing says how long that
/// is to be. Either may be null.
uint64_t positionBytes(const tks_heights* heights, const tks_image* texture,
                       const tks_encode_options& options);

}  // namespace tetrakis::gdal
