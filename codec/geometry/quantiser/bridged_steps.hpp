// SPDX-License-Identifier: Apache-2.0
// The functions here choose and mark the bridged voids of heights in steps
// (codec/wavelet/bridges.hpp).
#pragma once

#include <cstdint>

#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/wavelet/choice/bridge_choice.hpp"

namespace tetrakis::inline quantiser {

/// The steps with bridges of the given reach over voids; 0: without any.
HeightSteps withBridges(HeightSteps steps, Extent plane, uint8_t reach);

/// The steps with the bridges that pay, if any do.
HeightSteps withBridgesFor(const BridgeTarget& target, HeightSteps steps, Extent plane);

}  // namespace tetrakis::inline quantiser
