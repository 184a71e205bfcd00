// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/coded_lines.hpp"

#include "codec/ground/frame.hpp"

namespace tetrakis::inline inputs {

tks_heights CodedLines::of(const tks_heights& whole) const {
  tks_heights coded = whole;
  coded.width = extent.width;
  coded.height = extent.height;
  coded.data = samples.data();
  const GroundFrame frame =
      knownFrame({whole.width, whole.height, whole.spacing_x, whole.spacing_y, 1});
  coded.spacing_x = frame.spacing_x * whole.width / extent.width;
  coded.spacing_y = frame.spacing_y * whole.height / extent.height;
  return coded;
}

tks_image CodedLines::of(const tks_image& whole) const {
  tks_image coded = whole;
  coded.width = extent.width;
  coded.height = extent.height;
  coded.data = samples.data();
  return coded;
}

}  // namespace tetrakis::inline inputs
