// SPDX-License-Identifier: Apache-2.0
// ExplainedPlans takes the plans that the library says it has weighed for a stream, and writes them
// as JSON for programs or as a table for people.
#pragma once

#include <string>

#include "apps/tools/output/json.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

class ExplainedPlans {
 public:
  /// Makes the options tell this object, which outlives the encoding.
  void askFor(tks_encode_options& options);

  /// An array for each component, null where the stream lacks it.
  const Json& json() const { return json_; }
  /// A block for each component, a line for each plan.
  std::string table() const;

 private:
  static void take(void* self, const tks_weighed_plan* plan);

  Json json_ = {{"heights", nullptr}, {"texture", nullptr}};
};

}  // namespace tetrakis::tools
