// SPDX-License-Identifier: Apache-2.0
// DecodeMemory bounds the memory that `tetrakis decode` takes beside the decoder: for the stream,
// for the decoded samples, and for writing them. The decoder knows the limit and checks its own
// share (Decoder::checkMemory()).
#pragma once

#include <cstdint>
#include <optional>

#include "apps/tools/commands/decode_arguments.hpp"

namespace tetrakis::tools {

/// Both arguments outlive it.
class DecodeMemory {
 public:
  DecodeMemory(const DecodeArguments& arguments, OpenStream& stream)
      : arguments_(arguments), stream_(stream), info_(stream.decoder.info()) {}

  /// That each of the outputs can be had, before there is any work.
  Status check();
  /// That the mesh can be had beside other bytes.
  Status checkMesh(uint64_t beside = 0);

  /// Bytes of a texture that is decoded beside the heights; nothing if there is no memory for both.
  std::optional<uint64_t> textureBeside();

  /// Bytes of the stream and of copies of each output.
  uint64_t heights() const;
  uint64_t texture() const;

 private:
  Status checkHeights(uint64_t beside = 0);
  Status check(tks_part part, const std::optional<tks_window>& window, uint64_t copies);
  uint64_t mesh() const;

  const DecodeArguments& arguments_;
  OpenStream& stream_;
  const tks_info& info_;
};

}  // namespace tetrakis::tools
