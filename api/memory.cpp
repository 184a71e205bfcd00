// SPDX-License-Identifier: Apache-2.0
#include "api/memory.hpp"

#include <algorithm>
#include <vector>

#include "codec/geometry/value_table.hpp"
#include "codec/mesh/budget_mesh.hpp"
#include "texture_wavelet/drawn/drawn_colours.hpp"
#include "wavelet/region_decoder.hpp"
#include "wavelet/wavelet_header.hpp"
#include "wavelet/window.hpp"

namespace tetrakis {

namespace {

constexpr uint64_t kOnce = 256 << 10;         // models, plans, lists of levels
constexpr uint64_t kDrawnOnce = 3 << 20;      // models of drawn textures and overlays
constexpr uint64_t kBytesPerTrack = 64;       // its region, and views of its bytes
constexpr uint64_t kValue = sizeof(int32_t);  // of a plane
/// Of a row or column that is lifted, its mask and its halves: a sample, on each thread.
constexpr uint64_t kLifting = 8;

/// Of a rectangle.
uint64_t area(const auto& extent) {
  return uint64_t{extent.width} * extent.height;
}

uint64_t threadsOf(const tks_decoder& decoder) {
  return std::max<uint64_t>(decoder.threads, 1);
}

/// The state of the tracks that are decoded at a time.
uint64_t stateBytes(const tks_decoder& decoder, const auto& header, uint32_t components,
                    bool masked, Component component) {
  const bool known =
      header.planes > 0 && header.planes < kDrawnPlanes && !decoder.payload.nothingOf(component);
  const TrackNeeds needs{header.width, header.height, header.regions.side_log2, components,
                         masked,       known,         decoder.threads};
  return needs.bytes();
}

/// What there is for each track all the time.
uint64_t trackBytes(const auto& header) {
  return kBytesPerTrack * regionCount(header.width, header.height, header.regions.side_log2);
}

/// What a window takes until its samples are there. state: of the tracks.
uint64_t synthesisBytes(const tks_decoder& decoder, const auto& header, uint32_t components,
                        const tks_window& window, bool masked, uint64_t state) {
  const std::vector<Subband> subbands = subbandsOf(header.width, header.height);
  const WindowSynthesis synthesis(specOf(header.wavelet), subbands, header.width, header.height,
                                  {window.x, window.y, window.width, window.height});
  constexpr uint64_t kAround = 1024;  // what a filter reaches beyond a row, and more
  const uint64_t lifting = kValue * synthesis.largestPart() + kLifting * (window.width + kAround) +
                           (masked ? 2 * synthesis.largestBlock() : 0);
  // The low band that a level starts from is no larger than the block that it was taken from.
  return components * kValue * synthesis.samples() +
         std::max(state, std::min<uint64_t>(threadsOf(decoder), components) * lifting);
}

class HeightsBytes {
 public:
  /// level: of the heights.
  HeightsBytes(const tks_decoder& decoder, int level)
      : decoder_(decoder),
        header_(*decoder.parsed.header.geometry),
        level_(level),
        mip_(header_.width, header_.height, level),
        voids_(decoder.parsed.header.layers.validity_bytes > 0),
        table_(decoder.parsed.header.layers.table_values),
        corrects_samples_(header_.stored() || table_ > 0 ||
                          decoder.parsed.header.layers.corrections == CorrectionKind::kSamples),
        corrected_(header_.stored() || (level == 0 && decoder.parsed.header.layers.corrections !=
                                                          CorrectionKind::kNone)) {}

  /// What is left when they are decoded: heights, marks, masks, corrections.
  uint64_t kept() const {
    const uint64_t corrections = (corrected_ || table_ > 0) && corrects_samples_ ? kValue : 0;
    return area(mip_.low()) * (kValue + 1 + (voids_ ? 1 : 0) + corrections);
  }

  uint64_t whole() const {
    const uint64_t low = area(mip_.low());
    const uint64_t masks = voids_ ? area(header_) + (level_ > 0 ? low : 0) : 0;
    const uint64_t lifting = (voids_ ? low : 0) + kLifting * header_.width * threadsOf(decoder_);
    const uint64_t corrections = corrected_ ? low * (kValue + 1) + kLifting * header_.width : 0;
    return kOnce + trackBytes(header_) + low * (kValue + 1) + masks +
           std::max({state(), lifting, corrections + tableBytes(low)});
  }

  uint64_t validity() const { return kOnce + (voids_ ? area(header_) + area(mip_.low()) : 0); }

  uint64_t window(const tks_window& window) const {
    if (corrected_) return whole() + area(window) * (2 * kValue + 1);
    return kOnce + (voids_ ? area(header_) + area(window) : 0) + trackBytes(header_) +
           synthesisBytes(decoder_, header_, 1, window, voids_, state()) + tableBytes(area(window));
  }

 private:
  uint64_t state() const { return stateBytes(decoder_, header_, 1, voids_, Component::kGeometry); }
  /// The table, its values as heights, and a correction for each sample.
  uint64_t tableBytes(uint64_t samples) const {
    constexpr uint64_t kEntry = sizeof(uint32_t) + sizeof(DrawnValue);
    return table_ > 0 ? table_ * kEntry + samples * kValue : 0;
  }

