// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texels.hpp"

#include <algorithm>
#include <cstddef>

namespace tetrakis {

void thin(uint32_t step, Texels& texels) {
  if (step == 1) return;
  auto out = texels.samples.begin();
  for (uint32_t y = 0; y < texels.height; y += step) {
    for (uint32_t x = 0; x < texels.width; x += step) {
      const size_t from = (size_t{y} * texels.width + x) * texels.channels;
      out =
          std::copy_n(texels.samples.begin() + static_cast<ptrdiff_t>(from), texels.channels, out);
    }
  }
  texels.samples.erase(out, texels.samples.end());
  texels.width = (texels.width - 1) / step + 1;
  texels.height = (texels.height - 1) / step + 1;
}

}  // namespace tetrakis
