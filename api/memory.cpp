// SPDX-License-Identifier: Apache-2.0
#include "api/memory.hpp"

#include <algorithm>

#include "bitstream/stream/correction_tracks.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/values/value_table.hpp"
#include "codec/lines/shown_lines.hpp"
#include "codec/mesh/budget_mesh.hpp"
#include "codec/mesh/screen/screen_weights.hpp"
#include "texture_wavelet/drawn/drawn_colours.hpp"
#include "texture_wavelet/tables/channel_tables.hpp"
#include "wavelet/region_decoder.hpp"
#include "wavelet/synthesis/view_synthesis.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline api {

namespace {

constexpr uint64_t kOnce = 256 << 10;         // models, plans, lists of levels
constexpr uint64_t kDrawnOnce = 7 << 19;      // models of drawings and overlays
constexpr uint64_t kBytesPerTrack = 64;       // its region, and views of its bytes
constexpr uint64_t kValue = sizeof(int32_t);  // of a plane

/// What corrections of so many columns take while they are decoded.
struct CorrectionBytes {
  uint64_t models, column;

  uint64_t of(uint64_t width) const { return models + column * width; }
};
constexpr CorrectionBytes kPlain = {160 << 10, 8};      // a sample of the row before
constexpr CorrectionBytes kRelative = {160 << 10, 24};  // with what is known of its multiple
constexpr CorrectionBytes kExact = {384 << 10, 56};     // errors and steps of four rows
constexpr CorrectionBytes kFacets = {128 << 10, 56};    // errors, samples and ways of four rows

/// How many samples a rectangle has.
uint64_t area(const auto& extent) {
  return uint64_t{extent.width} * extent.height;
}

/// A map of priorities and its sums.
uint64_t mapBytes(const auto& header) {
  const int log2 = header.priorities.tile_log2;
  const uint64_t columns = tilesAlong(header.width, log2), rows = tilesAlong(header.height, log2);
  return columns * rows + (columns + 1) * (rows + 1) * sizeof(uint64_t);
}

/// The state of the tracks that are decoded at a time.
uint64_t stateBytes(const tks_decoder& decoder, const auto& header, uint32_t planes, bool masked,
                    Component component) {
  const bool known = header.planes > 0 && header.planes < kDrawnPlanes &&
                     !decoder.packets.payload.nothingOf(component);
  const bool ordered = !header.priorities.none();
  const TrackNeeds needs{header.extent(), header.regions.side_log2, planes, masked, ordered, known,
                         decoder.threads, decoder.remembers};
  return needs.bytes() + (ordered ? mapBytes(header) : 0);
}

/// What there is for each track all the time.
uint64_t trackBytes(const auto& header) {
  return kBytesPerTrack * regionCount(header.width, header.height, header.regions.side_log2);
}

/// What the planes of a view take until its samples are there.
struct PlanesBytes {
  uint64_t coefficients = 0;  ///< of one plane
  uint64_t work = 0;          ///< of the inverse transforms that run at a time

  PlanesBytes(const tks_decoder& decoder, const auto& header, const View& view, uint32_t planes,
              bool masked) {
    const Pyramid pyramid(header.extent());
    const ViewSynthesis synthesis(specOf(header.wavelet), pyramid, view);
    const uint64_t at_a_time = view.window ? std::clamp<uint64_t>(decoder.threads, 1, planes) : 1;
    coefficients = kValue * synthesis.coefficients();
    work = at_a_time * synthesis.workBytes(decoder.threads, masked);
  }
};

/// So many samples that are copied from coded lines, and the maps of lines.
uint64_t copyBytes(const auto& header, uint64_t samples, uint64_t sample_bytes) {
  constexpr uint64_t kLine = 4 * sizeof(uint32_t);
  if (header.repeats.none()) return 0;
  const auto [width, height] = header.shown();
  return samples * sample_bytes + kLine * (uint64_t{width} + height);
}

class HeightsBytes {
 public:
  HeightsBytes(const tks_decoder& decoder, const View& view)
      : decoder_(decoder),
        header_(*decoder.parsed.header.geometry),
        layers_(decoder.parsed.header.layers),
        view_(codedView(header_, view)),
        shown_(area(view_.extentIn(header_.extent()))),
        copied_(header_.repeats.none() ? 0 : area(view.extentIn(header_.shown()))),
        voids_(layers_.validity_bytes > 0),
        flat_(layers_.flat_bytes > 0),
        table_(layers_.table_bytes > 0),
        corrected_(header_.direct() ||
                   (view_.level == 0 && layers_.corrections != CorrectionKind::kNone)) {}

