// SPDX-License-Identifier: Apache-2.0
// GeometryHeader is the part of the stream header that describes the heights and the layers of
// their first track (docs/FORMAT.md, section 2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/base_mesh_header.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/stream/line_repeats.hpp"
#include "bitstream/track/track.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline stream {

inline constexpr uint32_t kMaxSide = 1u << 20;  ///< samples in a row or column of heights

/// What corrections are added to.
enum class CorrectionKind : uint8_t {
  kNone = 0,
  kSteps = 1,     ///< heights in steps: heights += correction_step * correction
  kSamples = 2,   ///< samples, in the order of their type: restores them bit for bit
  kRelative = 3,  ///< the same, counted from multiples of a step beside the samples before
  kFacets = 4     ///< the same, counted from where facets go on from the samples before
};

/// Heights: integer q (after dropping fraction_bits) stands for the sample base + q * step.
struct GeometryHeader {
  uint32_t width = 0, height = 0;  ///< of the lines that are coded
  LineRepeats repeats;             ///< which of those that are shown they are
  uint8_t sample = 0;              ///< tks_sample of the input and of the decoded output
  uint8_t planes = 0;
  bool drawn = false;  ///< with kDirectPlanes alone
  uint8_t exact = 0;   ///< the steps restore every input sample
  double base = 0, step = 1;
  static constexpr double kNotStated = -1;
  double max_error =
      kNotStated;  ///< guaranteed for the complete stream, in the unit; < 0: not stated
  WaveletHeader wavelet;
  PriorityHeader priorities;
  RegionHeader regions;
  BaseMeshHeader base_mesh;  ///< of heights on a forest that count along the normals of a surface
  FramesHeader frames;
  std::string later_parts;  ///< of kinds that are not known and inform, as they were read

  /// domain: the lines that are shown.
  template <class V>
  void visit(V& v, Extent domain) {
    v.u8("sample", sample, 0, TKS_F32);
    Coding coding = this->coding();
    v.u8("coding", coding, 0, static_cast<uint64_t>(Coding::kWavelet));
    v.f64("base", base);
    v.f64("step", step);
    v.require("step", step > 0);
    if (coding != Coding::kWavelet) planes = kDirectPlanes;
    drawn = coding == Coding::kDrawn;
    if (coding == Coding::kWavelet) wavelet.visit(v, planes);
    const Extent coded = visitLines(v, PartKind::kRepeatedLines, domain, repeats);
    width = coded.width;
    height = coded.height;
    v.part(PartKind::kPriorities, !priorities.none(), [&](auto& part) { priorities.visit(part); });
  }
  /// Behind the layers: a base mesh, frames.
  template <class V>
  void visitOthers(V& v) {
    v.part(PartKind::kBaseMesh, !base_mesh.none(), [&](auto& part) { base_mesh.visit(part); });
    v.part(PartKind::kFrames, !frames.none(), [&](auto& part) {
      frames.visit(part);
      frames.visitScales(part);
    });
    v.part(PartKind::kReference, frames.reference > 0,
           [&](auto& part) { frames.visitReference(part); });
  }
  /// What informs.
  template <class V>
  void visitBound(V& v) {
    v.part(PartKind::kBound, exact > 0 || max_error >= 0, [&](auto& part) {
      part.u8("exact", exact, 0, 1);
      part.unless(kNotStated, max_error, [&] { part.f64("max_error", max_error); });
    });
  }
  Extent extent() const { return {width, height}; }
  Extent shown() const { return repeats.none() ? extent() : repeats.shown; }
  /// The heights were coded without a transform: drawn or stored.
  bool direct() const { return planes == kDirectPlanes; }
  bool stored() const { return direct() && !drawn; }
  Coding coding() const {
    return !direct() ? Coding::kWavelet : drawn ? Coding::kDrawn : Coding::kStored;
  }

  /// In the place of a number of bit-planes where steps are drawn (codec/geometry/drawn_heights/)
  /// or samples are stored (bitstream/coder/byte_planes.hpp).
  static constexpr uint8_t kDirectPlanes = 31;
};

/// A point of the polyline that stands for a table of values while that is missing.
struct TableKnot {
  uint32_t place = 0;  ///< in the table
  int64_t rise = 0;    ///< of its value above base + step * (place - middle), in 1/16 steps

