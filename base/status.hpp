// SPDX-License-Identifier: Apache-2.0
// The library reports failures with the Status and the Result of its C++ interface.
#pragma once

#include "tetrakis/result.hpp"
