// SPDX-License-Identifier: Apache-2.0
// combinedStream() joins the packets of several streams in one order, behind one header. Nothing is
// coded anew. checkKept() compares the result with the streams that it was made of.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "encoder/combination/combined_header.hpp"
#include "encoder/combination/combined_part.hpp"

namespace tetrakis::inline combination {

struct CombinedStream {
  std::vector<uint8_t> bytes;
  std::vector<std::vector<uint8_t>> numbers;  ///< as of CombinedHeader
};

/// The stream of all parts; or no more than its first `budget` bytes, which promise nothing.
/// TKS_USAGE: the header takes more; or as of combinedHeader().
Result<CombinedStream> combinedStream(const std::vector<CombinedPart>& parts,
                                      std::optional<uint64_t> budget);

/// Whether each packet holds what it held in its part, and, of a whole stream, none is missing.
/// TKS_MISMATCH, which is a fault of the encoder.
Status checkKept(const CombinedStream& stream, const std::vector<CombinedPart>& parts,
                 bool is_whole);

}  // namespace tetrakis::inline combination
