// SPDX-License-Identifier: Apache-2.0
// The maps of an object: images that lie on its mesh beside the texture, and become further
// components of its stream. takenMaps() checks them, and withMaps() puts them into a stream.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "api/object_inputs.hpp"
#include "base/forest.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline api {

/// An image of a mesh as texels of the patches of an object.
class PatchTexels {
 public:
  /// image: of the mesh, checked. depth: of the forest.
  PatchTexels(const GivenObject& given, const tks_image& image, const ResampledObject& object,
              int depth);
  PatchTexels(const PatchTexels&) = delete;
  PatchTexels& operator=(const PatchTexels&) = delete;

  /// It shows what lives as long as this.
  const tks_image& image() const { return image_; }

 private:
  Forest forest_;
  std::vector<uint8_t> bytes_;
  std::vector<uint16_t> shorts_;
  tks_image image_;
};

/// TKS_USAGE with a sentence.
Result<std::vector<GivenMap>> takenMaps(const tks_triangle_mesh& mesh, bool has_image);

/// How many texels of its image and of its maps the mesh shows: of that which has most.
double shownTexels(const GivenObject& given);

/// Adds the maps of the object to its stream, and what its material is if that is not there yet,
/// within the bytes of the options.
Result<CodedObject> withMaps(GivenObject& given, CodedObject coded);

}  // namespace tetrakis::inline api
