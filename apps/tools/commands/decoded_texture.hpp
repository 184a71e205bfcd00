// SPDX-License-Identifier: Apache-2.0
// DecodedTexture holds the texture that `tetrakis decode` writes as an image and into a mesh, so
// that it is decoded once.
#pragma once

#include <cstdint>
#include <future>
#include <optional>

#include "apps/tools/commands/decode_arguments.hpp"
#include "apps/tools/commands/decode_memory.hpp"
#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// Both arguments outlive it.
class DecodedTexture {
 public:
  DecodedTexture(const DecodeArguments& arguments, OpenStream& stream)
      : arguments_(arguments), stream_(stream) {}

  /// Begins beside the heights where there are threads and memory for both. The bytes that it takes
  /// meanwhile.
  uint64_t begin(DecodeMemory& memory);

  /// Waits for it, or decodes it now.
  const Result<ImageFile>& get(const DecodeMemory& memory);

 private:
  const DecodeArguments& arguments_;
  OpenStream& stream_;
  std::future<Result<ImageFile>> beside_;
  std::optional<Result<ImageFile>> image_;
};

}  // namespace tetrakis::tools
