// SPDX-License-Identifier: Apache-2.0
// The functions here write the notes of `tetrakis encode` about its inputs and about the stream
// that it has made. A note is "" where there is nothing to say.
#pragma once

#include <string>

#include "apps/tools/commands/encode_arguments.hpp"
#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/files.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// How many samples are void.
std::string voidNote(const HeightFile& heights);

/// What is guessed of heights because something relies on it, unless one of the notes that were
/// told has asked for it.
Notes guesses(const EncodeArguments& arguments, const HeightFile& heights, const Notes& told);

/// That columns go round the Earth, and one of them is there twice, or a part of one is, or lacks.
std::string roundNote(const std::string& name, const HeightFile& heights);

/// How large a cube is, and how far it is from the heights that it was made of.
std::string cubeNote(const HeightFile& cube, const CubeErrors& errors);

/// What counts as white of a texture, if it is not the largest value.
std::string whiteNote(const std::string& texture, const ImageFile& image);

/// That the texture has a place of its own, and does not cover the heights.
std::string placeNote(const std::string& texture, const HeightFile& heights,
                      const ImageFile& image);

/// That a largest error has made the stream lossless: the bound may be so small that nothing but
/// every bit keeps it, or every bit takes fewer bytes than anything else that keeps it.
std::string boundNote(const EncodeArguments& arguments, const tks_info& info);

/// That the mask of voids is missing: one of many holes may take more bytes than all heights are to
/// have.
std::string maskNote(const tks_info& info);

/// One line about the stream that was written to a file of this name.
std::string summary(const std::string& name, const Decoder& decoder);

}  // namespace tetrakis::tools
