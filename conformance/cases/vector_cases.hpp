// SPDX-License-Identifier: Apache-2.0
// vectorCases() lists the inputs from which the conformance vectors are encoded, and encodeCase()
// encodes one of them.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "conformance/samples/few_texels.hpp"
#include "conformance/samples/few_values.hpp"
#include "conformance/samples/offset_heights.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::conformance {

/// One vector: what to encode, how, and why.
struct VectorCase {
  std::string name;
  std::string purpose;
  std::optional<samples::Recipe> heights;
  std::optional<samples::Recipe> texture;
  tks_encode_options options = {};
  double scale = 1, offset = 0;
  std::optional<samples::FewValues> values;    ///< u8 heights are made into samples of these
  std::optional<samples::OffsetKind> offsets;  ///< u16 heights become floats in steps above these
  bool patches = false;   ///< u8 heights have few values in patches, before `values`
  double facets = 0;      ///< > 0: heights are floats, linear between points so far apart
  bool gridless = false;  ///< heights are divided by about 3, so that no step holds them
  std::optional<samples::VoidShape> voids;
  std::optional<samples::VoidShape> water;  ///< at one of two levels there, left and right
  uint32_t copies[2] = {1, 1};              ///< heights are enlarged so many times, across and down
  std::optional<samples::VoidShape> cutout;   ///< alpha is 0 there, else the largest value
  std::optional<samples::VoidShape> overlay;  ///< drawn over there
  uint32_t levels = 0;  ///< > 0: u8 texels become samples of `levels_of` with so many values
  tks_sample levels_of = TKS_U8;
  bool opaque = false;                ///< the texture has no alpha
  uint32_t white_level = 0;           ///< of the texture; 0: found
  uint32_t texel_copies[2] = {1, 1};  ///< the image is enlarged so many times, across and down
  double nodata = NAN;                ///< the value of voids; a number is declared
  bool apart = false;                 ///< valid samples that equal nodata are changed
  int exponent = 0;                   ///< float heights are multiplied by 2^exponent
  uint32_t spikes = 0;                ///< one in so many heights stands out of a plain
  bool placed = false;                ///< heights and texture have a georeference
  bool ring = false;                  ///< the columns of heights and texture go round
  std::vector<uint32_t> sides;        ///< not empty: both lie on forests of this many sides
  std::vector<int32_t> corners;       ///< not empty: heights lie over a base mesh; 12 a patch
  uint32_t corner_bits = 0;           ///< of a coordinate of these
  bool told = false;                  ///< a camera looks down on the north-west
  std::vector<uint8_t> stream;        ///< not empty: nothing is encoded, these are the bytes
  bool dense = false;                 ///< cuts lie close to each other in the middle
  int damaged_byte = -1;              ///< inverted after encoding; such a stream must not open
};

/// All cases, in the order of the manifest.
std::vector<VectorCase> vectorCases();

/// Sequences, whose `stream` is there already.
std::vector<VectorCase> sequenceCases();

/// The complete stream of a case.
Result<std::vector<uint8_t>> encodeCase(const VectorCase& vector_case);

}  // namespace tetrakis::conformance
