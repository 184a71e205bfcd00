// SPDX-License-Identifier: Apache-2.0
// DecodedNodes decodes some prefixes of both components for the cameras to look at. Each prefix is
// decoded from where the one before it ended, and to the end of a pass where there is one track, so
// that nothing has to be taken back. Prefixes that know only coarse levels are given to rays as
// coarse grids, which takes less time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "codec/geometry/heights_decoder.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "encoder/views/shown_mesh.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/screen_texture.hpp"

namespace tetrakis::inline views {

/// A component as it is coded, with the curve of its packets.
template <class Coded>
struct Rated {
  const Coded& coded;
  const ComponentCurve& curve;
};

/// Where the curve is one of whole passes these passes are decoded, else prefixes of any length.
template <class Coded>
bool endsWithPasses(const Rated<Coded>& rated) {
  return !rated.curve.passes.empty() && rated.coded.holdsCoefficientsAlone();
}

/// Decodes the inputs from the first bytes of either component. Calls must come with rising bytes,
/// and with ends of passes where the curve has them.
class DecodedNodes {
 public:
  DecodedNodes(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
               const Rated<CodedTexture>& texture);

  struct Samples {
    std::vector<std::byte> data;  ///< of the type of the inputs
    std::vector<uint8_t> valid;   ///< empty: all are
  };
  Samples heightsAt(uint64_t bytes, const View& view);
  /// The heights as viewers see them.
  Relief shownAt(uint64_t bytes);
  /// All heights as viewers see them, if viewers see a mesh.
  std::optional<Relief> meshOfAll() const { return mesh_ ? mesh_->ofOriginal() : std::nullopt; }
  Relief original() const;

  ScreenTexture textureAt(uint64_t bytes);
  const Texels& originalTexels() const { return texture_.coded.source->texels; }
  Texels texelsAt(uint64_t bytes, const View& view);

 private:
  DecodedHeights decodedAt(uint64_t bytes, const View& view);
  Relief reliefAt(uint64_t bytes);

  const EncodeInputs& inputs_;
  Rated<CodedHeights> heights_;
  Rated<CodedTexture> texture_;
  std::optional<ShownMesh> mesh_;  ///< null: viewers see the grid
  HeightsMemory heights_memory_;
  TextureMemory texture_memory_;
};

}  // namespace tetrakis::inline views