  const tks_decoder& decoder_;
  const GeometryHeader& header_;
  int level_;
  MipLevel mip_;
  bool voids_;
  uint32_t table_;  ///< values; 0: no table
  bool corrects_samples_;
  bool corrected_;  ///< corrections, of steps or of samples, are decoded
};

/// Samples, or vertices of the lattice, whichever are more.
uint64_t verticesOf(const Lattice& lattice) {
  return std::max<uint64_t>(lattice.sampleCount(), lattice.vertexCount());
}

/// Measured, of a vertex and of a triangle.
uint64_t meshBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  constexpr uint64_t kEverySample = 92;
  constexpr uint64_t kFitted = 26, kFewTriangles = 520, kManyTriangles = 180;
  const StreamHeader& header = decoder.parsed.header;
  const Result<Lattice> lattice = Lattice::make(header.geometry->width, header.geometry->height);
  if (!lattice.ok()) return 0;  // refused for that
  const uint64_t samples = verticesOf(*lattice);
  const HeightsBytes heights(decoder, 0);
  const uint64_t decoding = decoder.heights ? 0 : heights.whole();
  const uint64_t kept = decoder.heights ? 0 : heights.kept();
  const uint64_t base = uint64_t{2} * lattice->rootColumns() * lattice->rootRows();
  const uint64_t triangles =
      std::clamp<uint64_t>(request.max_triangles, base, std::max(base, 2 * samples));
  if (request.part == TKS_PART_CODED_MESH || request.max_triangles == 0)
    return std::max(decoding, kept + kOnce + kEverySample * samples);
  if (header.layers.validity_bytes > 0)
    return std::max(decoding, kept + voidMeshBytes(*lattice, triangles));
  const uint32_t level = budgetMeshLevel(*lattice, request.max_triangles);
  const uint64_t fitted = (samples >> (2 * level)) + lattice->width() + lattice->height();
  const uint64_t few = std::min(triangles, fitted * 3 / 5);
  const uint64_t mesh =
      kOnce + kFitted * fitted + kFewTriangles * few + kManyTriangles * (triangles - few);
  if (level == 0) return std::max(decoding, kept + mesh);
  const HeightsBytes coarse(decoder, static_cast<int>(level));
  return std::max(coarse.whole(), coarse.kept() + mesh);
}

class TextureBytes {
 public:
  TextureBytes(const tks_decoder& decoder, int level)
      : decoder_(decoder),
        header_(*decoder.parsed.header.texture),
        mip_(header_.width, header_.height, level),
        seen_(header_.alpha_bytes > 0),
        masked_(header_.hidden || header_.overlay_bytes > 0) {}

  uint64_t whole() const {
    if (header_.direct()) return kDrawnOnce + direct(area(mip_.size()));
    const uint64_t low = area(mip_.low());
    const uint64_t planes =
        kDrawnOnce + opening() + trackBytes(header_) + header_.components() * kValue * low;
    const uint64_t masks = low * ((masked_ ? 1 : 0) + (seen_ ? 1 : 0));
    const uint64_t lifting = (masked_ ? low : 0) + kLifting * header_.width * threadsOf(decoder_);
    return planes + std::max({state(), masks + lifting, masks + texels(area(mip_.size()))});
  }

  uint64_t window(const tks_window& window) const {
    const uint64_t out = texels(area(window));
    if (header_.direct()) return kDrawnOnce + direct(area(header_)) + out;
    const uint32_t components = header_.components();
    const uint64_t finishing = area(window) * (components * kValue + 2) + out;
    return kDrawnOnce + opening() + trackBytes(header_) +
           std::max(finishing,
                    synthesisBytes(decoder_, header_, components, window, masked_, state()));
  }

 private:
  uint64_t texels(uint64_t count) const { return count * header_.channels * sizeof(uint16_t); }
  uint64_t direct(uint64_t count) const {
    return (header_.drawn() ? count * sizeof(ColourIndex) : 0) + texels(count);
  }
  /// Of whole planes: what can be seen, the overlay, what is coded.
  uint64_t opening() const {
    const uint64_t overlay = header_.overlay_bytes > 0 ? sizeof(ColourIndex) : 0;
    return area(header_) * ((seen_ ? 1 : 0) + overlay + (masked_ ? 1 : 0));
  }
  uint64_t state() const {
    return stateBytes(decoder_, header_, header_.components(), masked_, Component::kTexture);
  }

  const tks_decoder& decoder_;
  const TextureHeader& header_;
  MipLevel mip_;
  bool seen_, masked_;
};

}  // namespace

uint64_t voidMeshBytes(const Lattice& lattice, uint64_t triangles) {
  constexpr uint64_t kVertex = 72, kTriangle = 330;
  return kOnce + kVertex * verticesOf(lattice) + kTriangle * triangles;
}

uint64_t payloadBytes(const PayloadCount& count, const TrackCounts& tracks) {
  constexpr uint64_t kNode = 160;  // of a track that is known by a byte
  uint64_t known = 0;
  for (const TrackCount& track : tracks) known += std::min(track.tracks, count.packets);
  // A vector that grows has up to twice its size beside the one before.
  return count.packets * sizeof(PacketHead) + 3 * count.bytes + known * kNode;
}

uint64_t callBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  if (request.part == TKS_PART_TEXTURE) {
    if (decoder.payload.nothingOf(Component::kTexture)) return kDrawnOnce;
    const TextureBytes texture(decoder, decoder.texture_level);
    return request.window ? texture.window(*request.window) : texture.whole();
  }
  if (request.part == TKS_PART_CODED_MESH || request.part == TKS_PART_BUDGET_MESH)
    return meshBytes(decoder, request);
  if (decoder.payload.nothingOf(Component::kGeometry)) return kOnce;
  if (decoder.heights && !request.window) return 0;
  const HeightsBytes heights(decoder, decoder.heights_level);
  if (request.part == TKS_PART_VALIDITY) return heights.validity();
  return request.window ? heights.window(*request.window) : heights.whole();
}

}  // namespace tetrakis
