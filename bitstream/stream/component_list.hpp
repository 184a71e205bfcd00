// SPDX-License-Identifier: Apache-2.0
// listOf() and the functions beside it visit the list of components that a header begins with, each
// over a domain of its own or that of a component before it (docs/FORMAT.md, section 2). Streams of
// later versions may have domains and components that this decoder does not know: it keeps their
// descriptions as bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/forest.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

inline constexpr uint64_t kComponentPart = 0;  ///< the kind of a part of the body
inline constexpr size_t kMostListed = 16;      ///< components

/// The domain of a component with samples of that extent.
inline Domain domainOf(const WaveletHeader& wavelet, Extent extent) {
  const uint8_t kind = wavelet.forest != nullptr ? Domain::kForest
                       : wavelet.ring            ? Domain::kCylinder
                                                 : Domain::kGrid;
  return {kind, extent, wavelet.forest};
}

/// Of a component that is known, as its header says it.
inline ListedComponent listed(const StreamHeader& header, Component component) {
  const bool heights = component == Component::kGeometry;
  const auto fill = [&](const auto& of, uint8_t kind) {
    return ListedComponent{component, kind, domainOf(of.wavelet, of.shown()), of.regions.side_log2,
                           ""};
  };
  return heights ? fill(*header.geometry, ListedComponent::kHeights)
                 : fill(*header.texture, ListedComponent::kColours);
}

/// All components in the stream's order.
inline std::vector<ListedComponent> listOf(const StreamHeader& header) {
  std::array<bool, kComponents> left = {header.geometry.has_value(), header.texture.has_value()};
  std::vector<ListedComponent> list;
  const auto add = [&](Component component) {
    if (std::exchange(left[static_cast<size_t>(component)], false))
      list.push_back(listed(header, component));
  };
  for (const ListedComponent& known : header.components) {
    if (known.component == Component::kOther)
      list.push_back(known);
    else
      add(known.component);
  }
  add(Component::kGeometry);
  add(Component::kTexture);
  return list;
}

/// The component that a decoder takes one of the list for, given those before it.
inline Component roleOf(const ListedComponent& one, const StreamHeader& before) {
  if (!one.domain.isKnown()) return Component::kOther;
  if (one.kind == ListedComponent::kHeights && !before.geometry) return Component::kGeometry;
  if (one.kind == ListedComponent::kColours && !before.texture) return Component::kTexture;
  return Component::kOther;
}

/// Each side names the one that it is glued to, unless that has named it before.
template <class V>
void visitForest(V& v, Domain& domain) {
  uint64_t depth = 0, patches = 0;
  std::vector<uint32_t> sides;
  if constexpr (!V::kReads) {
    depth = static_cast<uint64_t>(domain.forest->depth());
    patches = domain.forest->patches();
    sides = domain.forest->sides();
  }
  v.u8("depth", depth, 1, Forest::kMostDepth);
  if (!v.ok()) return;
  v.varint("patches", patches, 1, Forest::mostPatches(static_cast<int>(depth)));
  if (!v.ok()) return;
  const auto count = static_cast<uint32_t>(Forest::kSides * patches);
  if constexpr (V::kReads) sides.assign(count, Forest::kBorder);
  for (uint32_t i = 0; i < count && v.ok(); ++i) {
    if (sides[i] < i) continue;
    uint32_t glue = sides[i] == Forest::kBorder ? 0 : sides[i] - i;
    v.varint("glue", glue, 0, count - 1u - i);
    if (!v.ok() || glue == 0) continue;
    if constexpr (V::kReads) {
      v.require("glue", sides[i + glue] == Forest::kBorder);
      sides[i] = i + glue;
      sides[i + glue] = i;
    }
  }
  if constexpr (V::kReads) {
    if (!v.ok()) return;
    domain.forest = std::make_shared<const Forest>(static_cast<int>(depth), std::move(sides));
    domain.grid = domain.forest->raster();
  }
}

/// known: the domains of the components before, which a new one joins.
template <class V>
void visitDomain(V& v, std::vector<Domain>& known, Domain& domain) {
  uint64_t number =
      static_cast<uint64_t>(std::find(known.begin(), known.end(), domain) - known.begin());
  v.varint("domain", number, 0, known.size());
  if (!v.ok()) return;
  if (number < known.size()) {
    domain = known[number];
    return;
  }
  v.u8("domain_kind", domain.kind, 0, UINT8_MAX);
  if (domain.kind == Domain::kForest) {
    visitForest(v, domain);
    if (!v.ok()) return;
  } else if (domain.isKnown()) {
    v.varint("width", domain.grid.width, 1, kMaxSide);
    v.varint("height", domain.grid.height, 1, kMaxSide);
  } else if constexpr (V::kReads) {
    domain.number = number;
  }
  known.push_back(domain);
}

template <class V>
void visitKnown(V& v, StreamHeader& header, const ListedComponent& one) {
  const auto takeDomain = [&](WaveletHeader& wavelet) {
    wavelet.ring = one.domain.kind == Domain::kCylinder;
    wavelet.forest = one.domain.forest;
  };
  if (one.component == Component::kGeometry) {
    if (!header.geometry) header.geometry.emplace();
    header.geometry->regions.side_log2 = one.region_log2;
    takeDomain(header.geometry->wavelet);
    header.geometry->visit(v, one.domain.grid);
    header.layers.visit(v);
    header.geometry->visitBound(v);
    v.endParts(header.geometry->later_parts);
  } else {
    if (!header.texture) header.texture.emplace();
    header.texture->regions.side_log2 = one.region_log2;
    takeDomain(header.texture->wavelet);
    header.texture->visit(v, one.domain.grid);
  }
}

template <class V>
void visitComponent(V& v, StreamHeader& header, std::vector<Domain>& domains,
                    ListedComponent& one) {
  v.u8("component_kind", one.kind, 0, UINT8_MAX);
  v.u8("region_log2", one.region_log2, 0, kMostRegionLog2);
  visitDomain(v, domains, one.domain);
  if (!v.ok()) return;
  if constexpr (V::kReads) one.component = roleOf(one, header);
  if (one.component == Component::kOther) return v.rest(one.rest);
  v.require("region_log2", one.region_log2 == 0 || one.region_log2 >= kLeastRegionLog2);
  visitKnown(v, header, one);
}

/// As many as there are.
template <class V>
void visitComponents(V& v, StreamHeader& header) {
  const std::vector<ListedComponent> written =
      V::kReads ? std::vector<ListedComponent>() : listOf(header);
  std::vector<ListedComponent> read;
  std::vector<Domain> domains;
  for (size_t i = 0; i < kMostListed; ++i) {
    const bool is_there = i < written.size();
    ListedComponent one = is_there ? written[i] : ListedComponent();
    if (!v.part(kComponentPart, is_there,
                [&](auto& part) { visitComponent(part, header, domains, one); }))
      break;
    if constexpr (V::kReads) read.push_back(std::move(one));
  }
  if constexpr (V::kReads) header.components = std::move(read);
}

}  // namespace tetrakis::inline stream
