// SPDX-License-Identifier: Apache-2.0
// Objects as heights over a base mesh.
#pragma once

#include "api/object_inputs.hpp"

namespace tetrakis::inline api {

/// Within the target of the options: over the base mesh that serves it best.
Result<CodedObject> encodeResampled(GivenObject& given);

}  // namespace tetrakis::inline api
