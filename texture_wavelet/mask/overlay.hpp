// SPDX-License-Identifier: Apache-2.0
// What somebody has drawn over a photograph: lettering, boundaries, borders without data, water in
// one colour. A wavelet rings along all of it. Encoder only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/texels.hpp"

namespace tetrakis {

/// For each texel 1 if it belongs to the photograph, 0 to the overlay; empty if there is none worth
/// trying. Each of its colours fills at least 1/2000 of the texels, and half of those are like the
/// one before. seen: 0 for texels whose colours do not matter, which no overlay needs to draw;
/// empty: all do.
std::vector<uint8_t> photographOf(const Texels& texels, std::span<const uint8_t> seen = {});

}  // namespace tetrakis
