// SPDX-License-Identifier: Apache-2.0
// A PassedTexture is an attempt to code a texture, or the estimate of one, that another attempt has
// won over. encodeTexture() lists them for callers who want to know what was weighed; the functions
// here do nothing where the list is null. Encoder only.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/stream/encoded_texture.hpp"

namespace tetrakis::inline texture {

enum class PassedFor : uint8_t {
  kExpectedLonger,  ///< an estimate says that it takes more bytes: it was not coded
  kLonger,          ///< it takes as many bytes as the whole of another one, or more
  kShowsWorse       ///< what its prefixes show counts for more than its bytes (showsBetter())
};

struct PassedTexture {
  TextureHeader header;  ///< without filters and tables if it was not coded
  PassedFor reason = PassedFor::kShowsWorse;
  uint64_t bytes = 0;  ///< of its tracks
  double squares = 0;  ///< the squared error that these leave; 0 of an estimate
};

using PassedTextures = std::vector<PassedTexture>;

PassedTexture passedOf(const EncodedTexture& encoded);

/// Lists an attempt over which another one has won, with the reason that their bytes give.
void passOver(PassedTextures* list, PassedTexture lost, const EncodedTexture& winner);

/// Lists a way to code the texture that would take so many bytes: with its samples stored, or else
/// by wavelet.
void passOverExpected(PassedTextures* list, bool stored, uint64_t bytes);

}  // namespace tetrakis::inline texture