  /// What is left when a level is decoded: heights, marks, masks, corrections.
  uint64_t kept() const {
    const bool of_samples = header_.stored() || layers_.restoresSamples();
    const bool corrections = table_ || (corrected_ && of_samples);
    return std::max(low(), copied_) * (kValue + 1 + (voids_ ? 1 : 0) + (corrections ? kValue : 0));
  }

  /// What decoding takes.
  uint64_t decoding() const { return decodingLines() + copyBytes(); }

  uint64_t validity() const {
    const uint64_t lifted = layers_.late_mask ? area(header_) : 0;
    return kOnce + (voids_ ? area(header_) + lifted + shown_ : 0) + copyBytes();
  }

 private:
  /// The same heights, of which another view of the coded lines is decoded.
  HeightsBytes(const HeightsBytes& of, const View& lines)
      : decoder_(of.decoder_),
        header_(of.header_),
        layers_(of.layers_),
        view_(lines),
        shown_(area(lines.extentIn(header_.extent()))),
        copied_(of.copied_),
        voids_(of.voids_),
        flat_(of.flat_),
        table_(of.table_),
        corrected_(of.corrected_) {}

  uint64_t decodingLines() const {
    if (!view_.window || !corrected_) return decodingTaken();
    // Corrected and direct samples of a window are cut out of more.
    const HeightsBytes all(*this, decodedView(header_, layers_, view_));
    return all.decodingTaken() + shown_ * (2 * kValue + 1);
  }

  uint64_t decodingTaken() const {
    if (header_.drawn) return drawing();
    const PlanesBytes planes(decoder_, header_, view_, 1, voids_);
    const uint64_t samples = view_.window ? shown_ : low();
    const uint64_t masks = wholeMasks() + (voids_ && !view_.isWhole() ? shown_ : 0);
    const uint64_t corrections = corrected_ ? samples * (kValue + 1) + rows() + parts() : 0;
    const uint64_t state = stateBytes(decoder_, header_, 1, voids_ || flat_, Component::kGeometry);
    const uint64_t surface = planes.coefficients + samples + masks + flatBytes() + joinedBytes() +
                             std::max({state, planes.work, corrections + tableBytes()});
    // A distance for each sample is there while bridges are found.
    const uint64_t closing = layers_.bridge > 0 ? masks + area(header_) : 0;
    return kOnce + trackBytes(header_) + std::max({surface, flatOpeningBytes(), closing});
  }

  /// Models, indices, heights, marks and mask; then a table or corrections.
  uint64_t drawing() const {
    constexpr uint64_t kSample = sizeof(DrawnIndex) + kValue + 1;
    const bool corrections = layers_.corrections != CorrectionKind::kNone && view_.level == 0;
    const uint64_t behind = tableBytes() + (corrections ? low() * (2 * kValue + 1) + rows() : 0);
    const uint64_t masks = voids_ ? area(header_) + shown_ : 0;
    return kDrawnOnce + shown_ * kSample + masks + joinedBytes() + behind;
  }

