// SPDX-License-Identifier: Apache-2.0
// shownText() takes text of a stream or a file, which may hold anything, and returns text that is
// safe to print; isUtf8() refuses what is no text, and describeBytes() puts amounts of memory into
// words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace tetrakis::inline base {

// isUtf8() tells whether bytes are UTF-8 (RFC 3629), so that broken text of streams and files is
// not passed on.

/// In the shortest form, without surrogates, up to U+10FFFF.
bool isUtf8(std::string_view text);

// shownText() and shownLines() make text of streams and files safe to print: it then steers no
// terminal, turns no line around and begins no line.

/// Ordinary UTF-8 as it is. Escaped as in JSON: control characters (C0, DEL, C1), line and
/// paragraph separators, marks that change the direction of writing, and invisible ones that
/// annotate. Bytes that are no UTF-8 become \x and two digits.
std::string shownText(std::string_view text);

/// The same of several lines, with tabulators. JSON remains the same JSON.
std::string shownLines(std::string_view text);

// describeBytes() writes an amount of memory with its unit, for sentences about limits.

/// Returns an amount with its unit, such as "21.5 GiB".
std::string describeBytes(uint64_t bytes);

}  // namespace tetrakis::inline base
