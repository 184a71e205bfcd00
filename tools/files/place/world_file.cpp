// SPDX-License-Identifier: Apache-2.0
#include "tools/files/place/world_file.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <vector>

#include "tools/files/file_bytes.hpp"
#include "tools/files/text.hpp"

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

/// Numbers between blanks; nothing if anything else is there.
std::optional<std::vector<double>> numbersIn(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<double> numbers;
  for (size_t at = text.find_first_not_of(kBlanks); at != text.npos;
       at = text.find_first_not_of(kBlanks, at)) {
    const size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    std::string_view word = text.substr(at, end - at);
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || stop != word.data() + word.size()) return std::nullopt;
    numbers.push_back(number);
    at = end;
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
    const auto numbers = numbersIn({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    const Status damaged(TKS_IO, "cannot read " + quoted(path.string()) +
                                     ": a world file holds six numbers; repair or remove it");
    if (!numbers || numbers->size() != 6) return damaged;
    // In the file's order: A D B E, then the middle of the first sample.
    const std::vector<double>& n = *numbers;
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
