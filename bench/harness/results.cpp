// SPDX-License-Identifier: Apache-2.0
// bench/results.csv; see results.hpp.
#include "bench/harness/results.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace tetrakis::bench {
namespace {

constexpr char kHeader[] = "bench,item,codec,quantity,value";

std::string line(const std::string& bench, const ResultRow& row) {
  char value[32];
  std::snprintf(value, sizeof(value), "%.4g", row.value);
  return bench + ',' + row.item + ',' + row.codec + ',' + row.quantity + ',' + value;
}

// The lines of other benches, as they stand in the file; none if there is no file.
std::vector<std::string> otherLines(const std::string& path, const std::string& bench) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string text; std::getline(file, text);) {
    if (text != kHeader && text.rfind(bench + ',', 0) != 0) lines.push_back(text);
  }
  return lines;
}

}  // namespace

Status updateResults(const std::string& path, const std::string& bench,
                     const std::vector<ResultRow>& rows) {
  if (path.empty()) return {};
  std::vector<std::string> lines = otherLines(path, bench);
  // Benches stand in alphabetical order: the new lines go before the first later one.
  auto place = lines.begin();
  while (place != lines.end() && *place < bench) ++place;
  std::vector<std::string> fresh;
  for (const ResultRow& row : rows) fresh.push_back(line(bench, row));
  lines.insert(place, fresh.begin(), fresh.end());

  const std::string temporary = path + ".new";
  std::ofstream file(temporary);
  file << kHeader << '\n';
  for (const std::string& text : lines) file << text << '\n';
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(temporary, path, error);
  if (!file || error) return {TKS_IO, "Cannot write " + path + ": is the folder writable?"};
  return {};
}

}  // namespace tetrakis::bench
