// SPDX-License-Identifier: Apache-2.0
// heightWindow() and textureWindow() tell which samples and which texels `tetrakis decode --window`
// asks for.
#pragma once

#include <optional>

#include "apps/tools/commands/decode_arguments.hpp"

namespace tetrakis::tools {

/// The samples of the heights, or of a texture without heights; nothing: all of them.
std::optional<tks_window> heightWindow(const DecodeArguments& arguments);

/// The texels over the areas of these samples; nothing: all of them.
std::optional<tks_window> textureWindow(const DecodeArguments& arguments, const tks_info& info);

/// TKS_USAGE if the window is empty or reaches out of the raster. Columns that go round the Earth
/// go on behind the last one.
Status checkWindow(const DecodeArguments& arguments, const tks_info& info);

}  // namespace tetrakis::tools
