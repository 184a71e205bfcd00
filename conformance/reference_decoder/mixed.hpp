// SPDX-License-Identifier: Apache-2.0
// Reference decoder: decisions that several models foretell (docs/FORMAT.md, section 4).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {

inline constexpr int64_t kFirstWeight = 20000;

/// FORMAT 4, "Mixed decision". Nothing: it does not count.
std::optional<int> decodeMixed(RangeDecoder& decoder, std::span<Model* const> models,
                               std::span<int64_t> weights);

}  // namespace tetrakis::reference
