// SPDX-License-Identifier: Apache-2.0
// Reference decoder: decisions that several models foretell (docs/FORMAT.md, section 4).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {

struct ModelTable : std::vector<Model> {
  using std::vector<Model>::vector;
  Model& operator[](int i) { return at(static_cast<size_t>(i)); }
};

inline constexpr int64_t kFirstWeight = 20000;

/// FORMAT 4, "Mixed decision".
int decodeMixed(RangeDecoder& decoder, std::span<Model* const> models, std::span<int64_t> weights);

}  // namespace tetrakis::reference
