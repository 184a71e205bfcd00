// SPDX-License-Identifier: Apache-2.0
// A finished stream leaves the encoder through prove(), which decodes it and refuses one that
// breaks a promise, and giveBytes(), which hands its bytes to the caller; explain() tells the plans
// that were weighed for it.
#pragma once

#include <cstdint>
#include <span>

#include "api/group_chain.hpp"
#include "encoder/encode_stream.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// Copies the caller's heights as this library knows them. TKS_USAGE: they break a rule of
/// tetrakis.h.
Status checkedHeights(const tks_heights& given, tks_heights& out);

// giveBytes() copies bytes into a buffer that the caller releases.

/// Copies bytes to where tks_free_buffer() finds them. out: has none. Throws std::bad_alloc.
void giveBytes(std::span<const uint8_t> bytes, tks_buffer& out);

// prove() decodes a finished stream through the public interface and compares it with the input:
// the byte budget, the largest error, and every bit where the stream calls itself lossless. No
// caller gets a stream that breaks a promise.

/// Limits that no stream meets.
tks_limits unlimited();

/// The inputs that a stream was made of.
struct StreamSource {
  std::span<const tks_heights> heights;  ///< of each frame; empty: none
  std::span<const tks_image> images;
  References references = {};  ///< what the frames go on from
};

/// Decodes the finished stream through the public interface and compares: a budget, a largest
/// error, and every bit where the target or the stream says lossless. TKS_MISMATCH with a sentence
/// if a promise is broken, which is a fault of the encoder. Streams that promise nothing are not
/// decoded.
Status prove(std::span<const uint8_t> stream, const StreamSource& source,
             const tks_encode_options& options);

// explain() tells a caller of tks_encode() the plans that the encoder weighed.

/// Calls options.explain, which is not null, for each plan. scale: of the heights; 1 without them.
void explain(const PlanNotes& notes, double scale, const tks_encode_options& options);

}  // namespace tetrakis::inline api