  /// Which samples of the plane are valid, and which are lifted where that is not the same.
  uint64_t wholeMasks() const {
    const bool bridged = layers_.bridge > 0 || layers_.late_mask;
    return voids_ ? (bridged ? 2 : 1) * area(header_) : 0;
  }
  /// Heights, marks, mask and corrections that are copied, beside what they are copied from.
  uint64_t copyBytes() const { return api::copyBytes(header_, copied_, 2 * (kValue + 1)); }
  uint64_t rows() const { return kindOfCorrections().of(header_.width); }
  CorrectionBytes kindOfCorrections() const {
    switch (layers_.corrections) {
      case CorrectionKind::kNone:
        return {0, 0};
      case CorrectionKind::kSteps:
        return layers_.correction_step == 1 ? kExact : kPlain;
      case CorrectionKind::kSamples:
        return kPlain;
      case CorrectionKind::kRelative:
        return kRelative;
      case CorrectionKind::kFacets:
        return kFacets;
    }
    return kPlain;
  }
  /// Parts of the plane with their heights, corrections, marks, masks and hints, and the models of
  /// their corrections, so many as are corrected at a time.
  uint64_t parts() const {
    constexpr uint64_t kSample = 2 * kValue + 3;
    const uint64_t count = correctionTracks(header_, layers_);
    if (count == 0) return 0;
    const uint64_t at_a_time = std::clamp<uint64_t>(decoder_.threads, 1, count);
    const Region largest =
        largestRegions(header_.width, header_.height, header_.regions.side_log2).front();
    const uint64_t samples = uint64_t{largest.x1} * largest.y1;
    const uint64_t beside = kindOfCorrections().of(largest.x1);
    return at_a_time * (samples * kSample + beside) + count * sizeof(Window);
  }
  /// The table, its values as heights, and a correction for each sample.
  uint64_t tableBytes() const {
    constexpr uint64_t kEntry = sizeof(uint32_t) + sizeof(ValueInSteps);
    const uint64_t samples = view_.window ? shown_ : low();
    return table_ ? layers_.table_values * kEntry + samples * kValue : 0;
  }
  /// Coefficients around the table and a late mask, in one piece.
  uint64_t joinedBytes() const { return table_ || layers_.late_mask ? decoder_.packets.bytes : 0; }
  /// The number of each sample, and of each area its level and what levels of the transform make of
  /// it.
  uint64_t flatBytes() const {
    constexpr uint64_t kArea = sizeof(int32_t) * (2 * kMaxLevels + 24);
    return flat_ ? area(header_) * sizeof(uint16_t) + layers_.flat_areas * kArea : 0;
  }
  /// Masks, the numbers of areas and a label for at most every other sample.
  uint64_t flatOpeningBytes() const {
    constexpr uint64_t kSample = 1 + sizeof(uint32_t) / 2 + sizeof(uint16_t);
    return flat_ ? area(header_) * kSample + wholeMasks() : 0;
  }
  uint64_t low() const { return area(Pyramid(header_.extent()).low(view_.level).extent); }

  const tks_decoder& decoder_;
  const GeometryHeader& header_;
  const GeometryLayers& layers_;
  const View view_;
  uint64_t shown_;   ///< samples of the view, of coded lines
  uint64_t copied_;  ///< of the view; 0: no lines are copied
  bool voids_;
  bool flat_;
  bool table_;
  bool corrected_;  ///< corrections, or all samples directly, are decoded
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
  const Result<Lattice> lattice =
      Lattice::make(header.geometry->shown().width, header.geometry->shown().height);
  if (!lattice.ok()) return 0;  // refused for that
  const uint64_t samples = verticesOf(*lattice);
  const HeightsBytes heights(decoder, {});
  const uint64_t decoding = decoder.heights ? 0 : heights.decoding();
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
  const HeightsBytes coarse(decoder, {static_cast<int>(level), {}});
  return std::max(coarse.decoding(), coarse.kept() + mesh);
}

class TextureBytes {
 public:
  TextureBytes(const tks_decoder& decoder, const View& view)
      : decoder_(decoder),
        header_(*decoder.parsed.header.texture),
        view_(codedView(header_, view)),
        shown_(area(view_.extentIn(header_.extent()))),
        copied_(header_.repeats.none() ? 0 : area(view.extentIn(header_.shown()))),
        seen_(header_.alpha_bytes > 0),
        masked_(header_.hidden || header_.overlay_bytes > 0) {}

  uint64_t decoding() const { return decodingLines() + copyBytes(header_, copied_, texel()); }

