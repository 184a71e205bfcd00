// SPDX-License-Identifier: Apache-2.0
#include "encoder/textures/texel_lines.hpp"

#include "encoder/inputs/repeated_lines.hpp"

namespace tetrakis::inline textures {

CodedLines texelLines(const EncodeInputs& inputs) {
  if (inputs.image == nullptr) return {};
  const tks_image& image = *inputs.image;
  CodedLines lines = linesThatPay(
      inputs.options,
      {image.data, {image.width, image.height}, image.channels * tks_sample_bytes(image.sample)},
      1);
  if (lines.repeats.none() || inputs.options.psnr == 0) return lines;
  const bool alpha = image.channels % 2 == 0;
  return lines.heaviest <= (alpha ? 1 : CodedLines::kNearlyAlike) ? lines : CodedLines();
}

}  // namespace tetrakis::inline textures
