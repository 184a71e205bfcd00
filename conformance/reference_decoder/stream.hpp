// SPDX-License-Identifier: Apache-2.0
// Reference decoder: header fields and the two codewords (docs/FORMAT.md, sections 2 and 3).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "conformance/reference_decoder.hpp"

namespace tetrakis::reference {

enum SampleType { kU8, kI8, kU16, kI16, kU32, kI32, kF32 };

struct GeometryHeader {
  int width = 0, height = 0, sample = 0, fractionBits = 0, planes = 0;
  double base = 0, step = 1;
};

struct TextureHeader {
  int width = 0, height = 0, channels = 0, sample = 0, planes = 0;
  std::array<int, 4> centre = {}, priority = {};
  int colourOrder = 0;
  std::array<int, 6> shear = {};
};

struct Stream {
  Outcome outcome = Outcome::kDone;
  std::optional<GeometryHeader> geometry;
  std::optional<TextureHeader> texture;
  std::array<std::vector<uint8_t>, 2> codewords;  ///< by track: 0 geometry, 1 texture
};

/// Splits a prefix of a stream into what its header says and the bytes of its tracks.
Stream readStream(std::span<const uint8_t> prefix);

}  // namespace tetrakis::reference
