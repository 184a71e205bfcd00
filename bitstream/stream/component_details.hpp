// SPDX-License-Identifier: Apache-2.0
// visitDetails() visits what components say of themselves: their names, and of those behind the
// first heights and the first texture also their metadata, places and promises, which the body
// states of the first ones (docs/FORMAT.md, section 2, Parts). A decoder that takes another
// component than the first of its kind reads them in the place of the body's (takeDetails()).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bitstream/stream/component_list.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

/// Kinds of the parts of a component's details.
enum DetailPart : uint64_t { kName = 64, kOwnMetadata = 65, kOwnPlace = 66, kOwnLossless = 67 };

/// Where a component lies if it covers the same ground as the first heights, which are another one.
inline TransformBasis basisBeside(const StreamHeader& header, const ListedComponent& one) {
  TransformBasis basis;
  const Metadata& own = one.details.metadata;
  basis.spacing = northUp(own.spacing_x, own.spacing_y);
  const Placement& heights = header.georeference.heights;
  const ListedComponent* first = firstHeights(header.components);
  basis.has_heights = first != nullptr && first != &one && heights.has_transform;
  if (basis.has_heights)
    basis.heights = over(heights.transform, first->domain.grid, one.domain.grid);
  return basis;
}

/// Further heights on the ground of the first ones that name no reference system have that of the
/// first ones.
template <class V>
void visitPlaceOfHeights(V& v, const StreamHeader& header, TransformBasis basis,
                         ComponentDetails& details) {
  Georeference& place = details.place;
  const std::string &keys = header.georeference.heights.geo_keys, &crs = header.metadata.crs;
  if constexpr (!V::kReads) {
    const bool same = place.heights.geo_keys == keys && details.metadata.crs == crs;
    if (place.heights.geo_keys.empty() && !same) basis.has_heights = false;
  }
  place.visitHeights(v, basis);
  if constexpr (V::kReads) {
    const bool covers = basis.has_heights && place.heights.has_transform &&
                        place.heights.transform == basis.heights;
    if (covers && place.heights.geo_keys.empty()) {
      place.heights.geo_keys = keys;
      if (details.metadata.crs.empty()) details.metadata.crs = crs;
    }
  }
}

template <class V>
void visitDetailsOf(V& v, const StreamHeader& header, ListedComponent& one) {
  ComponentDetails& details = one.details;
  v.part(kName, !details.name.empty(), [&](auto& part) { part.rest(details.name); });
  if (one.isHeights())
    v.part(kOwnMetadata, !details.metadata.isDefault(),
           [&](auto& part) { details.metadata.visit(part); });
  const TransformBasis basis = basisBeside(header, one);
  if (one.isHeights())
    v.part(kOwnPlace, details.place.hasHeights(),
           [&](auto& part) { visitPlaceOfHeights(part, header, basis, details); });
  if (one.isTexture())
    v.part(kOwnPlace, details.place.hasTexture(),
           [&](auto& part) { details.place.visitTexture(part, basis); });
  details.lossless = v.part(kOwnLossless, details.lossless > 0, [](auto&) {});
  v.endParts(details.later_parts);
}

/// The kind of a part is the number of the component that it is about.
template <class V>
void visitDetails(V& v, StreamHeader& header) {
  for (size_t i = 0; i < header.components.size(); ++i) {
    ListedComponent& one = header.components[i];
    v.part(i, !one.details.none(), [&](auto& part) { visitDetailsOf(part, header, one); });
  }
  v.endParts(header.later_details);
}

inline bool hasDetails(const StreamHeader& header) {
  const auto has = [](const ListedComponent& one) { return !one.details.none(); };
  return !header.later_details.empty() ||
         std::any_of(header.components.begin(), header.components.end(), has);
}

/// Metadata, place and promise become those of a chosen component that is not the first of its
/// kind.
inline void takeDetails(StreamHeader& header) {
  const std::vector<ListedComponent>& list = header.components;
  Georeference& place = header.georeference;
  const auto [heights, texture] = header.choice;
  if (heights && &list[*heights] != firstHeights(list)) {
    const ComponentDetails& details = list[*heights].details;
    header.metadata = details.metadata;
    place.heights = details.place.heights;
    place.description = details.place.description;
    place.nan_nodata = details.place.nan_nodata;
    header.height_positions.clear();
    header.grid = {};
    header.lossless &= details.lossless;
  }
  if (texture && &list[*texture] != firstTexture(list)) {
    const ComponentDetails& details = list[*texture].details;
    place.texture = details.place.texture;
    place.texture_crs = details.place.texture_crs;
    header.texture_positions.clear();
    header.lossless &= details.lossless;
  }
}

}  // namespace tetrakis::inline stream
