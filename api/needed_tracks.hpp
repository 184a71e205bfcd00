// SPDX-License-Identifier: Apache-2.0
// neededTracks() lists the tracks of a component that a view of it needs.
#pragma once

#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline api {

/// For each track, by its number, whether the view needs it. view: of the lines that are shown.
std::vector<bool> neededTracks(const StreamHeader& header, Component component, const View& view);

}  // namespace tetrakis::inline api
