// SPDX-License-Identifier: Apache-2.0
#include "encoder/textures/texel_lines_to_code.hpp"

#include "encoder/inputs/repeated_lines.hpp"

namespace tetrakis::inline textures {

CodedLines texelLinesToCode(const EncodeInputs& inputs) {
  const tks_encode_options& options = inputs.options;
  if (inputs.image == nullptr || options.picture_error != nullptr) return {};
  const tks_image& image = *inputs.image;
  CodedLines lines = findRepeatedLines(
      {image.data, {image.width, image.height}, image.channels * tks_sample_bytes(image.sample)},
      1);
  if (lines.repeats.none()) return lines;
  const double most = image.channels % 2 == 0 ? 1 : 1.1;
  if (options.psnr > 0 && lines.heaviest > most) return {};
  if (inputs.budgeted() && lines.codeIsLongFor(options.bytes)) return {};
  return lines;
}

}  // namespace tetrakis::inline textures
