// SPDX-License-Identifier: Apache-2.0
// The functions here read and write heights without a header: SRTM tiles (.hgt) and raw samples.
#pragma once

#include <optional>
#include <string>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// "u8" … "f32".
std::string sampleName(tks_sample sample);

/// "file.raw:WIDTHxHEIGHT:type", taken apart.
struct RawName {
  std::string path;
  uint32_t width = 0, height = 0;
  tks_sample sample = TKS_U8;
};

/// Empty if the text does not end in ":WIDTHxHEIGHT:type".
std::optional<RawName> parseRawName(const std::string& text);

Result<HeightFile> readRaw(const RawName& name);
Status writeRaw(const std::string& path, const HeightFile& heights);

/// What a tile that lies there is called ("N46W122.hgt"); "" if they are no tile of one degree.
std::string hgtName(const HeightFile& heights);

/// Whether a file of this name is a tile of SRTM or NASADEM (.hgt, .hgts).
bool isNamedHgt(const std::string& path);
Result<HeightFile> readHgt(const std::string& path);
Status writeHgt(const std::string& path, const HeightFile& heights);

}  // namespace tetrakis::tools
