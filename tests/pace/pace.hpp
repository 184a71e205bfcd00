// SPDX-License-Identifier: Apache-2.0
// How long calls may take (include/tetrakis/tetrakis.h), beside how long they take.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace tetrakis::test {

/// How much slower this build on this machine is than the one that the limits are for, at least 1:
/// by a stream of noise, which takes 0.2 microseconds a sample there.
double slowness();

/// What takes longer than it may of all calls that read a stream; empty: nothing. slow: slowness().
std::string slowCall(std::span<const uint8_t> stream, double slow);

}  // namespace tetrakis::test
