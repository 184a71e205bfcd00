// SPDX-License-Identifier: Apache-2.0
// Open options and creation options, in GDAL's words.
#pragma once

#include <optional>
#include <string>

#include <cpl_string.h>
#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {

extern const char* const kOpenOptions;      ///< as XML, which GDAL checks names and types by
extern const char* const kCreationOptions;  ///< likewise

/// Nothing after a reported error.
std::optional<OpenSettings> openSettings(const std::string& name, CSLConstList options);

struct CopySettings {
  tks_encode_options encode;  ///< but for the index
  double max_z_error = 0;     ///< in samples; 0: none
  std::string texture;        ///< a dataset; "": none
  std::optional<tks_index> index;
  std::optional<tks_domain> domain;  ///< nothing: as the columns say; a forest: a cube
  uint32_t depth = 0;                ///< of a cube; 0: the one that suits the grid
  std::optional<uint32_t> tiles;     ///< side of those of a mosaic; 0: none; nothing: chosen
  bool frames = false;               ///< bands are frames of a sequence
  uint64_t reference = 0;            ///< as of tks_sequence_options
  uint32_t entry = 0;                ///< likewise
  uint32_t white_level = 0;          ///< of a texture; 0: as its dataset says, or found
};

/// Nothing after a reported error.
std::optional<CopySettings> copySettings(const std::string& name, CSLConstList options);

}  // namespace tetrakis::gdal
