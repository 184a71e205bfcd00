// SPDX-License-Identifier: Apache-2.0
// decodeCut() decodes a prefix of a vector with the library, and returns the answer in the form of
// the manifest. It needs no file and no manifest.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "conformance/manifest.hpp"

namespace tetrakis::conformance {

/// What this library's decoder makes of `prefix` at a mip level (Cut::level); the manifest's
/// digests come from here. component: Cut::component.
Cut decodeCut(std::span<const uint8_t> prefix, int level = 0,
              std::optional<uint32_t> component = {});

}  // namespace tetrakis::conformance
