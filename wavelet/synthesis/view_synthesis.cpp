// SPDX-License-Identifier: Apache-2.0
#include "wavelet/synthesis/view_synthesis.hpp"

#include <cassert>

namespace tetrakis::inline synthesis {

void keepNeeded(const ViewSynthesis& synthesis, std::span<const BandPart> parts,
                std::vector<BandPlan>& bands) {
  if (parts.empty()) return;
  assert(bands.size() % parts.size() == 0);
  bool any = false;
  for (size_t i = 0; i < bands.size(); ++i) {
    bands[i].needed = synthesis.needs(parts[i % parts.size()]);
    any |= bands[i].needed;
  }
  if (!any) bands.clear();
}

}  // namespace tetrakis::inline synthesis
