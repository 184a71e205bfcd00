// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/mosaic/work_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPlanName = "plan";
constexpr const char* kSourcesName = "sources.json";

int readFile(void* user, const char* name, uint64_t offset, uint64_t bytes, void* out,
             uint64_t* read) {
  std::ifstream file(static_cast<const WorkFolder*>(user)->file(name), std::ios::binary);
  if (!file) return 1;
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(static_cast<char*>(out), static_cast<std::streamsize>(bytes));
  *read = static_cast<uint64_t>(file.gcount());
  return file.bad() ? 1 : 0;
}

int lengthOf(void* user, const char* name, uint64_t* size) {
  std::error_code error;
  *size = fs::file_size(static_cast<const WorkFolder*>(user)->file(name), error);
  return error ? 1 : 0;
}

bool holds(const fs::path& path, std::span<const char> bytes) {
  std::error_code error;
  if (fs::file_size(path, error) != bytes.size() || error) return false;
  std::ifstream file(path, std::ios::binary);
  std::vector<char> there(bytes.size());
  file.read(there.data(), static_cast<std::streamsize>(there.size()));
  return file && std::equal(there.begin(), there.end(), bytes.begin());
}

/// A name that no other worker takes, on no other machine.
std::string ownName(const std::string& name) {
  std::random_device random;
  std::string own = name;
  own.insert(own.begin(), '.');
  own += ".";
  own += std::to_string(::getpid());
  own += "-";
  return own + std::to_string(random());
}

/// Under another name first, so that readers meet all bytes or none.
bool writeWhole(const fs::path& folder, const std::string& name, std::span<const char> bytes) {
  const fs::path staged = folder / ownName(name);
  std::error_code error;
  {
    std::ofstream file(staged, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
      fs::remove(staged, error);
      return false;
    }
  }
  fs::rename(staged, folder / name, error);
  if (error) fs::remove(staged, error);
  return !error && fs::exists(folder / name, error);
}

/// A low band that has come out the same stays as old as it was, so that nobody works for it again.
int writeFile(void* user, const char* name, const void* data, size_t size) {
  const auto& folder = *static_cast<const WorkFolder*>(user);
  const std::span bytes(static_cast<const char*>(data), size);
  if (std::string_view(name).ends_with(".low") && holds(folder.file(name), bytes)) return 0;
  return writeWhole(folder.path(), name, bytes) ? 0 : 1;
}

Result<std::vector<tks_tile>> tilesOf(const std::vector<uint8_t>& plan, const std::string& path) {
  size_t count = 0;
  const tks_status status = tks_mosaic_tiles(plan.data(), plan.size(), nullptr, 0, &count);
  if (status == TKS_UNSUPPORTED)
    return Status(status, quoted(path) + " is a mosaic of another version: plan it again");
  if (status != TKS_OK) return Status(status, quoted(path) + " has a damaged plan: plan it again");
  std::vector<tks_tile> tiles(count);
  tks_mosaic_tiles(plan.data(), plan.size(), tiles.data(), count, &count);
  return tiles;
}

std::vector<tks_tile> needsOf(const std::vector<uint8_t>& plan, const tks_tile& tile) {
  size_t count = 0;
  tks_mosaic_needs(plan.data(), plan.size(), tile, nullptr, 0, &count);
  std::vector<tks_tile> needs(count);
  tks_mosaic_needs(plan.data(), plan.size(), tile, needs.data(), count, &count);
  return needs;
}

}  // namespace

std::string nameOf(const tks_tile& tile) {
  std::string name = "g";
  name += std::to_string(tile.group);
  name += "-x" + std::to_string(tile.column);
  name += "-y" + std::to_string(tile.row);
  return name;
}

Status WorkFolder::create(const std::string& path, const std::vector<uint8_t>& plan,
                          const std::vector<std::string>& sources,
                          const std::optional<double>& nodata, bool force) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return {TKS_IO, "cannot make the folder " + quoted(path) + ": " + error.message()};
  if (!force && fs::exists(fs::path(path) / kPlanName, error))
    return {TKS_IO, quoted(path) + " holds a mosaic already; -f plans it again"};
  nlohmann::json json = {{"files", nlohmann::json::array()}};
  for (const std::string& source : sources) {
    const bool is_file = fs::exists(source, error);  // else "file.raw:WIDTHxHEIGHT:type"
    json["files"].push_back(is_file ? fs::absolute(source, error).string() : source);
  }
  if (nodata) json["nodata"] = *nodata;
  const std::string text = json.dump(2);
  const std::span bytes(reinterpret_cast<const char*>(plan.data()), plan.size());
  if (writeWhole(path, kSourcesName, text) && writeWhole(path, kPlanName, bytes)) return {};
  return {TKS_IO, "cannot write into " + quoted(path)};
}

