// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/named_files.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {

NamedFile namedFile(const std::string& given) {
  const size_t sign = given.find('=');
  std::error_code ignored;
  if (sign == std::string::npos || std::filesystem::exists(given, ignored)) return {"", given};
  return {given.substr(0, sign), given.substr(sign + 1)};
}

std::vector<NamedFile> namedFiles(const std::vector<std::string>& given) {
  std::vector<NamedFile> files;
  for (const std::string& one : given) files.push_back(namedFile(one));
  return files;
}

namespace {

Status takeWeight(const std::string& given, std::vector<NamedFile>& files) {
  const size_t sign = std::min(given.find('='), given.size());
  const std::string name = given.substr(0, sign);
  double weight = 0;
  const char *begin = given.data() + std::min(sign + 1, given.size()),
             *end = given.data() + given.size();
  const auto [rest, error] = std::from_chars(begin, end, weight);
  if (error != std::errc() || rest != end || !(weight > 0) || std::isinf(weight))
    return {TKS_USAGE, quoted(given) + " is no weight: write for example normals=0.5"};
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const NamedFile& file) { return file.name == name; });
  if (found == files.end())
    return {TKS_USAGE, quoted(given) + " is a weight of nothing: no stream has that name"};
  found->weight = weight;
  return {};
}

}  // namespace

Status takeWeights(const std::vector<std::string>& weights, std::vector<NamedFile>& files) {
  for (const std::string& weight : weights)
    if (Status status = takeWeight(weight, files); !status.ok()) return status;
  return {};
}

tks_combined asCombined(const NamedFile& file, std::span<const uint8_t> stream) {
  return {sizeof(tks_combined), stream.data(), stream.size(), file.name.c_str(), file.weight};
}

Status aboutFile(const Status& status, const std::vector<NamedFile>& files) {
  const std::string& message = status.message();
  for (size_t i = 0; i < files.size(); ++i) {
    const std::string number = "Stream " + std::to_string(i) + ": ";
    if (message.rfind(number, 0) == 0)
      return {status.code(), quoted(files[i].path) + ": " + message.substr(number.size())};
  }
  return status;
}

}  // namespace tetrakis::tools
