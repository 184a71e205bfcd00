// SPDX-License-Identifier: Apache-2.0
// The functions here write decoded heights and texels as the samples that the caller wants. A
// component without any byte is the same everywhere: one sample is decoded and copied, so that its
// planes take no memory.
#pragma once

#include <cstddef>

#include "api/decoder.hpp"
#include "base/texels.hpp"

namespace tetrakis::inline api {

/// out: as many samples of the stream's type, or floats, as there are decoded heights.
void writeHeights(const tks_decoder& decoder, const DecodedHeights& decoded, void* out);
void writeSurface(const tks_decoder& decoder, const DecodedHeights& decoded, float* out);

/// out: as many samples of that type as the texels have.
void writeTexels(const Texels& texels, tks_sample sample, void* out);

/// Write so many samples (heights, or texels) of a component of which nothing was sent.
void writeUnsentHeights(const tks_decoder& decoder, void* out, size_t count);
void writeUnsentSurface(const tks_decoder& decoder, float* out, size_t count);
void writeUnsentTexels(const TextureHeader& header, void* out, size_t count);

}  // namespace tetrakis::inline api
