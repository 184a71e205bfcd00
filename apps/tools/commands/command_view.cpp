// SPDX-License-Identifier: Apache-2.0
// tetrakis view: shows a stream or a sequence in the browser, or what tetrakis serve serves. A
// server only on this machine's loopback address hands out the file, by byte ranges, and the files
// of the viewer, and nothing else.
#include <httplib.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/serve/http_server.hpp"

namespace tetrakis::tools {
namespace {

namespace fs = std::filesystem;

struct ViewerFile {
  const char* name;
  const char* type;
};
constexpr std::array<ViewerFile, 12> kViewerFiles = {
    {{"index.html", "text/html; charset=utf-8"},
     {"style.css", "text/css; charset=utf-8"},
     {"start.js", "text/javascript; charset=utf-8"},
     {"chunk.js", "text/javascript; charset=utf-8"},
     {"viewer.js", "text/javascript; charset=utf-8"},
     {"worker.js", "text/javascript; charset=utf-8"},
     {"encode_worker.js", "text/javascript; charset=utf-8"},
     {"read_files.js", "text/javascript; charset=utf-8"},
     {"read_mesh.js", "text/javascript; charset=utf-8"},
     {"tetrakis.wasm", "application/wasm"},
     {"tetrakis-encode.wasm", "application/wasm"},
     {"tetrakis-encode-object.wasm", "application/wasm"}}};

struct ViewArguments {
  StreamSource source;
  int port = 0;
  bool open_browser = true;
};

/// Where the viewer is: as installed beside this program, else as scripts/web built it.
Result<fs::path> viewerFolder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  for (const fs::path& folder : {program.parent_path().parent_path() / TETRAKIS_VIEWER_INSTALLED,
                                 fs::path(TETRAKIS_VIEWER_BUILT)})
    if (fs::exists(folder / "index.html", ignored)) return folder;
  return Status(TKS_IO, "the viewer is not built: scripts/web builds it, before installation too");
}

/// The name of the stream to the viewer, unlike those of its own files.
std::string nameInViewer(const std::string& path) {
  constexpr const char* kUsual = "terrain.tks";
  const std::string name = nameInUrl(path == "-" ? "" : path, kUsual);
  const bool taken = std::any_of(kViewerFiles.begin(), kViewerFiles.end(),
                                 [&](const ViewerFile& file) { return name == file.name; });
  return taken ? kUsual : name;
}

/// Bytes that outlive the server.
ServedBytes heldBytes(const std::vector<std::byte>& bytes) {
  return {[&bytes] { return bytes.size(); },
          [&bytes](size_t begin, size_t count, httplib::DataSink& sink) {
            return begin <= bytes.size() && count <= bytes.size() - begin &&
                   sink.write(reinterpret_cast<const char*>(bytes.data()) + begin, count);
          }};
}

Status addViewer(httplib::Server& server, const fs::path& folder) {
  for (const ViewerFile& file : kViewerFiles) {
    const Result<std::vector<std::byte>> bytes = readBytes((folder / file.name).string());
    if (!bytes.ok()) return bytes.status();
    const auto content = std::make_shared<const std::string>(
        reinterpret_cast<const char*>(bytes->data()), bytes->size());
    const auto answer = [content, type = file.type](const httplib::Request&,
                                                    httplib::Response& response) {
      response.set_content(*content, type);
    };
    server.Get(std::string("/") + file.name, answer);
    if (std::string_view(file.name) == "index.html") server.Get("/", answer);
  }
  return {};
}

void openBrowser(const std::string& address) {
#ifdef __APPLE__
  const std::string command = "open '" + address + "'";
#else
  const std::string command = "xdg-open '" + address + "' > /dev/null 2>&1 &";
#endif
  // Nothing but letters, digits and "._-:/?=%" is in the address. A machine without a browser has
  // the address on its terminal.
  if (std::system(command.c_str()) != 0) return;
}

bool isAddress(const std::string& path) {
  return path.starts_with("http://") || path.starts_with("https://");
}

/// Serves the viewer, whose address ends so, and what was added to the server before.
Status serveViewer(httplib::Server& server, const ViewArguments& arguments,
                   const std::string& asked) {
  const Result<fs::path> folder = viewerFolder();
  if (!folder.ok()) return folder.status();
  if (Status status = addViewer(server, *folder); !status.ok()) return status;
  answerLoopbackAlone(server);
  const Result<int> port = bindServer(server, kLoopback, arguments.port);
  if (!port.ok()) return port.status();
  const std::string address =
      "http://" + std::string(kLoopback) + ":" + std::to_string(*port) + "/?" + asked;
  std::printf("%s\n", address.c_str());
  std::fflush(stdout);
  if (arguments.open_browser) openBrowser(address);
  return server.listen_after_bind() ? Status() : Status(TKS_IO, "the server ended unexpectedly");
}

Status view(const ViewArguments& arguments) {
  httplib::Server server;
  const StreamSource& source = arguments.source;
  if (isAddress(source.path)) {
    if (source.bytes || source.strict)
      return Status(TKS_USAGE, "--bytes and --strict are of files, not of what is served");
    return serveViewer(server, arguments, "live=" + valueInUrl(source.path));
  }
  const Result<std::vector<std::byte>> bytes = readCut(source);
  if (!bytes.ok()) return bytes.status();
  const std::string name = nameInViewer(source.path);
  addBytes(server, "/" + name, heldBytes(*bytes));
  return serveViewer(server, arguments, "tks=" + percentEncoded(name));
}

}  // namespace

void addView(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App& verb = *app.add_subcommand("view", "Show a stream in the browser, until interrupted");
  addSource(verb, arguments->source);
  verb.add_option("--port", arguments->port, "Port of the loopback address (default: any free one)")
      ->check(silent(CLI::Range(1, 65535)))
      ->type_name("N");
  verb.add_flag_callback(
      "--no-browser", [arguments] { arguments->open_browser = false; }, "Only print the address");
  verb.callback([arguments, &line] { line.action = [arguments] { return view(*arguments); }; });
}

}  // namespace tetrakis::tools
