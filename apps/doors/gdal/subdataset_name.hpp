// SPDX-License-Identifier: Apache-2.0
// What datasets are called: a file, one of the two parts of it, a further component, a frame, or a
// part of a frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <cpl_string.h>
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

class Source;

/// TKS:"file":heights, TKS:"file":component=2, TKS:"file":frame=17, TKS:"file":frame=17:texture,
/// also without the quotes.
struct SubdatasetName {
  std::string file;
  std::optional<tks_part> part;
  std::optional<uint64_t> frame = std::nullopt;
  std::string component = "";  ///< by its name or number; "": none is named
};

/// Whether a name is meant for one, well formed or not.
bool isSubdatasetName(const char* text);

/// Nothing after a reported error.
std::optional<SubdatasetName> subdatasetName(const char* text);

std::string nameOf(const SubdatasetName& subdataset);
/// The same without file: "frame=17:texture".
std::string selectionOf(const SubdatasetName& subdataset);

/// What the domain SUBDATASETS lists of a file with heights and textures of frames [first, end):
/// the heights, which are bands, and the texture of each frame, if there is one, up to a thousand.
CPLStringList subdatasetsOf(const std::string& file, const tks_info& info, uint64_t first,
                            uint64_t end);

/// Adds the components beside the first heights and the first texture.
void addComponents(const Source& source, CPLStringList& list);

/// The word for a part.
const char* partName(tks_part part);

}  // namespace tetrakis::gdal
