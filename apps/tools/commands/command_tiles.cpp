// SPDX-License-Identifier: Apache-2.0
// tetrakis tiles: a stream as a folder of tiles for globes.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/temporary.hpp"
#include "apps/tools/output/progress.hpp"
#include "apps/tools/tiles/terrain_tiles.hpp"

namespace tetrakis::tools {
namespace {

namespace fs = std::filesystem;

struct TilesArguments {
  StreamSource source;
  std::string folder, format = "quantized-mesh";
  uint32_t threads = hardwareThreads();
  bool no_skirts = false, force = false;
};

/// A folder that is written beside its place and appears whole or not at all. One that is not empty
/// is replaced by force, and only if tiles were made there before.
class TileFolder {
 public:
  static Result<TileFolder> plan(const std::string& path, bool force) {
    TileFolder folder;
    folder.path_ = fs::absolute(path).lexically_normal();
    if (!folder.path_.has_filename()) folder.path_ = folder.path_.parent_path();
    std::error_code error;
    if (fs::exists(folder.path_, error)) {
      const std::string name = quoted(path);
      if (!fs::is_directory(folder.path_, error)) return Status(TKS_IO, name + " is no folder");
      folder.replaces_ = !fs::is_empty(folder.path_, error);
      if (folder.replaces_ && !force)
        return Status(TKS_IO, name + " is not empty: -f replaces tiles in it");
      if (folder.replaces_ && !fs::exists(folder.path_ / "layer.json", error) &&
          !fs::exists(folder.path_ / "tileset.json", error))
        return Status(TKS_IO, name + " holds something else than tiles: name another folder");
    }
    Result<Temporary> staging = Temporary::makeFolder(folder.path_.parent_path());
    if (!staging.ok()) return staging.status();
    folder.staging_ = std::move(*staging);
    fs::create_directory(folder.staging_.path() / "new", error);
    return folder;
  }

  std::string staging() const { return (staging_.path() / "new").string(); }

  Status commit() {
    Status status;
    std::error_code error;
    if (replaces_) {
      status = replaceFolder(staging(), path_, staging_.path() / "old");
    } else {
      fs::rename(staging(), path_, error);
      if (error) status = {TKS_IO, error.message()};
    }
    if (status.ok()) return status;
    return {TKS_IO, "cannot write " + quoted(path_.string()) + ": " + status.message()};
  }

 private:
  TileFolder() = default;
  fs::path path_;
  bool replaces_ = false;
  Temporary staging_;
};

Status makeTiles(const TilesArguments& arguments, bool quiet) {
  TileOptions options;
  if (arguments.format == "3dtiles") options.format = TileFormat::k3dTiles;
  options.skirts = !arguments.no_skirts && options.format == TileFormat::k3dTiles;
  if (arguments.no_skirts && options.format != TileFormat::k3dTiles)
    return {TKS_USAGE, "--no-skirts is for --format 3dtiles: quantized-mesh has none"};
  Result<OpenStream> stream = openStream(arguments.source);
  if (!stream.ok()) return stream.status();
  stream->decoder.setThreads(arguments.threads);
  Result<TileFolder> folder = TileFolder::plan(arguments.folder, arguments.force);
  if (!folder.ok()) return folder.status();
  Progress progress("tiles", quiet);
  const Result<TileSetSize> written =
      writeTerrainTiles(stream->decoder, options, folder->staging(),
                        [&progress](double done) { Progress::report(&progress, done); });
  if (!written.ok()) return written.status();
  if (const Status status = folder->commit(); !status.ok()) return status;
  tellNote(guessedUnitNote(stream->decoder.info()), quiet);
  if (!quiet) {
    const std::string pictures =
        written->pictures == 0 ? "" : std::to_string(written->pictures) + " of imagery, ";
    tellLine(arguments.folder + ": " + std::to_string(written->tiles) + " tiles, levels " +
             std::to_string(written->first) + " to " + std::to_string(written->deepest) + ", " +
             pictures + std::to_string(written->bytes) + " bytes");
  }
  return {};
}

}  // namespace

void addTiles(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<TilesArguments>();
  CLI::App& verb = *app.add_subcommand("tiles", "Make terrain tiles for a globe out of a stream");
  addSource(verb, arguments->source);
  addComponent(verb, arguments->source);
  verb.add_option("-o,--output", arguments->folder, "Folder for the tiles")
      ->required()
      ->type_name("DIR");
  verb.add_option("--format", arguments->format,
                  "Of the tiles: quantized-mesh (default) or 3dtiles")
      ->check(silent(CLI::IsMember({"quantized-mesh", "3dtiles"})))
      ->type_name("NAME");
  verb.add_flag("--no-skirts", arguments->no_skirts,
                "Leave out the walls below the edges of tiles (3dtiles)");
  addThreads(verb, arguments->threads);
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return makeTiles(*arguments, line.quiet); };
  });
}

}  // namespace tetrakis::tools
