// SPDX-License-Identifier: Apache-2.0
#include "conformance/decode_cut.hpp"

#include <algorithm>
#include <vector>

#include "conformance/digest.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {
namespace {

void addSamples(const Result<std::vector<std::byte>>& decoded, std::vector<std::byte>& all,
                int& status) {
  if (decoded) all.insert(all.end(), decoded->begin(), decoded->end());
  if (!decoded) status = decoded.status().code();
}

}  // namespace

Cut decodeCut(std::span<const uint8_t> prefix, int level) {
  Cut cut;
  cut.bytes = prefix.size();
  cut.level = level;
  auto decoder = Decoder::open(prefix);
  if (!decoder) {
    cut.status = decoder.status().code();
    return cut;
  }
  if (level > 0) {
    const auto up_to = [&](uint32_t coarsest) {
      return std::min(static_cast<uint32_t>(level), coarsest);
    };
    const tks_info info = decoder->info();
    const auto set =
        decoder->setLevels(up_to(info.coarsest_level), up_to(info.texture_coarsest_level));
    if (!set.ok()) cut.status = set.code();
  }
  std::vector<std::byte> heights, texture;  // of all frames, one behind the other
  for (uint32_t t = 0; t < decoder->info().frames; ++t) {
    if (const auto set = decoder->setFrame(t); !set.ok()) cut.status = set.code();
    if (decoder->info().has_heights) addSamples(decoder->heights(), heights, cut.status);
    if (decoder->info().has_texture) addSamples(decoder->texture(), texture, cut.status);
  }
  if (cut.status == TKS_OK && decoder->info().has_heights)
    cut.heights = sampleDigest(heights, decoder->info().sample);
  if (cut.status == TKS_OK && decoder->info().has_texture)
    cut.texture = sampleDigest(texture, decoder->info().texture_sample);
  if (decoder->info().object_triangles > 0) {
    const auto mesh = decoder->objectMesh(TKS_MESH_BUDGET);
    if (mesh.ok()) cut.triangles = cornerDigest(*mesh);
    if (!mesh.ok()) cut.status = mesh.status().code();
  }
  return cut;
}

}  // namespace tetrakis::conformance
