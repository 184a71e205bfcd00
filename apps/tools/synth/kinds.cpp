// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/synth/kinds.hpp"

#include "apps/tools/synth/artefacts.hpp"
#include "apps/tools/synth/landforms.hpp"

namespace tetrakis::tools::synth {

Storage reshape(Relief& relief, SynthKind kind, uint32_t size, uint64_t seed) {
  const KindTask task{relief, size, hash(seed, 6, 0)};
  switch (kind) {
    case SynthKind::kMountains:
      return {};
    case SynthKind::kCoast:
      return drown(task);
    case SynthKind::kLakes:
      return fillHollows(task);
    case SynthKind::kSteps:
      return quantise(task);
    case SynthKind::kVoids:
      return pierce(task);
    case SynthKind::kPlain:
      return flatten(task);
    case SynthKind::kCity:
      return build(task);
    case SynthKind::kRescaled:
      return rescale(task);
    case SynthKind::kBands:
      return layer(task);
    case SynthKind::kGeoid:
      return raise(task);
    case SynthKind::kMosaic:
      return join(task);
    case SynthKind::kTurned:
      return turn(task);
    case SynthKind::kFacets:
      return triangulate(task);
    case SynthKind::kSmooth:
      return smoothen(task);
  }
  return {};
}

}  // namespace tetrakis::tools::synth
