// SPDX-License-Identifier: Apache-2.0
// DecodedMaps holds the maps of a material that an object has beside its texture, for the mesh that
// `tetrakis decode` writes: of a resampled one as atlases, laid out as that of its texture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/stream.hpp"

namespace tetrakis::tools {

class DecodedMaps {
 public:
  /// Those of which something is known: a cut stream may not have got to others, whose factors then
  /// count no more. Streams of other kinds have none. TKS_LIMIT where the memory does not hold them
  /// and `copies` bytes more.
  static Result<DecodedMaps> of(const OpenStream& stream, uint64_t copies);

  /// For a mesh that is written while this lives.
  MeshMaps forMesh() const;

 private:
  Status take(const OpenStream& stream, uint32_t component, MapKind kind, uint64_t copies);

  std::array<std::optional<ImageFile>, kMapKinds> images_;
  Material material_;
  bool is_lit_ = false;
};

/// Maps that the format of a mesh with this name has no place for, in a sentence; "": none.
std::string unwrittenNote(const std::string& name, const MeshMaps& maps);

}  // namespace tetrakis::tools
