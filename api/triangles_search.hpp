// SPDX-License-Identifier: Apache-2.0
// Objects as triangles that are coded as they are, or fewer ones.
#pragma once

#include "api/object_inputs.hpp"

namespace tetrakis::inline api {

/// Within the target of the options: with as many triangles, on as fine a grid, as serve it best.
Result<CodedObject> encodeTriangles(GivenObject& given);

}  // namespace tetrakis::inline api
