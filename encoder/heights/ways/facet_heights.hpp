// SPDX-License-Identifier: Apache-2.0
// codeFacets() codes floats of a surface that consists of facets (codec/geometry/facets/): it cuts
// the coefficients, and codes how each sample goes on from its neighbours.
#pragma once

#include <cstdint>
#include <optional>

#include "codec/geometry/facets/facet_share.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// The facets of heights, if they hold enough of the samples.
std::optional<FacetShare> facetsOf(const QuantisedHeights& heights);

/// Whether heights of these facets may take no more than so many bytes.
bool mayFit(const FacetShare& facets, const QuantisedHeights& heights, uint64_t bytes);

/// Heights to the last bit, in any number of tracks; nothing if no steps come near them. facets:
/// of their samples.
std::optional<CodedHeights> codeFacets(const EncodeInputs& inputs, const FacetShare& facets);

/// The facets of lossy heights, if they may follow a cut of these in so many bytes in all.
std::optional<FacetShare> facetsOf(const CodedHeights& lossy, uint64_t room);

/// Lossy heights, cut where they leave room for what restores their samples in so many bytes.
/// Prefixes up to the cut are those of the lossy heights. Nothing if there is no such cut. facets:
/// facetsOf() them.
std::optional<CodedHeights> codeFacets(const CodedHeights& lossy, const FacetShare& facets,
                                       uint64_t room, uint32_t threads);

}  // namespace tetrakis::inline ways
