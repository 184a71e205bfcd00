// SPDX-License-Identifier: Apache-2.0
// The functions here write notes of commands, which are no errors, on standard error.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "apps/tools/files/file_bytes.hpp"
#include "base/coordinates.hpp"
#include "base/shown_text.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

/// A line on standard error, whatever texts of streams and files it quotes.
inline void tellLine(const std::string& text) {
  std::fprintf(stderr, "%s\n", shownText(text).c_str());
}

/// The same of a note, unless it is empty or -q is given.
inline void tellNote(const std::string& text, bool quiet) {
  if (!quiet && !text.empty()) tellLine("note: " + text);
}

/// What is to be said where heights count as metres beside the ground; "" if their unit is a
/// length.
inline std::string guessedUnitNote(const tks_info& info) {
  if (!info.has_heights) return "";
  if (*info.unit == '\0')
    return "the stream does not tell the unit of its heights, which counts as metres";
  if (metresPerUnit(info.unit)) return "";
  return "the unit of the heights, " + quoted(info.unit) + ", is no length and counts as metres";
}

/// What is to be said of a mesh that has more triangles than were asked for (0: any number); "" of
/// others.
inline std::string coarsestNote(uint32_t triangles, uint32_t asked) {
  if (asked == 0 || triangles <= asked) return "";
  return "the mesh has " + std::to_string(triangles) + " triangles: the coarsest one";
}

}  // namespace tetrakis::tools