 private:
  uint64_t texel() const { return header_.channels * sizeof(uint16_t); }
  uint64_t decodingLines() const {
    const uint64_t out = shown_ * texel();
    if (header_.direct())
      return kDrawnOnce + direct(view_.window ? area(header_) : shown_) + (view_.window ? out : 0);
    const uint32_t colour_planes = header_.colourPlanes();
    const PlanesBytes planes(decoder_, header_, view_, colour_planes, masked_);
    const uint64_t all = colour_planes * planes.coefficients;
    const uint64_t masks = shown_ * ((masked_ ? 1 : 0) + (seen_ ? 1 : 0));
    // A window's samples are apart from its coefficients, which are gone then.
    const uint64_t samples = view_.window ? colour_planes * kValue * shown_ : all;
    const uint64_t state =
        stateBytes(decoder_, header_, colour_planes, masked_, Component::kTexture);
    const uint64_t once = header_.overlay_bytes > 0 ? kDrawnOnce : kOnce;
    return once + opening() + tableBytesOf(header_) + trackBytes(header_) +
           std::max({bridged() ? area(header_) : 0, all + state, all + masks + planes.work,
                     samples + masks + out});
  }
  /// A distance for each texel is there while bridges are found.
  bool bridged() const { return header_.bridge > 0; }
  uint64_t direct(uint64_t count) const {
    return count * ((header_.drawn() ? sizeof(DrawnIndex) : 0) + texel());
  }
  /// What the opening takes: a mask of the texels that can be seen, the colours of the overlay, a
  /// mask of the texels that are coded and one of those that are lifted, each of a whole plane.
  uint64_t opening() const {
    const uint64_t overlay = header_.overlay_bytes > 0 ? sizeof(DrawnIndex) : 0;
    return area(header_) * ((seen_ ? 1 : 0) + overlay + (masked_ ? 1 : 0) + (bridged() ? 1 : 0));
  }

  const tks_decoder& decoder_;
  const TextureHeader& header_;
  const View view_;
  uint64_t shown_;   ///< texels of the view, of coded lines
  uint64_t copied_;  ///< of the view; 0: no lines are copied
  bool seen_, masked_;
};

}  // namespace

uint64_t voidMeshBytes(const Lattice& lattice, uint64_t triangles) {
  // Decimation of a plane whose slopes are equal, as those of an unknown surface: one bucket of its
  // queue and its first group hold all vertices. After it heights are fitted. How many samples are
  // valid is not known yet: of few, no level is left out (void_mesh.cpp).
  constexpr uint64_t kDecimated = 87;
  constexpr uint64_t kFitted = 32, kTriangle = 330;
  const uint64_t vertices = verticesOf(lattice);
  return kOnce + std::max(kDecimated * vertices, kFitted * vertices + kTriangle * triangles);
}

uint64_t screenMeshBytes(const tks_decoder& decoder, const Lattice& lattice, uint64_t triangles,
                         uint64_t texels) {
  // Choosing and fitting among all samples, of a triangle at its most; then turning edges.
  constexpr uint64_t kFitted = 40, kFew = 560, kMany = 260;
  const uint64_t samples = verticesOf(lattice);
  const uint64_t base = uint64_t{2} * lattice.rootColumns() * lattice.rootRows();
  const uint64_t all = std::clamp<uint64_t>(triangles, base, std::max(base, 2 * samples));
  const uint64_t few = std::min(all, samples * 3 / 5);
  const HeightsBytes heights(decoder, {});
  const uint64_t decoding = decoder.heights ? 0 : heights.decoding();
  const uint64_t kept = decoder.heights ? 0 : heights.kept();
  const bool has_voids = decoder.parsed.header.layers.validity_bytes > 0;
  const uint64_t mesh = has_voids ? voidMeshBytes(lattice, all)
                                  : kOnce + kFitted * samples + kFew * few + kMany * (all - few);
  const uint64_t turned = kFitted * samples + kMany * all;
  const uint64_t weights = screenWeightsBytes(samples) + 2 * texels;
  return std::max(decoding, kept + std::max(mesh, turned) + weights);
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
    if (decoder.packets.payload.nothingOf(Component::kTexture)) return kDrawnOnce;
    return TextureBytes(decoder, request.view).decoding();
  }
  if (request.part == TKS_PART_CODED_MESH || request.part == TKS_PART_BUDGET_MESH)
    return meshBytes(decoder, request);
  if (decoder.packets.payload.nothingOf(Component::kGeometry))
    return decoder.parsed.header.geometry->drawn ? kDrawnOnce : kOnce;
  if (decoder.heights && !request.view.window) return 0;
  const HeightsBytes heights(decoder, request.view);
  return request.part == TKS_PART_VALIDITY ? heights.validity() : heights.decoding();
}

}  // namespace tetrakis::inline api
