// SPDX-License-Identifier: Apache-2.0
#include "api/memory.hpp"

#include <algorithm>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/region_masks.hpp"
#include "codec/geometry/values/value_table.hpp"
#include "codec/lattice/validity.hpp"
#include "codec/lines/shown_lines.hpp"
#include "codec/wavelet/morphology.hpp"

namespace tetrakis::inline api {

namespace {

/// What corrections of so many columns take while they are decoded.
struct CorrectionBytes {
  uint64_t models, column;

  uint64_t of(uint64_t width) const { return models + column * width; }
};
constexpr uint64_t kNumbers = 560 << 10;                   // models of a NumberCoder
constexpr CorrectionBytes kPlain = {kNumbers, 32};         // numbers of three rows
constexpr CorrectionBytes kRelative = {2 * kNumbers, 80};  // of both, and what multiples are known
constexpr CorrectionBytes kExact = {kNumbers, 56};         // errors and steps of four rows
constexpr CorrectionBytes kFacets = {(128 << 10) + kNumbers, 56};  // errors, samples, ways likewise

CorrectionBytes kindOfCorrections(const GeometryLayers& layers) {
  switch (layers.corrections) {
    case CorrectionKind::kNone:
      return {0, 0};
    case CorrectionKind::kSteps:
      return layers.correction_step == 1 ? kExact : kPlain;
    case CorrectionKind::kSamples:
      return kPlain;
    case CorrectionKind::kRelative:
      return kRelative;
    case CorrectionKind::kFacets:
      return kFacets;
  }
  return kPlain;
}

}  // namespace

HeightsBytes::HeightsBytes(const tks_decoder& decoder, const View& view)
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

HeightsBytes::HeightsBytes(const HeightsBytes& of, const View& lines) : HeightsBytes(of) {
  view_ = lines;
  shown_ = area(lines.extentIn(header_.extent()));
}

uint64_t HeightsBytes::kept() const {
  const bool of_samples = header_.stored() || layers_.restoresSamples();
  const bool corrections = table_ || (corrected_ && of_samples);
  return std::max(low(), copied_) *
         (kValueBytes + 1 + (voids_ ? 1 : 0) + (corrections ? kValueBytes : 0));
}

uint64_t HeightsBytes::decoding() const {
  return decodingLines() + copyBytes();
}

uint64_t HeightsBytes::validity() const {
  return kOnceBytes + (voids_ ? openingMaskBytes() + shown_ : 0) + copyBytes();
}

uint64_t HeightsBytes::decodingLines() const {
  const bool forest = header_.wavelet.forest != nullptr;
  const View decoded = decodedView(header_, layers_, view_);
  const bool cut =
      view_.window ? corrected_ || !decoded.window : forest && header_.drawn && view_.level > 0;
  if (!cut) return decodingTaken();
  // Corrected and direct samples of a window are cut out of more.
  const HeightsBytes all(*this, decoded);
  return all.decodingTaken() + shown_ * (2 * kValueBytes + 1);
}

uint64_t HeightsBytes::decodingTaken() const {
  if (header_.drawn) return drawing();
  const uint32_t frames = header_.frames.shown();
  const PlanesBytes planes(decoder_, header_, view_, frames, voids_);
  const uint64_t samples = view_.window ? shown_ : low();
  const uint64_t masks = wholeMasks() + (voids_ ? samples : 0);
  const uint64_t corrections = corrected_ ? samples * (kValueBytes + 1) + rows() + parts() : 0;
  const TrackNeeds needs =
      trackNeeds(decoder_, header_, frames, voids_ || flat_, Component::kGeometry);
  const uint64_t state = stateBytes(decoder_, header_, view_, needs, Component::kGeometry);
  const uint64_t surface = frames * planes.coefficients + samples + masks + flatBytes() +
                           joinedBytes() + framesBytes(header_, planes, samples) +
                           std::max({state, planes.work, corrections + tableBytes()});
  return kOnceBytes + trackBytes(header_) +
         std::max({surface, flatOpeningBytes(), openingMaskBytes()});
}

/// Models, indices, heights, marks and mask; then a table or corrections.
uint64_t HeightsBytes::drawing() const {
  constexpr uint64_t kSample = sizeof(DrawnIndex) + kValueBytes + 1;
  const bool corrections = layers_.corrections != CorrectionKind::kNone && view_.level == 0;
  const uint64_t behind = tableBytes() + (corrections ? low() * (2 * kValueBytes + 1) + rows() : 0);
  const uint64_t masks = voids_ ? 2 * BitPlane::bytesOf(header_.extent()) + 2 * shown_ : 0;
  return kDrawnOnceBytes + shown_ * kSample + masks + joinedBytes() + behind;
}

/// Which samples of the plane are valid, and which are lifted where that is not the same.
uint64_t HeightsBytes::wholeMasks() const {
  if (layers_.region_masks) return regionMaskBytes(header_, view_);
  const bool bridged = layers_.bridge > 0 || layers_.late_mask;
  // Of frames: those that arrive and go, and what is valid in one of them.
  const uint64_t masks = header_.frames.none() ? (bridged ? 2 : 1) : header_.frames.count + 6u;
  return voids_ ? masks * BitPlane::bytesOf(header_.extent()) : 0;
}

/// The same while one of them is decoded, or found.
uint64_t HeightsBytes::openingMaskBytes() const {
  if (layers_.region_masks) return wholeMasks();
  return voids_ ? wholeMasks() +
                      std::max(validityBytes(header_.extent()), closingBytes(header_.extent()))
                : 0;
}

/// Heights, marks, mask and corrections that are copied, beside what they are copied from.
uint64_t HeightsBytes::copyBytes() const {
  return api::copyBytes(header_, copied_, 2 * (kValueBytes + 1));
}

uint64_t HeightsBytes::rows() const {
  return kindOfCorrections(layers_).of(header_.width);
}

/// Parts of the plane with their heights, corrections, marks, masks and hints, and the models of
/// their corrections, so many as are corrected at a time.
uint64_t HeightsBytes::parts() const {
  constexpr uint64_t kSample = 2 * kValueBytes + 3;
  const uint64_t count = correctionTracks(header_, layers_);
  if (count == 0) return 0;
  const uint64_t at_a_time = std::clamp<uint64_t>(decoder_.threads, 1, count);
  const Region largest = largestRegions(header_.width, header_.height, header_.regions.side_log2,
                                        header_.wavelet.patches())
                             .front();
  const uint64_t samples = uint64_t{largest.x1} * largest.y1;
  const uint64_t beside = kindOfCorrections(layers_).of(largest.x1);
  const uint64_t once = at_a_time * (samples * kSample + beside) + count * sizeof(Window);
  if (!view_.window || decoder_.most_of_windows == 0) return once;
  // Windows keep parts as they were before and after.
  const uint64_t kept = std::min(decoder_.most_of_windows, decoder_.heights_windows.parts.bytes());
  return once + at_a_time * samples * kSample +
         std::min(decoder_.most_of_windows - kept, 2 * count * samples * kSample);
}

/// The table, its values as heights, and a correction for each sample.
uint64_t HeightsBytes::tableBytes() const {
  constexpr uint64_t kEntry = sizeof(uint32_t) + sizeof(ValueInSteps);
  const uint64_t samples = view_.window ? shown_ : low();
  return table_ ? layers_.table_values * kEntry + samples * kValueBytes : 0;
}

/// Coefficients around the table and a late mask, in one piece.
uint64_t HeightsBytes::joinedBytes() const {
  return table_ || layers_.late_mask ? decoder_.packets.bytes : 0;
}

/// The number of each sample, and of each area its level and what levels of the transform make of
/// it.
uint64_t HeightsBytes::flatBytes() const {
  constexpr uint64_t kArea = sizeof(int32_t) * (2 * kMaxLevels + 24);
  return flat_ ? area(header_) * sizeof(uint16_t) + layers_.flat_areas * kArea : 0;
}

/// Masks, the numbers of areas, and a label for at most every other sample. Of a forest, labels of
/// the samples at the sides of patches, and which samples are owned.
uint64_t HeightsBytes::flatOpeningBytes() const {
  constexpr uint64_t kSample = 1 + sizeof(uint32_t) / 2 + sizeof(uint16_t);
  const SharedForest& forest = header_.wavelet.forest;
  uint64_t of_forest = 0;
  if (forest != nullptr)
    of_forest = Forest::kSides * uint64_t{forest->patches()} * forest->side() * sizeof(uint32_t) +
                BitPlane::bytesOf(header_.extent());
  return flat_
             ? area(header_) * kSample + of_forest + validityBytes(header_.extent()) + wholeMasks()
             : 0;
}

uint64_t HeightsBytes::low() const {
  if (header_.wavelet.forest != nullptr) return shown_;
  return area(Pyramid(header_.extent()).low(view_.level).extent);
}

}  // namespace tetrakis::inline api
