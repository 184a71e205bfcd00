// SPDX-License-Identifier: Apache-2.0
// tagNumber() reads numbers that tags of TIFF files hold as texts, such as GDAL's nodata value.
#pragma once

#include <optional>
#include <string_view>

namespace tetrakis::tools {

/// Nothing but blanks and zeros.
bool isBlank(std::string_view text);

/// The number, infinite ones and NaN included; nothing if the text is none.
std::optional<double> tagNumber(std::string_view text);

}  // namespace tetrakis::tools
