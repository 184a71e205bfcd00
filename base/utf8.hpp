// SPDX-License-Identifier: Apache-2.0
// isUtf8() tells whether bytes are UTF-8 (RFC 3629), so that broken text of streams and files is
// not passed on.
#pragma once

#include <cstddef>
#include <string_view>

namespace tetrakis::inline base {

/// In the shortest form, without surrogates, up to U+10FFFF.
bool isUtf8(std::string_view text);

/// The bytes of the first character of a text that is not empty; 0: it begins with none.
size_t utf8Length(std::string_view text);

}  // namespace tetrakis::inline base
