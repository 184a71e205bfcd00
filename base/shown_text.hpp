// SPDX-License-Identifier: Apache-2.0
// shownText() and shownLines() make text of streams and files safe to print: it then steers no
// terminal, turns no line around and begins no line.
#pragma once

#include <string>
#include <string_view>

namespace tetrakis::inline base {

/// Ordinary UTF-8 as it is. Escaped as in JSON: control characters (C0, DEL, C1), line and
/// paragraph separators, marks that change the direction of writing, and invisible ones that
/// annotate. Bytes that are no UTF-8 become \x and two digits.
std::string shownText(std::string_view text);

/// The same of several lines, with tabulators. JSON remains the same JSON.
std::string shownLines(std::string_view text);

}  // namespace tetrakis::inline base
