// SPDX-License-Identifier: Apache-2.0
// Encodes a ramp, cuts the stream, decodes a mesh: by installed headers and libraries alone.
#include <cstdio>
#include <vector>

#include "tetrakis/tetrakis.hpp"

int main() {
  std::vector<float> samples(64 * 64);
  for (int i = 0; i < 64 * 64; ++i)
    samples[static_cast<size_t>(i)] = static_cast<float>((i % 64) * (i / 64)) / 100;
  tks_heights heights = tetrakis::makeHeights();
  heights.width = heights.height = 64;
  heights.sample = TKS_F32;
  heights.data = samples.data();
  tks_encode_options options = tetrakis::makeEncodeOptions();
  options.bytes = 1000;
  const auto stream = tetrakis::encode(&heights, nullptr, options);
  if (!stream) return std::puts(stream.status().message().c_str()), 1;
  auto decoder = tetrakis::Decoder::open(stream->bytes().first(500));
  if (!decoder) return std::puts(decoder.status().message().c_str()), 1;
  const auto mesh = decoder->budgetMesh(100);
  return mesh && mesh->triangleCount() > 10 && mesh->triangleCount() <= 100 ? 0 : 1;
}
