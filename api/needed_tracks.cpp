// SPDX-License-Identifier: Apache-2.0
#include "api/needed_tracks.hpp"

#include <algorithm>

#include "bitstream/stream/correction_tracks.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/lines/shown_lines.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet_header.hpp"

namespace tetrakis::inline api {

namespace {

/// For each track of coefficients, by its number, whether the view needs it.
std::vector<bool> neededTracks(const auto& header, const View& view) {
  const Pyramid pyramid(header.extent());
  const ViewSynthesis synthesis(specOf(header.wavelet), pyramid, view);
  const std::vector<Region> regions =
      regionsOf(header.width, header.height, header.regions.side_log2);
  std::vector<bool> needed(regions.size());
  needed.front() = true;  // the component's opening and the coarsest levels
  for (size_t i = 1; i < regions.size(); ++i) {
    const std::vector<BandPart> parts = partsOf(pyramid.subbands(), regions[i]);
    needed[i] = std::any_of(parts.begin(), parts.end(),
                            [&](const BandPart& part) { return synthesis.needs(part); });
  }
  return needed;
}

}  // namespace

std::vector<bool> neededTracks(const StreamHeader& header, Component component, const View& view) {
  if (component == Component::kTexture)
    return neededTracks(*header.texture, codedView(*header.texture, view));
  const GeometryHeader& geometry = *header.geometry;
  const View lines = codedView(geometry, view);
  std::vector<bool> needed = neededTracks(geometry, decodedView(geometry, header.layers, lines));
  if (correctionTracks(geometry, header.layers) == 0) return needed;
  const Window all{0, 0, geometry.width, geometry.height};
  for (const Window& part : correctionParts(geometry.extent(), geometry.regions.side_log2))
    needed.push_back(view.level == 0 && part.meets(lines.window.value_or(all)));
  return needed;
}

}  // namespace tetrakis::inline api
