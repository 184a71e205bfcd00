// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/synthesis/view_synthesis.hpp"

#include <cassert>

namespace tetrakis::inline synthesis {

std::vector<BandPlan> withNeeds(const ViewSynthesis& synthesis, std::span<const BandPart> parts,
                                std::vector<BandPlan> bands) {
  assert(parts.empty() ? bands.empty() : bands.size() % parts.size() == 0);
  bool any = false;
  for (size_t i = 0; i < bands.size(); ++i) {
    bands[i].needed = synthesis.needs(parts[i % parts.size()]);
    any |= bands[i].needed;
  }
  if (!any) return {};
  return bands;
}

}  // namespace tetrakis::inline synthesis
