// SPDX-License-Identifier: Apache-2.0
// writeStream() turns a Selection, the coded components with their packets in one order, into the
// bytes of a stream. It makes the part of the header that says where the samples lie, and notes the
// plans that the stream holds.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bitstream/stream/georeference.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline selection {

// georeferenceOf() and positionsOf() make the part of the header that says where heights and
// texture lie, from the places that the caller gives. A texture over the same ground takes one
// byte.

/// The positions of heights or of an image, which may be null; "" if it has none.
template <class Raster>
std::string positionsOf(const Raster* raster) {
  if (raster == nullptr || raster->positions == nullptr) return {};
  return {reinterpret_cast<const char*>(raster->positions), raster->positions_size};
}

/// The parts of a header that say what the samples mean and where they lie: metadata, places,
/// positions. Either may be null.
void describePlace(const tks_heights* heights, const tks_image* image, StreamHeader& header);

/// The front index of packets.
std::vector<IndexEntry> indexOf(const std::vector<Packet>& packets, const TrackCounts& counts);

// A Selection is the content of a stream before it is written: both coded components, and the
// packets of both in one order.

struct Selection {
  std::shared_ptr<const CodedHeights> heights;  ///< null: there are none
  std::shared_ptr<const CodedTexture> texture;  ///< null: there is none
  std::vector<Packet> packets;
};

// noteTaken() and noteOthers() tell the notes of an encoding which components were taken, and which
// were left for these.

/// Notes the components of a selection that lost within the budget, but for those that the better
/// one holds as well.
void noteOthers(const EncodeInputs& inputs, const Selection& better, const Selection& lost);

// writeStream() writes the finished stream of a selection: the header, its index, and the packets
// that fit the budget. It notes the plans of what it has written as taken.

/// How many bytes the header of a stream of these packets takes if the stream is not lossless.
uint64_t headerBytesOf(const EncodeInputs& inputs, const Selection& selection);

/// Whether all samples come back, with the header and all packets within the budget.
bool isLossless(const EncodeInputs& inputs, const Selection& selection);

/// TKS_USAGE: the budget is too small for the header.
Result<std::vector<uint8_t>> writeStream(const EncodeInputs& inputs, const Selection& selection);

}  // namespace tetrakis::inline selection
