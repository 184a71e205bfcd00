// SPDX-License-Identifier: Apache-2.0
#include "api/group_chain.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "api/memory.hpp"
#include "api/needed.hpp"

namespace tetrakis::inline api {

namespace {

Status doesNotFollow() {
  return {TKS_CORRUPT,
          "Corrupt sequence: the frames of a group go on from frames of another kind."};
}

bool sameFrames(const GeometryHeader& a, const GeometryHeader& b) {
  return a.extent() == b.extent() && a.sample == b.sample && a.base == b.base && a.step == b.step &&
         !b.frames.none() && a.frames.scales.empty() && b.frames.scales.empty();
}

bool sameFrames(const TextureHeader& a, const TextureHeader& b) {
  return a.extent() == b.extent() && a.sample == b.sample && a.channels == b.channels &&
         a.opaque == b.opaque && a.white() == b.white() && !b.frames.none() &&
         a.centre == b.centre && a.colour_order == b.colour_order &&
         a.colour_shears == b.colour_shears && a.further_shears == b.further_shears;
}

/// Whether the frames of a component can go on from those of another stream.
template <class Header>
bool mayFollow(const std::optional<Header>& stream, const std::optional<Header>& before) {
  if (!stream || stream->frames.reference == 0) return true;
  return before && sameFrames(*stream, *before);
}

/// How much memory it takes to decode the last frame of a component. TKS_LIMIT: too much.
Result<uint64_t> bytesOfLast(tks_decoder& decoder, Component component) {
  const tks_part part = component == Component::kGeometry ? TKS_PART_HEIGHTS : TKS_PART_TEXTURE;
  const MemoryRequest request{part, {0, {}, framesOf(decoder.parsed.header) - 1}, 0};
  if (Status status = checkMemory(decoder, request); !status.ok()) return status;
  return callBytes(decoder, request) + decoder.packets.bytes;
}

}  // namespace

Status misledDepth() {
  return {TKS_CORRUPT,
          "Corrupt sequence: the head of a group does not say that it goes on from another one, or "
          "says so wrongly."};
}

uint64_t referenceOf(const StreamHeader& header) {
  const uint64_t heights = header.geometry ? header.geometry->frames.reference : 0;
  return std::max(heights, header.texture ? header.texture->frames.reference : 0);
}

FrameReference lastFrame(tks_decoder& decoder, Component component) {
  const StreamHeader& header = decoder.parsed.header;
  const View view{0, {}, framesOf(header) - 1};
  if (component == Component::kGeometry)
    return lastFrame(headerFor(decoder, *header.geometry, view), header.layers,
                     heightTracksFor(decoder, view), {decoder.threads, nullptr});
  const std::vector<bool> needed = neededTracks(header, Component::kTexture, view);
  return lastFrame(headerFor(decoder, *header.texture, view),
                   decoder.packets.codewordsOf(Component::kTexture, needed),
                   {decoder.threads, nullptr});
}

Status GroupChain::add(std::span<const uint8_t> before, const StreamHeader& stream) {
  const uint64_t bytes = referenceOf(stream);
  if (bytes == 0) return misledDepth();
  if (bytes > before.size()) return doesNotFollow();
  const std::span<const uint8_t> link = before.first(static_cast<size_t>(bytes));
  const Result<OwnedDecoder> opened = openBehind(link, limits_, references());
  if (!opened.ok()) return opened.status();
  tks_decoder& decoder = **opened;
  const StreamHeader& header = decoder.parsed.header;
  if (!mayFollow(stream.geometry, header.geometry) || !mayFollow(stream.texture, header.texture))
    return doesNotFollow();
  uint64_t heights = 0, texture = 0;
  if (header.geometry) {
    const Result<uint64_t> bytes_of_last = bytesOfLast(decoder, Component::kGeometry);
    if (!bytes_of_last.ok()) return bytes_of_last.status();
    heights = *bytes_of_last;
  }
  if (header.texture) {
    const Result<uint64_t> bytes_of_last = bytesOfLast(decoder, Component::kTexture);
    if (!bytes_of_last.ok()) return bytes_of_last.status();
    texture = *bytes_of_last;
  }
  heights_bytes_ = std::max(heights_bytes_, heights);
  texture_bytes_ = std::max(texture_bytes_, texture);
  links_.push_back(link);
  return {};
}

References GroupChain::references() {
  if (links_.empty()) return {};
  return {{[this] { return lastOf(Component::kGeometry); }, heights_bytes_},
          {[this] { return lastOf(Component::kTexture); }, texture_bytes_}};
}

std::shared_ptr<const FrameReference> GroupChain::lastOf(Component component) {
  Kept& kept = keptOf(component);
  while (kept.streams < links_.size()) {
    // The streams before have been decoded: their last frame is kept.
    const ReferenceSource known{[frame = kept.frame] { return frame; }, 0};
    const References references = kept.streams > 0 ? References{known, known} : References{};
    const Result<OwnedDecoder> opened = openBehind(links_[kept.streams], limits_, references);
    if (!opened.ok()) throw std::bad_alloc();  // it was opened before, when it was added
    kept.frame = std::make_shared<const FrameReference>(lastFrame(**opened, component));
    ++kept.streams;
  }
  return kept.frame;
}

}  // namespace tetrakis::inline api
