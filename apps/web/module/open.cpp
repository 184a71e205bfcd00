// SPDX-License-Identifier: Apache-2.0
// Opens streams: one that stands by itself, or that of a group of a sequence behind the streams of
// the groups that it goes on from.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "api/group_chain.hpp"
#include "api/guarded.hpp"
#include "bitstream/stream/header.hpp"
#include "tetrakis/tetrakis.h"

using tetrakis::Result, tetrakis::Status;

/// The streams of a run of groups, from a point of entry on.
struct web_chain {
  explicit web_chain(double max_memory) {
    limits.size = sizeof limits;
    limits.max_memory = static_cast<uint64_t>(max_memory);
  }

  tks_limits limits = {};
  std::vector<std::vector<uint8_t>> streams;
  tetrakis::GroupChain links{&limits};  ///< of all streams whose next one was there
};

/// Links all streams, the last one to that which `data` begins.
static Status link(web_chain& chain, std::span<const uint8_t> data) {
  const size_t streams = chain.streams.size();
  for (size_t i = chain.links.length(); i < streams; ++i) {
    const auto next = tetrakis::readHeader(i + 1 < streams ? chain.streams[i + 1] : data);
    if (!next.ok()) return next.status();
    if (Status status = chain.links.add(chain.streams[i], next->header); !status.ok())
      return status;
  }
  return {};
}

extern "C" {

/// A chain without streams. What opens behind it may take so much memory.
web_chain* web_chain_new(double max_memory) {
  return new web_chain(max_memory);
}
void web_chain_free(web_chain* chain) {
  delete chain;
}
/// Adds a stream, which is copied. What was opened behind those before is closed.
void web_chain_push(web_chain* chain, const uint8_t* data, size_t size) {
  chain->streams.emplace_back(data, data + size);
}

/// tks_open, behind the streams of a chain, which outlives the decoder. heights, texture: numbers
/// of the components that are taken; below 0: the first ones.
tks_status web_open(web_chain* chain, const uint8_t* data, size_t size, int heights, int texture,
                    tks_decoder** out, char* message, size_t message_size) {
  return tetrakis::reporting(message, message_size, [&] {
    if (Status status = link(*chain, {data, size}); !status.ok()) return status;
    tetrakis::ComponentChoice choice;
    if (heights >= 0) choice.heights = heights;
    if (texture >= 0) choice.texture = texture;
    Result<tetrakis::OwnedDecoder> opened =
        tetrakis::openBehind({data, size}, &chain->limits, chain->links.references(), choice);
    if (opened.ok()) *out = opened->release();
    return opened.status();
  });
}

}  // extern "C"
