// SPDX-License-Identifier: Apache-2.0
// Rasters of forests to encode, whose patches have the samples that they share.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "base/forest.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

struct ForestRaster {
  Forest forest;
  samples::Raster raster;

  /// Heights or texels of a recipe, whose size is that of the forest.
  ForestRaster(Forest of, samples::Recipe recipe) : forest(std::move(of)) {
    recipe.width = forest.raster().width;
    recipe.height = forest.raster().height;
    raster = make(recipe);
    const size_t size = recipe.channels * tks_sample_bytes(recipe.sample);
    shareOwned(forest, std::span(raster.data), forest.side() - 1, size);
  }

  template <class T>
  std::vector<T> samples() const {
    std::vector<T> values(raster.data.size() / sizeof(T));
    std::memcpy(values.data(), raster.data.data(), raster.data.size());
    return values;
  }
  tks_forest shape() const {
    return {static_cast<uint32_t>(forest.depth()), forest.patches(), forest.sides().data()};
  }
  tks_heights heights() const {
    tks_heights heights = raster.heights();
    heights.domain = TKS_DOMAIN_FOREST;
    heights.forest = shape();
    return heights;
  }
  tks_image image() const {
    tks_image image = raster.image();
    image.domain = TKS_DOMAIN_FOREST;
    image.forest = shape();
    return image;
  }
  Bytes encoded(const tks_encode_options& options) const {
    return encodeHeights(heights(), options);
  }
  Bytes encodedTexels(const tks_encode_options& options) const {
    const tks_image texels = image();
    return encodeGiven(nullptr, &texels, options);
  }
};

}  // namespace tetrakis::test
