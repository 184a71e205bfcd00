// SPDX-License-Identifier: Apache-2.0
// codeHeightFrames() and codeTextureFrames() turn the frames of a group into a component of a
// stream, and CodedGroup measures the errors of its prefixes over all frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "encoder/groups/frame_steps.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline groups {

/// The group before in a sequence, as the first bytes of its stream show it.
struct GroupBefore {
  uint64_t bytes = 0;
  std::optional<GeometryHeader> heights;
  std::optional<TextureHeader> texture;
  /// The last frame of each; null where there is none.
  std::shared_ptr<const FrameReference> last_heights = nullptr, last_texture = nullptr;
};

/// The frames of a group; exactly one of the options' targets is set.
struct GroupInputs {
  std::vector<tks_heights> heights;  ///< of each frame, alike but for their samples; empty: none
  std::vector<tks_image> images;     ///< likewise
  const tks_encode_options& options;
  const GroupBefore* before = nullptr;  ///< what they may go on from; null: nothing

  size_t frames() const { return heights.empty() ? images.size() : heights.size(); }
  /// The first frame, which says what all have in common.
  EncodeInputs first() const {
    return {.heights = heights.empty() ? nullptr : heights.data(),
            .image = images.empty() ? nullptr : images.data(),
            .options = options};
  }
};

/// Heights of a group, with what their prefixes are measured against.
struct HeightFrames {
  FrameSteps truth;
  std::shared_ptr<const CodedHeights> coded;

  double counted() const;
  /// Squared error in steps of the valid samples of all frames.
  double squaresOf(const Codewords& prefix, uint32_t threads, HeightsMemory* memory) const;
};

/// Likewise a texture.
struct TextureFrames {
  std::vector<Texels> truth;
  std::shared_ptr<const CodedTexture> coded;

  double counted() const;
  /// Squared error of the samples of all frames.
  double squaresOf(const Codewords& prefix, uint32_t threads, TextureMemory* memory) const;
};

/// TKS_USAGE: a sample is infinite. TKS_UNSUPPORTED: as of stepsOfFrames().
Result<HeightFrames> codeHeightFrames(const GroupInputs& inputs);
/// Coding for a PSNR ends by the account, and may end too early. to_the_end: it does not.
TextureFrames codeTextureFrames(const GroupInputs& inputs, bool to_the_end = false);

}  // namespace tetrakis::inline groups
