// SPDX-License-Identifier: Apache-2.0
// readManifest() and writeManifest() read and write the list of conformance vectors: streams, where
// to cut them, and the answers that a decoder must give there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::conformance {

/// What the first `bytes` bytes of a stream decode to.
struct Cut {
  uint64_t bytes = 0;
  int level = 0;          ///< mip level of both components, or their coarsest if they end before it
  int status = TKS_OK;    ///< tks_status of opening and decoding
  std::string heights;    ///< sampleDigest of the height samples; "" when there are none
  std::string texture;    ///< sampleDigest of the texture samples; "" when there are none
  std::string triangles;  ///< cornerDigest of a triangle mesh; "" when there is none
  /// Number of the component that the decoder takes in the place of the first of its kind.
  std::optional<uint32_t> component = {};
};

struct Vector {
  std::string name;
  std::string file;     ///< relative to the manifest
  std::string purpose;  ///< the tools of the format that it exercises
  std::vector<Cut> cuts;
};

/// The manifest's name inside a directory of vectors.
inline constexpr const char* kManifestName = "manifest.json";

/// TKS_IO if there is no readable manifest in the directory, TKS_CORRUPT if it is not one.
Result<std::vector<Vector>> readManifest(const std::string& directory);

/// Replaces the manifest of the directory. TKS_IO if it cannot be written.
Status writeManifest(const std::string& directory, const std::vector<Vector>& vectors);

/// The whole file. TKS_IO with the path in the message.
Result<std::vector<uint8_t>> readFile(const std::string& path);

/// Replaces the file's content. TKS_IO with the path in the message.
Status writeFile(const std::string& path, const std::string& content);

}  // namespace tetrakis::conformance