  bool operator==(const TableKnot&) const = default;
};

/// Samples lie whole multiples of a step from what neighbours predict (codec/geometry/relative/).
struct RelativeSteps {
  double step = 0;       ///< in sample units
  uint8_t quarters = 0;  ///< of the way from there to a sample that its multiple is pulled

  bool operator==(const RelativeSteps&) const = default;
};

/// What a geometry track holds besides coefficients:
///
///   validity codeword | flat areas | coefficients | corrections
///
/// A table of values lies within the coefficients, or at one of their ends. So does validity where
/// the mask comes late; then the mask of the samples that are lifted stands in its place.
struct GeometryLayers {
  uint64_t validity_bytes = 0;  ///< 0: every sample is valid
  /// The mask of the base opens the first track, and each region of coefficients begins with what
  /// its mask has beside that (codec/geometry/region_masks.hpp).
  bool region_masks = false;
  uint64_t table_bytes = 0;   ///< 0: steps are multiples; else they count the values of a table
  uint32_t table_values = 0;  ///< with a table only: how many it has
  uint64_t table_after = 0;   ///< likewise: bytes of coefficients before it
  std::vector<TableKnot> table_knots = {};  ///< likewise, by rising places
  uint64_t flat_bytes = 0;                  ///< 0: there are no flat areas
  uint32_t flat_areas = 0;                  ///< with flat areas only: how many there are
  uint8_t bridge =
      0;  ///< the reach of bridges over voids (codec/wavelet/morphology.hpp); 0: none, or late
  bool late_mask = false;       ///< validity lies among the coefficients
  uint64_t lifted_bytes = 0;    ///< with a late mask only: which samples are lifted; 0: all
  uint64_t validity_after = 0;  ///< likewise: bytes of coefficients before validity
  uint8_t has_nodata = 0;       ///< voids have the sample value `nodata`; else NaN (f32 only)
  double nodata = 0;
  CorrectionKind corrections = CorrectionKind::kNone;
  uint64_t coefficient_bytes = 0;  ///< with corrections only: what follows is theirs
  uint32_t correction_step = 0;    ///< kSteps only: unit of the corrections, in steps
  RelativeSteps relative = {};     ///< kRelative only
  uint8_t facet_unit = 0;          ///< kFacets only: of FacetUnit (codec/geometry/facets/)

  bool operator==(const GeometryLayers&) const = default;

  template <class V>
  void visit(V& v) {
    v.part(PartKind::kValidity, validity_bytes > 0, [&](auto& part) {
      part.varint("validity_bytes", validity_bytes, 1, UINT64_MAX >> 1);
      part.unless(false, region_masks, [&] { part.u8("region_masks", region_masks, 0, 1); });
    });
    v.part(PartKind::kBridges, bridge > 0, [&](auto& part) { part.u8("bridge", bridge, 1, 255); });
    late_mask = v.part(PartKind::kLateMask, late_mask, [&](auto& part) {
      part.varint("lifted_bytes", lifted_bytes, 0, UINT64_MAX >> 1);
      part.varint("validity_after", validity_after, 0, UINT64_MAX >> 1);
    });
    has_nodata = v.part(PartKind::kNodata, has_nodata > 0,
                        [&](auto& part) { part.f64("nodata", nodata, true); });
    v.part(PartKind::kValueTable, table_bytes > 0, [&](auto& part) { visitTable(part); });
    v.part(PartKind::kFlatAreas, flat_bytes > 0, [&](auto& part) {
      part.varint("flat_bytes", flat_bytes, 1, UINT64_MAX >> 1);
      part.varint("flat_areas", flat_areas, 1, kMostFlatAreas);
    });
    v.part(PartKind::kCorrections, corrections != CorrectionKind::kNone,
           [&](auto& part) { visitCorrections(part); });
  }
  static constexpr uint64_t kMaxCorrectionStep = uint64_t{1} << 26;
  static constexpr uint64_t kMostFlatAreas = 65535;
  static constexpr uint64_t kMostFlatSamples = uint64_t{1} << 31;  ///< of a plane with flat areas
  static constexpr uint32_t kMostValues = 1u << 20;
  static constexpr uint8_t kMostKnots = 64;
  static constexpr int64_t kMostRise = int64_t{1} << 28;

