// SPDX-License-Identifier: Apache-2.0
// listOf() and the functions beside it visit the list of domains and components that a header
// begins with (docs/FORMAT.md, section 2). Streams of later versions may have domains and
// components that this decoder does not know: it keeps their descriptions as bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

inline constexpr uint64_t kDomainPart = 0, kComponentPart = 1;  ///< kinds of parts of the body
inline constexpr size_t kMostListed = 16;                       ///< domains, and components

/// Of a component that is known, as its header says it.
inline ListedComponent listed(const StreamHeader& header, Component component) {
  const bool heights = component == Component::kGeometry;
  const auto fill = [&](const auto& of, uint8_t kind) {
    const uint8_t domain = of.wavelet.ring ? Domain::kCylinder : Domain::kGrid;
    return ListedComponent{component, kind, {domain, of.shown(), ""}, of.regions.side_log2, ""};
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

template <class V>
void visitDomain(V& v, Domain& domain) {
  v.u8("domain_kind", domain.kind, 0, UINT8_MAX);
  if (!domain.isKnown()) return v.rest(domain.rest);
  v.varint("width", domain.grid.width, 1, kMaxSide);
  v.varint("height", domain.grid.height, 1, kMaxSide);
}

template <class V>
void visitKnown(V& v, StreamHeader& header, const ListedComponent& one) {
  const bool ring = one.domain.kind == Domain::kCylinder;
  if (one.component == Component::kGeometry) {
    if (!header.geometry) header.geometry.emplace();
    header.geometry->regions.side_log2 = one.region_log2;
    header.geometry->wavelet.ring = ring;
    header.geometry->visit(v, one.domain.grid);
    header.layers.visit(v);
    header.geometry->visitBound(v);
    v.endParts(header.geometry->later_parts);
  } else {
    if (!header.texture) header.texture.emplace();
    header.texture->regions.side_log2 = one.region_log2;
    header.texture->wavelet.ring = ring;
    header.texture->visit(v, one.domain.grid);
  }
}

template <class V>
void visitComponent(V& v, StreamHeader& header, const std::vector<Domain>& domains,
                    ListedComponent& one) {
  v.u8("component_kind", one.kind, 0, UINT8_MAX);
  auto domain = static_cast<uint64_t>(std::find(domains.begin(), domains.end(), one.domain) -
                                      domains.begin());
  v.varint("domain", domain, 0, kMostListed - 1);
  v.require("the domain of a component", domain < domains.size());
  v.u8("region_log2", one.region_log2, 0, kMostRegionLog2);
  if (!v.ok()) return;
  if constexpr (V::kReads) {
    one.domain = domains[domain];
    one.component = roleOf(one, header);
  }
  if (one.component == Component::kOther) return v.rest(one.rest);
  v.require("region_log2", one.region_log2 == 0 || one.region_log2 >= kLeastRegionLog2);
  visitKnown(v, header, one);
}

/// Parts of one kind, as many as there are. visitOne(part, item).
template <class V, class Item, class VisitOne>
void visitList(V& v, uint64_t kind, std::vector<Item>& list, VisitOne visitOne) {
  for (size_t i = 0; i < kMostListed; ++i) {
    const bool is_there = i < list.size();
    Item item = is_there ? list[i] : Item();
    if (!v.part(kind, is_there, [&](auto& part) { visitOne(part, item); })) return;
    if constexpr (V::kReads) list.push_back(std::move(item));
  }
}

template <class V>
void visitComponents(V& v, StreamHeader& header) {
  std::vector<ListedComponent> components;
  std::vector<Domain> domains;
  if constexpr (!V::kReads) {
    components = listOf(header);
    for (const ListedComponent& one : components) {
      if (std::find(domains.begin(), domains.end(), one.domain) == domains.end())
        domains.push_back(one.domain);
    }
  }
  visitList(v, kDomainPart, domains, [](auto& part, Domain& one) { visitDomain(part, one); });
  visitList(v, kComponentPart, components,
            [&](auto& part, ListedComponent& one) { visitComponent(part, header, domains, one); });
  if constexpr (V::kReads) header.components = std::move(components);
}

}  // namespace tetrakis::inline stream
