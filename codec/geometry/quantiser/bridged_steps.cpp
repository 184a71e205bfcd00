// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/bridged_steps.hpp"

#include <utility>

#include "codec/wavelet/bridges.hpp"
#include "codec/wavelet/choice/bridge_fill.hpp"

namespace tetrakis::inline quantiser {

HeightSteps withBridges(HeightSteps steps, Extent plane, uint8_t reach) {
  steps.bridge = reach;
  steps.lifted.clear();
  if (reach == 0) return steps;
  steps.lifted = liftedSamples(steps.valid, plane, reach);
  steps.steps = bridged({steps.steps, plane, steps.valid}, steps.lifted);
  return steps;
}

HeightSteps withBridgesFor(const BridgeTarget& target, HeightSteps steps, Extent plane) {
  if (steps.valid.empty()) return steps;
  BridgedPlane bridged = chooseBridges({steps.steps, plane, steps.valid}, steps.range_bits, target);
  if (bridged.reach == 0) return steps;
  steps.bridge = bridged.reach;
  steps.lifted = std::move(bridged.lifted);
  steps.steps = std::move(bridged.values);
  return steps;
}

}  // namespace tetrakis::inline quantiser
