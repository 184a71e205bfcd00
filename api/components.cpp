// SPDX-License-Identifier: Apache-2.0
// Which components a stream has, and which of them a decoder takes for its heights and its texture.
#include "tetrakis/components.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "api/decoder.hpp"
#include "api/group_chain.hpp"
#include "api/guarded.hpp"

namespace tetrakis::inline api {
namespace {

Status checkNumber(const StreamHeader& header, uint32_t number) {
  const size_t count = header.components.size();
  if (number < count) return {};
  return {TKS_USAGE, "The stream has no component " + std::to_string(number) + "; it has " +
                         std::to_string(count) + ", from 0 on."};
}

uint64_t availableBytes(const tks_decoder& decoder, uint32_t number) {
  const Demultiplexed& payload = decoder.packets.payload;
  uint64_t bytes = 0;
  for (const PacketHead& head : payload.heads)
    if (head.number == number) bytes += head.length;
  const auto& open = payload.end.open;
  return open && open->number == number ? bytes - (open->length - payload.end.seen) : bytes;
}

tks_component_kind kindOf(const ListedComponent& one) {
  if (one.isHeights()) return TKS_COMPONENT_HEIGHTS;
  return one.isTexture() ? TKS_COMPONENT_TEXTURE : TKS_COMPONENT_UNKNOWN;
}

Status getComponent(const tks_decoder& decoder, uint32_t number, tks_component& out) {
  const StreamHeader& header = decoder.parsed.header;
  if (Status status = checkNumber(header, number); !status.ok()) return status;
  const ListedComponent& one = header.components[number];
  tks_component full{};
  full.kind = kindOf(one);
  full.name = one.details.name.c_str();
  full.is_taken = one.component != Component::kOther;
  if (full.kind != TKS_COMPONENT_UNKNOWN) {
    full.width = one.domain.grid.width;
    full.height = one.domain.grid.height;
    full.domain = static_cast<tks_domain>(one.domain.kind);
  }
  full.available_bytes = availableBytes(decoder, number);
  giveSized(full, out);
  return {};
}

Status chooseComponent(tks_decoder& decoder, uint32_t number) {
  const StreamHeader& header = decoder.parsed.header;
  if (Status status = checkNumber(header, number); !status.ok()) return status;
  if (!decoder.pieces.empty())
    return {TKS_USAGE, "A component is chosen before more bytes are given to the decoder."};
  ComponentChoice choice = header.choice;
  switch (kindOf(header.components[number])) {
    case TKS_COMPONENT_HEIGHTS:
      choice.heights = number;
      break;
    case TKS_COMPONENT_TEXTURE:
      choice.texture = number;
      break;
    case TKS_COMPONENT_UNKNOWN:
      return {TKS_UNSUPPORTED, "Component " + std::to_string(number) +
                                   " is of a kind, or on a surface, that this library does not "
                                   "know."};
  }
  Result<OwnedDecoder> chosen = openBehind(decoder.data, &decoder.limits, {}, choice);
  if (!chosen.ok()) return chosen.status();
  (*chosen)->threads = decoder.threads;
  (*chosen)->sketched = std::move(decoder.sketched);
  decoder = std::move(**chosen);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_get_component(const tks_decoder* decoder, uint32_t number, tks_component* out) {
  if (decoder == nullptr || out == nullptr || out->size < offsetof(tks_component, name) ||
      out->size > tetrakis::kMostStructBytes)
    return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    if (decoder->is_lost) return tetrakis::lost();
    return tetrakis::getComponent(*decoder, number, *out);
  });
}

tks_status tks_choose_component(tks_decoder* decoder, uint32_t number) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::chooseComponent(*decoder, number); });
}
