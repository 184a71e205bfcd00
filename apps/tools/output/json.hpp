// SPDX-License-Identifier: Apache-2.0
// The functions here print results on standard output: JSON for programs, the same as a table for
// people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

/// Keeps the order of insertion.
using Json = nlohmann::ordered_json;

/// JSON null for "": the texts of a stream use it for unknown.
Json textOrNull(const std::string& text);

/// A number, or null where JSON has none (infinity, not a number).
Json finiteOrNull(double value);

/// The same with numbers of six digits, and all digits before the point: for people.
Json legible(Json json);

/// Indented JSON with a final newline. Bytes that are no UTF-8 are replaced.
std::string dump(const Json& json);

/// One line a value, keys aligned, members of objects as "object.member"; null is "-". Texts
/// are as shownText() shows them: a stream cannot steer the terminal.
std::string table(const Json& json);

/// Writes lines, or JSON, to standard output as shownLines() shows them. TKS_IO if that fails.
Status print(const std::string& given);

}  // namespace tetrakis::tools
