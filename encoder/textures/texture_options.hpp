// SPDX-License-Identifier: Apache-2.0
// textureOptions() makes the options for coding a texture from the options of an encoding.
#pragma once

#include "base/texels.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline textures {

/// inputs: with an image, which is `texels`.
TextureOptions textureOptions(const EncodeInputs& inputs, const Texels& texels);

}  // namespace tetrakis::inline textures
