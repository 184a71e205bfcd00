// SPDX-License-Identifier: Apache-2.0
// Prefixes of both components as decoders show them, for cameras to look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "encoder/coded_heights.hpp"
#include "encoder/coded_texture.hpp"
#include "encoder/inputs.hpp"
#include "encoder/shown_mesh.hpp"
#include "ratecontrol/component_curve.hpp"
#include "ratecontrol/ground_rays.hpp"
#include "ratecontrol/screen_texture.hpp"

namespace tetrakis::inline encoder {

/// A component as it is coded, with the curve of its packets.
template <class Coded>
struct Rated {
  const Coded& coded;
  const ComponentCurve& curve;
};

/// What decoders show of the inputs after the bytes of some nodes; calls must come with rising
/// nodes, the last one for the original.
class DecodedNodes {
 public:
  DecodedNodes(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
               const Rated<CodedTexture>& texture);

  struct Samples {
    std::vector<std::byte> data;  ///< of the type of the inputs
    std::vector<uint8_t> valid;   ///< empty: all are
  };
  Samples heightsAt(size_t point, const View& view);
  bool showsMeshes() const { return mesh_.has_value(); }
  /// What viewers see of the heights.
  Relief shownAt(size_t point);
  /// What they see of all heights, if that is a mesh.
  std::optional<Relief> meshOfAll() const { return mesh_ ? mesh_->ofOriginal() : std::nullopt; }
  Relief original() const;

  ScreenTexture textureAt(size_t point);
  Texels texelsAt(size_t point, const View& view);

 private:
  DecodedHeights decodedAt(size_t point, const View& view);
  Relief reliefAt(size_t point);

  const EncodeInputs& inputs_;
  Rated<CodedHeights> heights_;
  Rated<CodedTexture> texture_;
  std::optional<ShownMesh> mesh_;  ///< what viewers see, if it is not the grid
  HeightsMemory heights_memory_;
  TextureMemory texture_memory_;
};

}  // namespace tetrakis::inline encoder
