// SPDX-License-Identifier: Apache-2.0
// The table of conformance vectors: small inputs that together visit every tool of the format.
#include "conformance/vector_cases.hpp"

#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {
namespace {

using samples::Pattern;
using samples::Recipe;

tks_encode_options lossless() {
  tks_encode_options options = makeEncodeOptions();
  options.lossless = 1;
  return options;
}

tks_encode_options budget(uint64_t bytes) {
  tks_encode_options options = makeEncodeOptions();
  options.bytes = bytes;
  return options;
}

tks_encode_options maxError(double bound) {
  tks_encode_options options = makeEncodeOptions();
  options.max_error = bound;
  return options;
}

tks_encode_options indexed(tks_encode_options options) {
  options.index = 1;
  return options;
}

std::vector<VectorCase> geometryCases() {
  const auto heights = [](Pattern pattern, uint32_t width, uint32_t height, tks_sample sample) {
    return Recipe{pattern, width, height, 1, sample};
  };
  return {
      {"tiny_2x2",
       "smallest surface: corners only",
       heights(Pattern::kRidges, 2, 2, TKS_I16),
       {},
       lossless()},
      {"odd_3x17",
       "odd sizes; unequal sides",
       heights(Pattern::kRidges, 3, 17, TKS_U16),
       {},
       lossless()},
      {"flat_33x33",
       "no detail at all: empty bit-planes",
       heights(Pattern::kFlat, 33, 33, TKS_U16),
       {},
       lossless()},
      {"extreme_i16_17x17",
       "lowest and highest values side by side: every bit-plane is used",
       heights(Pattern::kExtreme, 17, 17, TKS_I16),
       {},
       lossless()},
      {"extreme_u8_9x20",
       "8-bit heights; long coefficients",
       heights(Pattern::kExtreme, 9, 20, TKS_U8),
       {},
       lossless()},
      {"wide_u32_20x12",
       "32-bit unsigned heights",
       heights(Pattern::kRidges, 20, 12, TKS_U32),
       {},
       lossless()},
      {"forest_160x5",
       "long side: many root squares in a row",
       heights(Pattern::kRidges, 160, 5, TKS_U16),
       {},
       lossless()},
      {"steps_40x40",
       "walls and terraces: runs of insignificance, abrupt signs",
       heights(Pattern::kSteps, 40, 40, TKS_I32),
       {},
       lossless()},
      {"negative_i16_48x31",
       "negative heights, scale and offset; ends within a max-error bound",
       heights(Pattern::kRidges, 48, 31, TKS_I16),
       {},
       maxError(3),
       0.1,
       -400},
      {"float_65x65",
       "32-bit float heights on an exact step",
       heights(Pattern::kRidges, 65, 65, TKS_F32),
       {},
       lossless()},
      {"geometry_budget_129x97",
       "geometry alone, cut by a byte budget in the middle of a packet",
       heights(Pattern::kRidges, 129, 97, TKS_U16),
       {},
       budget(6000)},
  };
}

std::vector<VectorCase> textureCases() {
  const auto image = [](Pattern pattern, uint32_t width, uint32_t height, uint32_t channels,
                        tks_sample sample) {
    return Recipe{pattern, width, height, channels, sample, 7};
  };
  return {
      {"texture_1x1",
       "smallest texture: no wavelet step",
       {},
       image(Pattern::kRidges, 1, 1, 3, TKS_U8),
       lossless()},
      {"grey_61x40", "one channel", {}, image(Pattern::kRidges, 61, 40, 1, TKS_U8), lossless()},
      {"grey_alpha_24x25",
       "two channels: grey and alpha",
       {},
       image(Pattern::kSteps, 24, 25, 2, TKS_U8),
       lossless()},
      {"rgb_50x37",
       "three channels: colour transform",
       {},
       image(Pattern::kRidges, 50, 37, 3, TKS_U8),
       lossless()},
      {"rgba_32x32",
       "four channels: alpha beside the colour transform",
       {},
       image(Pattern::kRidges, 32, 32, 4, TKS_U8),
       lossless()},
      {"rgb16_21x30",
       "16-bit texture",
       {},
       image(Pattern::kRidges, 21, 30, 3, TKS_U16),
       lossless()},
      {"checker_rgb_16x16",
       "highest frequency at full range: every bit-plane is used",
       {},
       image(Pattern::kChecker, 16, 16, 3, TKS_U8),
       lossless()},
      {"texture_budget_128x128",
       "texture alone, cut by a byte budget",
       {},
       image(Pattern::kRidges, 128, 128, 3, TKS_U8),
       budget(8000)},
  };
}

std::vector<VectorCase> jointCases() {
  const Recipe heights{Pattern::kRidges, 97, 97, 1, TKS_U16};
  const Recipe image{Pattern::kRidges, 128, 128, 3, TKS_U8, 7};
  const Recipe small_heights{Pattern::kRidges, 33, 33, 1, TKS_I16};
  const Recipe small_image{Pattern::kRidges, 40, 40, 3, TKS_U8, 7};
  return {
      {"joint_budget_97x97_128x128", "geometry and texture packets in one order, byte budget",
       heights, image, budget(12000)},
      {"joint_lossless_33x33_40x40", "geometry and texture to the last bit", small_heights,
       small_image, lossless()},
      {"joint_index_33x33_40x40", "front index before the packets", small_heights, small_image,
       indexed(lossless())},
  };
}

/// Streams that a decoder must refuse, by the byte that is wrong (docs/FORMAT.md, section 2).
std::vector<VectorCase> damagedCases() {
  const Recipe heights{Pattern::kRidges, 9, 9, 1, TKS_I16};
  const auto damaged = [&](const std::string& name, const std::string& purpose, int byte) {
    VectorCase vector_case{name, purpose, heights, {}, lossless()};
    vector_case.damaged_byte = byte;
    return vector_case;
  };
  return {damaged("damaged_magic", "not a Tetrakis stream", 0),
          damaged("damaged_version", "a format version from the future", 4),
          damaged("damaged_header", "the header's checksum does not match", 12)};
}

}  // namespace

std::vector<VectorCase> vectorCases() {
  std::vector<VectorCase> all = geometryCases();
  for (VectorCase& next : textureCases()) all.push_back(std::move(next));
  for (VectorCase& next : jointCases()) all.push_back(std::move(next));
  for (VectorCase& next : damagedCases()) all.push_back(std::move(next));
  return all;
}

Result<std::vector<uint8_t>> encodeCase(const VectorCase& vector_case) {
  samples::Raster surface, picture;
  tks_heights heights = {};
  tks_image image = {};
  if (vector_case.heights) {
    surface = samples::make(*vector_case.heights);
    heights = surface.heights();
    heights.scale = vector_case.scale;
    heights.offset = vector_case.offset;
    heights.unit = "m";
  }
  if (vector_case.texture) {
    picture = samples::make(*vector_case.texture);
    image = picture.image();
  }
  const auto stream = encode(vector_case.heights ? &heights : nullptr,
                             vector_case.texture ? &image : nullptr, vector_case.options);
  if (!stream) return Status(stream.error().code, vector_case.name + ": " + stream.error().message);
  std::vector<uint8_t> bytes(stream->bytes().begin(), stream->bytes().end());
  if (vector_case.damaged_byte >= 0) bytes[static_cast<size_t>(vector_case.damaged_byte)] ^= 0xff;
  return bytes;
}

}  // namespace tetrakis::conformance
