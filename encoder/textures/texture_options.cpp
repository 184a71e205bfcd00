// SPDX-License-Identifier: Apache-2.0
#include "encoder/textures/texture_options.hpp"

#include "encoder/inputs/region_choice.hpp"

namespace tetrakis::inline textures {

namespace {

/// The largest number of texels in one region. A larger number saves more textures the bytes that
/// regions cost; their windows then take the whole texture.
constexpr uint64_t kOneRegionTexels = 2048 * 2048;

}  // namespace

TextureOptions textureOptions(const EncodeInputs& inputs, const Texels& texels) {
  const tks_encode_options& options = inputs.options;
  const Extent extent = texels.extent();
  const RegionChoice regions = chooseRegions(options, extent, extent.samples() > kOneRegionTexels);
  const ViewPriorities* const priorities = inputs.priorities;
  const bool some_first = priorities != nullptr && !priorities->texture.empty();
  const bool to_psnr = options.psnr > 0;
  const double heaviest = inputs.heaviestTexel();
  return {.limit = limitOf(inputs),
          .region_log2 = regions.side_log2,
          .threads = options.threads,
          .windows = regions.windows,
          .visual = options.weights == TKS_WEIGHTS_VISUAL,
          .room = inputs.budgeted() ? options.bytes : UINT64_MAX,
          .mean_square = to_psnr ? worstMeanSquare(texels.white(), options.psnr) / heaviest : 0,
          .priorities = some_first ? &priorities->texture : nullptr};
}

}  // namespace tetrakis::inline textures
