// SPDX-License-Identifier: Apache-2.0
#include "conformance/digest.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "conformance/sha256.hpp"

namespace tetrakis::conformance {

std::string sampleDigest(std::span<const std::byte> samples, tks_sample sample) {
  std::vector<std::byte> bytes(samples.begin(), samples.end());
  if constexpr (std::endian::native == std::endian::big) {
    const auto width = static_cast<std::ptrdiff_t>(tks_sample_bytes(sample));
    for (auto at = bytes.begin(); at != bytes.end(); at += width) std::reverse(at, at + width);
  }
  return sha256({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
}

std::string doublesDigest(std::span<const double> values) {
  std::vector<uint8_t> bytes;
  for (const double value : values) {
    const auto bits = std::bit_cast<uint64_t>(value);
    for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<uint8_t>(bits >> (8 * i)));
  }
  return sha256(bytes);
}

std::string cornerDigest(const ObjectMesh& mesh) {
  std::vector<double> all;
  const auto add = [&](std::span<const double> values, size_t count) {
    for (const uint32_t corner : mesh.triangles()) {
      const auto of_corner = values.subspan(count * corner, count);
      all.insert(all.end(), of_corner.begin(), of_corner.end());
    }
  };
  add(mesh.positions(), 3);
  if (!mesh.texcoords().empty()) add(mesh.texcoords(), 2);
  return doublesDigest(all);
}

}  // namespace tetrakis::conformance
