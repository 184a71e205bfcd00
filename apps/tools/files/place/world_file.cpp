// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/world_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {
namespace fs = std::filesystem;
namespace {

/// "png"; "" if there is none.
std::string extensionOf(const std::string& picture) {
  const std::string extension = picture == "-" ? "" : fs::path(picture).extension().string();
  return extension.size() < 2 ? "" : extension.substr(1);
}

std::string upperCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::vector<fs::path> candidates(const std::string& picture) {
  std::vector<fs::path> paths;
  for (const std::string& extension : {worldFileOf("x." + extensionOf(picture)).substr(2),
                                       extensionOf(picture) + "w", std::string("wld")}) {
    for (const std::string& spelled : {extension, upperCase(extension)})
      paths.push_back(fs::path(picture).replace_extension(spelled));
  }
  return paths;
}

/// As GDAL reads it: "." or "," before the decimals, and what stands behind the number is ignored;
/// nothing where there is none.
std::optional<double> numberIn(std::string line) {
  std::replace(line.begin(), line.end(), ',', '.');
  const size_t start = line.find_first_not_of(" \t+");
  if (start == line.npos) return std::nullopt;
  double number = 0;
  const auto [stop, error] =
      std::from_chars(line.data() + start, line.data() + line.size(), number);
  return error == std::errc() ? std::optional(number) : std::nullopt;
}

/// Of the first six lines that are not blank; nothing if one holds none. Further lines, and the
/// Ctrl-Z with which programs of DOS end a text, are not read.
std::optional<std::array<double, 6>> firstNumbers(std::string_view text) {
  constexpr std::string_view kEnds = "\r\n";
  std::array<double, 6> numbers{};
  size_t count = 0;
  while (count < numbers.size()) {
    const size_t start = text.find_first_not_of(" \t\r\n");
    if (start == text.npos) return std::nullopt;
    text.remove_prefix(start);
    const size_t end = std::min(text.find_first_of(kEnds), text.size());
    const auto number = numberIn(std::string(text.substr(0, end)));
    if (!number) return std::nullopt;
    numbers[count++] = *number;
    text.remove_prefix(end);
  }
  return numbers;
}

}  // namespace

std::string worldFileOf(const std::string& picture) {
  const std::string extension = extensionOf(picture);
  if (extension.empty()) return "";
  return fs::path(picture)
      .replace_extension(std::string{extension.front(), extension.back(), 'w'})
      .string();
}

Result<std::optional<GeoTransform>> readWorldFile(const std::string& picture) {
  if (extensionOf(picture).empty()) return std::optional<GeoTransform>();
  for (const fs::path& path : candidates(picture)) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) continue;
    const auto bytes = readBytes(path.string());
    if (!bytes.ok()) return bytes.status();
    const auto numbers =
        firstNumbers({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    const Status damaged(TKS_IO, "cannot read " + quoted(path.string()) +
                                     ": a world file holds six numbers, one a line; "
                                     "repair or remove it");
    if (!numbers) return damaged;
    // In the file's order: A D B E, then the middle of the first sample.
    const std::array<double, 6>& n = *numbers;
    // GDAL takes no steps of 0 either.
    if ((n[0] == 0 && n[2] == 0) || (n[1] == 0 && n[3] == 0)) return damaged;
    const GeoTransform transform{n[4] - (n[0] + n[2]) / 2, n[0], n[2],
                                 n[5] - (n[1] + n[3]) / 2, n[1], n[3]};
    if (!isSound(transform)) return damaged;
    return std::optional(transform);
  }
  return std::optional<GeoTransform>();
}

Status writeWorldFile(const std::string& picture, const GeoTransform& t) {
  const std::string path = worldFileOf(picture);
  if (path.empty()) return {};
  std::string text;
  for (const double number :
       {t[1], t[4], t[2], t[5], t[0] + (t[1] + t[2]) / 2, t[3] + (t[4] + t[5]) / 2})
    text += shortest(number) + '\n';
  return writeBytes(path, std::as_bytes(std::span(text)));
}

}  // namespace tetrakis::tools