  uint64_t openingBytes() const { return (late_mask ? lifted_bytes : validity_bytes) + flat_bytes; }
  /// Bytes of the track behind which validity is known.
  uint64_t maskEnd() const {
    if (!late_mask) return validity_bytes;
    const uint64_t table = table_after < validity_after ? table_bytes : 0;
    return openingBytes() + validity_after + table + validity_bytes;
  }
  /// Bytes of the track that are neither coefficients nor corrections.
  uint64_t besideCoefficients() const {
    return validity_bytes + lifted_bytes + flat_bytes + table_bytes;
  }
  /// Corrections restore every sample.
  bool restoresSamples() const {
    return corrections == CorrectionKind::kSamples || corrections == CorrectionKind::kRelative ||
           corrections == CorrectionKind::kFacets;
  }

 private:
  template <class V>
  void visitTable(V& v) {
    v.varint("table_bytes", table_bytes, 1, UINT64_MAX >> 1);
    v.varint("table_values", table_values, 2, kMostValues);
    v.varint("table_after", table_after, 0, UINT64_MAX >> 1);
    visitKnots(v);
  }
  template <class V>
  void visitCorrections(V& v) {
    v.u8("corrections", corrections, 1, static_cast<uint64_t>(CorrectionKind::kFacets));
    v.varint("coefficient_bytes", coefficient_bytes, std::max(table_after, validity_after),
             UINT64_MAX >> 1);
    if (corrections == CorrectionKind::kSteps)
      v.varint("correction_step", correction_step, 1, kMaxCorrectionStep);
    if (corrections == CorrectionKind::kRelative) {
      v.f64("relative_step", relative.step);
      v.require("relative_step", relative.step > 0);
      v.u8("relative_quarters", relative.quarters, 1, 4);
    }
    if (corrections == CorrectionKind::kFacets) v.u8("facet_unit", facet_unit, 1, 254);
  }
  /// Each as what it differs by from the one before it.
  template <class V>
  void visitKnots(V& v) {
    auto count = static_cast<uint8_t>(table_knots.size());
    v.u8("table_knots", count, 0, kMostKnots);
    table_knots.resize(count);
    TableKnot before;
    for (size_t i = 0; i < table_knots.size() && v.ok(); ++i) {
      TableKnot& knot = table_knots[i];
      uint32_t gap = knot.place - before.place;
      int64_t rise = knot.rise - before.rise;
      v.varint("knot_gap", gap, i > 0 ? 1 : 0, table_values - 1u - before.place);
      v.zigzag("knot_rise", rise, 2 * kMostRise);
      knot = {before.place + gap, before.rise + rise};
      v.require("the rise of a knot", -kMostRise <= knot.rise && knot.rise <= kMostRise);
      before = knot;
    }
  }
};

// coefficientTracks(), correctionTracks() and correctionParts() number the tracks that hold the
// corrections of heights. Corrections of a plane in one track follow its coefficients. Corrections
// of a plane in regions are tracks of their own behind the tracks of coefficients, one for each
// region of the finest levels, so that a window is decoded without the corrections of other
// regions.

/// How many tracks of coefficients there are.
inline uint64_t coefficientTracks(const GeometryHeader& header) {
  return regionCount(header.width, header.height, header.regions.side_log2,
                     header.wavelet.patches());
}

/// How many tracks of corrections there are.
inline uint64_t correctionTracks(const GeometryHeader& header, const GeometryLayers& layers) {
  if (layers.corrections == CorrectionKind::kNone) return 0;
  return finestRegionCount(header.width, header.height, header.regions.side_log2,
                           header.wavelet.patches());
}

/// The rectangles of the plane whose corrections are a codeword each, in the order of the tracks;
/// without such tracks the whole plane.
inline std::vector<Window> correctionParts(const GeometryHeader& header) {
  std::vector<Window> parts = finestRegions(header.width, header.height, header.regions.side_log2,
                                            header.wavelet.patches());
  if (parts.empty()) parts.push_back({0, 0, header.width, header.height});
  return parts;
}

}  // namespace tetrakis::inline stream
