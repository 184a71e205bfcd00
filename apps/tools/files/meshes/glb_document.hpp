// SPDX-License-Identifier: Apache-2.0
// Glb collects the parts of a binary glTF 2.0 file while it grows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/little_endian.hpp"

namespace tetrakis::tools {

/// An array of one. Braces would not do: compilers disagree on whether {value} is an array or a
/// copy.
inline nlohmann::json listOf(nlohmann::json value) {
  return nlohmann::json::array({std::move(value)});
}

/// The document and its binary chunk.
struct Glb {
  nlohmann::json document;
  LittleEndianBuffer binary;

  /// Appends bytes and returns where they begin.
  template <class T>
  size_t addBytes(std::span<const T> values) {
    binary.padTo4('\0');
    const size_t offset = binary.bytes.size();
    binary.putAll(values);
    return offset;
  }

  size_t addView(nlohmann::json view) {
    document["bufferViews"].push_back(std::move(view));
    return document["bufferViews"].size() - 1;
  }

  /// A view of values. target 0: no vertex or index data.
  template <class T>
  size_t addView(std::span<const T> values, int target) {
    nlohmann::json view{
        {"buffer", 0}, {"byteOffset", addBytes(values)}, {"byteLength", values.size_bytes()}};
    if (target != 0) view["target"] = target;
    return addView(std::move(view));
  }

  size_t addAccessor(nlohmann::json accessor) {
    document["accessors"].push_back(std::move(accessor));
    return document["accessors"].size() - 1;
  }

  /// needed: without it nothing is to be seen.
  void useExtension(const char* name, bool needed) {
    const auto add = [name](nlohmann::json& names) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    add(document["extensionsUsed"]);
    if (needed) add(document["extensionsRequired"]);
  }
};

/// The mesh, with material 0.
Status addGeometry(Glb& glb, const MeshFile& mesh, MeshCompression compression);

/// One more image, and a texture of it, whose number comes back; it repeats if texcoords lie beyond
/// it. TKS_USAGE: the format cannot hold the image.
Result<size_t> addTexture(Glb& glb, const ImageFile& image, std::span<const float> texcoords,
                          MeshTexture format);

/// Textures of maps, which a material of glTF then names beside its factors.
Status addMaps(Glb& glb, const MeshFile& mesh, MeshTexture format, nlohmann::json& material);

}  // namespace tetrakis::tools
