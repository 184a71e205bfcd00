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
#include "bitstream/stream/glue.hpp"
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
  const auto add = [&](Component component, const ComponentDetails& details) {
    if (!std::exchange(left[static_cast<size_t>(component)], false)) return;
    list.push_back(listed(header, component));
    list.back().details = details;
  };
  for (const ListedComponent& known : header.components) {
    if (known.component == Component::kOther)
      list.push_back(known);
    else
      add(known.component, known.details);
  }
  add(Component::kGeometry, {});
  add(Component::kTexture, {});
  return list;
}

/// The component that a decoder takes one of the list for, given those before it.
inline Component roleOf(const ListedComponent& one, size_t number, const StreamHeader& before) {
  const auto takes = [&](const std::optional<size_t>& chosen, bool has_one) {
    return chosen ? *chosen == number : !has_one;
  };
  if (one.isHeights() && takes(before.choice.heights, before.geometry.has_value()))
    return Component::kGeometry;
  if (one.isTexture() && takes(before.choice.texture, before.texture.has_value()))
    return Component::kTexture;
  return Component::kOther;
}

/// The first heights of a list, or null.
inline const ListedComponent* firstHeights(const std::vector<ListedComponent>& list) {
  const auto first = std::find_if(list.begin(), list.end(),
                                  [](const ListedComponent& one) { return one.isHeights(); });
  return first != list.end() ? &*first : nullptr;
}

/// The first texture, or null.
inline const ListedComponent* firstTexture(const std::vector<ListedComponent>& list) {
  const auto first = std::find_if(list.begin(), list.end(),
                                  [](const ListedComponent& one) { return one.isTexture(); });
  return first != list.end() ? &*first : nullptr;
}

/// Whether a header that was read has what was chosen.
inline bool has(const StreamHeader& header, const ComponentChoice& choice) {
  const std::vector<ListedComponent>& list = header.components;
  const auto [heights, texture] = choice;
  return (!heights || (*heights < list.size() && list[*heights].isHeights())) &&
         (!texture || (*texture < list.size() && list[*texture].isTexture()));
}

/// A forest of the list whose sides are glued as those of a domain.
inline std::vector<Domain>::const_iterator gluedAlike(const std::vector<Domain>& known,
                                                      const Domain& domain) {
  return std::find_if(known.begin(), known.end(), [&](const Domain& other) {
    return other.forest != nullptr && other.forest->sides() == domain.forest->sides();
  });
}

/// most: patches.
template <class V>
void visitGlue(V& v, uint64_t most, std::vector<uint32_t>& sides) {
  uint64_t patches = sides.size() / Forest::kSides;
  v.varint("patches", patches, 1, most);
  std::string glue;
  if constexpr (!V::kReads) glue = encodeGlue(sides);
  v.text("glue", glue);
  if constexpr (V::kReads) {
    if (!v.ok()) return;
    auto read = decodeGlue(glue, static_cast<uint32_t>(patches));
    v.require("glue", read.has_value());
    if (read) sides = std::move(*read);
  }
}

/// known: the domains of the components before. A forest whose sides are glued as those of one of
/// them says no more than which it is.
template <class V>
void visitForest(V& v, const std::vector<Domain>& known, Domain& domain, uint8_t kind) {
  uint64_t depth = 0, alike = 0;
  std::vector<uint32_t> sides;
  if constexpr (!V::kReads) {
    depth = static_cast<uint64_t>(domain.forest->depth());
    sides = domain.forest->sides();
    alike = static_cast<uint64_t>(gluedAlike(known, domain) - known.begin());
  }
  v.u8("depth", depth, 1, Forest::kMostDepth);
  if (!v.ok()) return;
  const uint64_t most = Forest::mostPatches(static_cast<int>(depth));
  if (kind == Domain::kForestAlike) {
    v.varint("alike", alike, 0, UINT64_MAX);
    v.require("alike", V::kReads ? alike < known.size() && known[alike].forest != nullptr : true);
    if constexpr (V::kReads) {
      if (v.ok()) sides = known[alike].forest->sides();
    }
  } else {
    visitGlue(v, most, sides);
  }
  v.require("patches", !v.ok() || sides.size() <= Forest::kSides * most);
  if constexpr (V::kReads) {
    if (!v.ok()) return;
    domain.kind = Domain::kForest;
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
  uint8_t kind = domain.kind;
  if constexpr (!V::kReads) {
    if (kind == Domain::kForest && gluedAlike(known, domain) != known.end())
      kind = Domain::kForestAlike;
  }
  v.u8("domain_kind", kind, 0, UINT8_MAX);
  domain.kind = kind;
  if (kind == Domain::kForest || kind == Domain::kForestAlike) {
    visitForest(v, known, domain, kind);
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
    header.geometry->visitOthers(v);
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
void visitComponent(V& v, StreamHeader& header, std::vector<Domain>& domains, size_t number,
                    ListedComponent& one) {
  v.u8("component_kind", one.kind, 0, UINT8_MAX);
  v.u8("region_log2", one.region_log2, 0, kMostRegionLog2);
  visitDomain(v, domains, one.domain);
  if (!v.ok()) return;
  if constexpr (V::kReads) one.component = roleOf(one, number, header);
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
                [&](auto& part) { visitComponent(part, header, domains, i, one); }))
      break;
    if constexpr (V::kReads) read.push_back(std::move(one));
  }
  if constexpr (V::kReads) header.components = std::move(read);
}

}  // namespace tetrakis::inline stream
