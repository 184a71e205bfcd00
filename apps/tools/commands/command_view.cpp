// SPDX-License-Identifier: Apache-2.0
// tetrakis view: shows a stream or a sequence in the browser. A server only on this machine's
// loopback address hands out the file, by byte ranges, and the files of the viewer, and nothing
// else.
#include <httplib.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "base/shown_text.hpp"

namespace tetrakis::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLoopback = "127.0.0.1";

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

bool isAscii(char letter) {
  return static_cast<unsigned char>(letter) < 0x80;
}

/// The name of the stream to the viewer: letters and digits of any script, and "._-", of its file's
/// name.
std::string nameInViewer(const std::string& path) {
  std::string name = path == "-" ? "" : fs::path(path).filename().string();
  const bool is_utf8 = isUtf8(name);
  for (char& letter : name) {
    const bool kept = isAscii(letter)
                          ? std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                                std::string_view("._-").find(letter) != std::string::npos
                          : is_utf8;
    if (!kept) letter = '_';
  }
  const bool taken = name.empty() || name[0] == '.' ||
                     std::any_of(kViewerFiles.begin(), kViewerFiles.end(),
                                 [&](const ViewerFile& file) { return name == file.name; });
  return taken ? "terrain.tks" : name;
}

/// RFC 3986: bytes that are not ASCII as %XX.
std::string percentEncoded(const std::string& name) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (const char letter : name) {
    if (isAscii(letter)) {
      encoded += letter;
      continue;
    }
    const auto byte = static_cast<unsigned char>(letter);
    encoded += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return encoded;
}

/// The name in a Host field without its port, in lower case: names of hosts are the same in any
/// case, and IPv6 addresses stand in brackets (RFC 3986, 3.2.2).
std::string nameOfHost(std::string host) {
  const size_t bracket = host.front() == '[' ? host.find(']') : 0;
  const size_t colon = bracket == std::string::npos ? bracket : host.find(':', bracket);
  host.resize(std::min(colon, host.size()));
  for (char& letter : host)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return host;
}

/// A page elsewhere may not read the stream through a name of its own that leads here.
bool asksForLoopback(const httplib::Request& request) {
  if (request.get_header_value_count("Host") != 1) return false;
  const std::string host = request.get_header_value("Host");
  if (host.empty()) return false;
  const std::string name = nameOfHost(host);
  return name == kLoopback || name == "localhost" || name == "[::1]";
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
  // Nothing but letters, digits and "._-:/?=" is in the address. A machine without a browser has
  // the address on its terminal.
  if (std::system(command.c_str()) != 0) return;
}

/// The one range that is asked for, cut to what there is. What is no such range, or several, counts
/// as none, as HTTP allows. 0.11 of httplib would read beyond the end. False: nothing of it is
/// there.
bool cutRanges(httplib::Ranges& ranges, ssize_t size) {
  if (ranges.size() != 1) return ranges.clear(), true;
  auto& [first, last] = ranges.front();
  if (first < 0) {
    first = std::max<ssize_t>(0, size - last);  // the last so many bytes
    last = size - 1;
  }
  if (first >= size) return ranges.clear(), false;
  if (last < 0 || last >= size) last = size - 1;
  if (last < first) ranges.clear();
  return true;
}

/// Hands out the bytes in the ranges that are asked for. They outlive the server.
void addStream(httplib::Server& server, const std::string& name,
               const std::vector<std::byte>& bytes) {
  server.Get("/" + name, [&bytes](const httplib::Request& request, httplib::Response& response) {
    // The request is the server's own object, which it reads the ranges from afterwards.
    auto& ranges = const_cast<httplib::Request&>(request).ranges;
    if (!cutRanges(ranges, static_cast<ssize_t>(bytes.size()))) {
      response.set_header("Content-Range", "bytes */" + std::to_string(bytes.size()));
      response.status = 416;
      return;
    }
    const auto write = [&bytes](size_t begin, size_t count, httplib::DataSink& sink) {
      return begin <= bytes.size() && count <= bytes.size() - begin &&
             sink.write(reinterpret_cast<const char*>(bytes.data()) + begin, count);
    };
    response.set_content_provider(bytes.size(), "application/octet-stream", write);
  });
}

/// The port that is asked for, or with 0 a free one. By default httplib shares a port with whoever
/// listens there, and either gets the other's requests.
Result<int> bind(httplib::Server& server, int port) {
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const int bound = port == 0                              ? server.bind_to_any_port(kLoopback)
                    : server.bind_to_port(kLoopback, port) ? port
                                                           : -1;
  if (bound > 0) return bound;
  return Status(TKS_IO, "port " + std::to_string(port) + " is taken");
}

Status view(const ViewArguments& arguments) {
  const Result<std::vector<std::byte>> bytes = readCut(arguments.source);
  if (!bytes.ok()) return bytes.status();
  const Result<fs::path> folder = viewerFolder();
  if (!folder.ok()) return folder.status();
  httplib::Server server;
  if (Status status = addViewer(server, *folder); !status.ok()) return status;
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (asksForLoopback(request)) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  const std::string name = nameInViewer(arguments.source.path);
  addStream(server, name, *bytes);
  const Result<int> port = bind(server, arguments.port);
  if (!port.ok()) return port.status();
  const std::string address = "http://" + std::string(kLoopback) + ":" + std::to_string(*port) +
                              "/?tks=" + percentEncoded(name);
  std::printf("%s\n", address.c_str());
  std::fflush(stdout);
  if (arguments.open_browser) openBrowser(address);
  return server.listen_after_bind() ? Status() : Status(TKS_IO, "the server ended unexpectedly");
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
