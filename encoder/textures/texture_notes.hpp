// SPDX-License-Identifier: Apache-2.0
// planOf() reads the plan of a texture from its header. note(), notePassed() and the others
// tell the notes of an encoding, if somebody asked for them, of textures that were weighed.
#pragma once

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/plans/plan_notes.hpp"
#include "encoder/textures/coded_texture.hpp"

namespace tetrakis::inline textures {

/// header: with filters, if it is that of coded coefficients.
Plan planOf(const TextureHeader& header);

/// Notes a texture that was coded. need: bytes of its tracks that the target needs, at most.
void note(const EncodeInputs& inputs, const CodedTexture& coded, Verdict verdict,
          uint64_t need = UINT64_MAX);

/// Notes what encodeTexture() has passed over.
void notePassed(const EncodeInputs& inputs, const TextureSource& source,
                const PassedTextures& passed);

/// Notes that storing the samples is expected to take so many bytes, which are too many.
void noteStoredExpected(const EncodeInputs& inputs, uint64_t bytes);

}  // namespace tetrakis::inline textures
