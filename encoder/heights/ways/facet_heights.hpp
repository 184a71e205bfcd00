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

/// Whether heights with these facets may take at most `bytes` bytes.
bool mayFit(const FacetShare& facets, const QuantisedHeights& heights, uint64_t bytes);

/// Codes heights to the last bit, in any number of tracks; nothing if no steps come near the
/// samples. facets: of the samples.
std::optional<CodedHeights> codeFacets(const EncodeInputs& inputs, const FacetShare& facets);

/// The facets of lossy heights, if corrections from them may follow a cut of the heights in `bytes`
/// bytes together.
std::optional<FacetShare> facetsOf(const CodedHeights& lossy, uint64_t room);

/// Lossy heights, cut where they leave room, within `bytes` bytes, for the corrections that restore
/// their samples. Prefixes up to the cut are those of the lossy heights. Nothing if there is no
/// such cut. facets: facetsOf() the lossy heights.
std::optional<CodedHeights> codeFacets(const CodedHeights& lossy, const FacetShare& facets,
                                       uint64_t room, uint32_t threads);

}  // namespace tetrakis::inline ways
