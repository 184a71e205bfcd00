// SPDX-License-Identifier: Apache-2.0
// meshError() tells how far the best mesh of few triangles is from the surface, and beyondError()
// which packets of heights improve on an error that is small beside that: a renderer of no more
// triangles does not show them (thesis 1.2.5, where it has enough).
#pragma once

#include <cstdint>
#include <span>

#include "api/decoder.hpp"
#include "ratecontrol/receiver/sent_pieces.hpp"

namespace tetrakis::inline api {

/// RMSE in the unit of the heights, which there are, over the samples that the mesh covers.
Result<double> meshError(tks_decoder& decoder, uint32_t max_triangles);

/// The bytes of a stream, of which `bytes` are there, that hold heights behind the packet with
/// which their stated RMSE comes down to `error`, in their unit. Only a front index lets packets be
/// left out; without one these are the bytes behind the last packet that is shown.
ByteRanges beyondError(const ParsedHeader& parsed, std::span<const uint8_t> bytes, double error);

}  // namespace tetrakis::inline api
