// SPDX-License-Identifier: Apache-2.0
#include "conformance/decode_cut.hpp"

#include <algorithm>
#include <vector>

#include "conformance/digest.hpp"
#include "tetrakis/sequence.hpp"

namespace tetrakis::conformance {
namespace {

void addSamples(const Result<std::vector<std::byte>>& decoded, std::vector<std::byte>& all,
                int& status) {
  if (decoded) all.insert(all.end(), decoded->begin(), decoded->end());
  if (!decoded) status = decoded.status().code();
}

/// Sets a level of both components, or their coarsest.
void setLevel(Decoder& decoder, int level, int& status) {
  const auto up_to = [&](uint32_t coarsest) {
    return std::min(static_cast<uint32_t>(level), coarsest);
  };
  const tks_info info = decoder.info();
  const auto set =
      decoder.setLevels(up_to(info.coarsest_level), up_to(info.texture_coarsest_level));
  if (!set.ok()) status = set.code();
}

/// Samples of frames, one behind the other.
struct FrameSamples {
  std::vector<std::byte> heights, texture;
  tks_sample height_sample = TKS_U8, texture_sample = TKS_U8;

  void add(Decoder& decoder, int& status) {
    const tks_info& info = decoder.info();
    if (info.has_heights) addSamples(decoder.heights(), heights, status);
    if (info.has_texture) addSamples(decoder.texture(), texture, status);
    height_sample = info.sample;
    texture_sample = info.texture_sample;
  }
  void digest(Cut& cut) const {
    if (!heights.empty()) cut.heights = sampleDigest(heights, height_sample);
    if (!texture.empty()) cut.texture = sampleDigest(texture, texture_sample);
  }
};

bool isSequence(std::span<const uint8_t> prefix) {
  return prefix.size() > 2 && prefix[2] == 'G';
}

/// The frames of all groups that decode. The status is that of the heads, else of the first group
/// that does not.
void decodeSequence(std::span<const uint8_t> prefix, Cut& cut) {
  auto sequence = Sequence::open({});
  if (!sequence) {
    cut.status = sequence.status().code();
    return;
  }
  cut.status = sequence->append(prefix).code();
  FrameSamples samples;
  const tks_sequence_info info = sequence->info();
  if (cut.status == TKS_OK && info.end_frame == 0) cut.status = TKS_TRUNCATED;
  for (uint64_t frame = info.first_frame; frame < info.end_frame; ++frame) {
    if (!sequence->group(frame)) continue;  // its group was left out
    auto decoder = sequence->decoder(frame);
    int status = decoder ? TKS_OK : decoder.status().code();
    if (decoder) setLevel(*decoder, cut.level, status);
    if (decoder) samples.add(*decoder, status);
    if (cut.status == TKS_OK) cut.status = status;
  }
  samples.digest(cut);
}

}  // namespace

Cut decodeCut(std::span<const uint8_t> prefix, int level, std::optional<uint32_t> component) {
  Cut cut;
  cut.bytes = prefix.size();
  cut.level = level;
  cut.component = component;
  if (isSequence(prefix)) {
    decodeSequence(prefix, cut);
    return cut;
  }
  auto decoder = Decoder::open(prefix);
  if (!decoder) {
    cut.status = decoder.status().code();
    return cut;
  }
  if (component) cut.status = decoder->choose(*component).code();
  if (cut.status != TKS_OK) return cut;
  if (level > 0) setLevel(*decoder, level, cut.status);
  FrameSamples samples;
  for (uint32_t t = 0; t < decoder->info().frames; ++t) {
    if (const auto set = decoder->setFrame(t); !set.ok()) cut.status = set.code();
    samples.add(*decoder, cut.status);
  }
  if (cut.status == TKS_OK) samples.digest(cut);
  if (decoder->info().object_triangles > 0) {
    const auto mesh = decoder->objectMesh(TKS_MESH_BUDGET);
    if (mesh.ok()) cut.triangles = cornerDigest(*mesh);
    if (!mesh.ok()) cut.status = mesh.status().code();
  }
  return cut;
}

}  // namespace tetrakis::conformance