Result<WorkFolder> WorkFolder::open(const std::string& path) {
  WorkFolder folder;
  folder.path_ = path;
  const Result<std::vector<std::byte>> plan = readBytes(folder.file(kPlanName).string());
  const Result<std::vector<std::byte>> sources = readBytes(folder.file(kSourcesName).string());
  if (!plan.ok() || !sources.ok())
    return Status(TKS_IO, quoted(path) + " holds no mosaic; `tetrakis mosaic plan` makes one");
  const auto* const first = reinterpret_cast<const uint8_t*>(plan->data());
  folder.plan_.assign(first, first + plan->size());
  const auto* const text = reinterpret_cast<const char*>(sources->data());
  const auto json = nlohmann::json::parse(text, text + sources->size(), nullptr, false);
  if (json.is_discarded() || !json.contains("files") || !json["files"].is_array())
    return Status(TKS_IO, quoted(path) + " has a damaged list of sources: plan it again");
  for (const auto& file : json["files"])
    if (file.is_string()) folder.sources_.push_back(file.get<std::string>());
  if (folder.sources_.empty())
    return Status(TKS_IO, quoted(path) + " has no sources: plan it again");
  if (json.contains("nodata") && json["nodata"].is_number())
    folder.nodata_ = json["nodata"].get<double>();
  const Result<std::vector<tks_tile>> tiles = tilesOf(folder.plan_, path);
  if (!tiles.ok()) return tiles.status();
  uint32_t coding = 0;
  tks_mosaic_coding_groups(folder.plan_.data(), folder.plan_.size(), &coding);
  for (const tks_tile& tile : *tiles) {
    const bool is_last = tile.group == tiles->back().group;
    folder.tasks_.push_back({tile, needsOf(folder.plan_, tile), tile.group >= coding, is_last,
                             !is_last && tile.group + 1 != coding});
  }
  return folder;
}

bool WorkFolder::isDone(const MosaicTask& task, const HeightSource* source) const {
  int done = 0;
  const tks_mosaic_files storage = files();
  if (tks_mosaic_is_done(plan_.data(), plan_.size(), task.tile, &storage, &done) != TKS_OK ||
      done == 0)
    return false;
  std::error_code error;
  const auto made = fs::last_write_time(file(nameOf(task.tile) + ".part"), error);
  if (error) return false;
  const auto is_newer = [&](const fs::path& path) {
    std::error_code missing;
    const auto written = fs::last_write_time(path, missing);
    return !missing && written > made;
  };
  // Tasks that restore read codewords as well, which are in parts.
  const std::string read = task.restores ? ".part" : ".low";
  for (const tks_tile& needed : task.needs)
    if (is_newer(file(nameOf(needed) + read))) return false;
  const bool reads_source = task.restores ? task.is_last : task.tile.group == 0;
  if (source == nullptr || !reads_source) return true;
  tks_window block{};
  tks_mosaic_block(plan_.data(), plan_.size(), task.tile, &block);
  const std::vector<std::string> sources = source->filesOf(block);
  return std::none_of(sources.begin(), sources.end(), is_newer);
}

tks_mosaic_files WorkFolder::files() const {
  // The callbacks take it as const.
  return {sizeof(tks_mosaic_files), readFile, lengthOf, writeFile, const_cast<WorkFolder*>(this)};
}

MosaicSource::MosaicSource(HeightSource& from)
    : source(from), heights(asHeights(from.described())) {
  heights.data = nullptr;
  given = {sizeof given, &heights, &MosaicSource::read, this};
}

int MosaicSource::read(void* user, const tks_window* window, void* samples) {
  auto& self = *static_cast<MosaicSource*>(user);
  self.failure = self.source.read(*window, static_cast<std::byte*>(samples));
  return self.failure.ok() ? 0 : 1;
}

}  // namespace tetrakis::tools
