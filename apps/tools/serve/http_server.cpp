// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/serve/http_server.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/shown_text.hpp"

namespace tetrakis::tools {

namespace {

/// The name in a Host field without its port, in lower case: names of hosts are the same in any
/// case, and IPv6 addresses stand in brackets (RFC 3986, 3.2.2).
std::string nameOfHost(std::string host) {
  const size_t bracket = host.starts_with('[') ? host.find(']') : 0;
  const size_t colon = bracket == std::string::npos ? bracket : host.find(':', bracket);
  host.resize(std::min(colon, host.size()));
  for (char& letter : host)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return host;
}

bool isAscii(char letter) {
  return static_cast<unsigned char>(letter) < 0x80;
}

bool isPlain(char letter) {
  return isAscii(letter) && (std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                             std::string_view("._-").find(letter) != std::string::npos);
}

/// A text whose bytes are %XX but for those that are kept.
std::string encodedBut(bool (*isKept)(char), const std::string& text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (isKept(letter))
      encoded += letter;
    else
      encoded += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return encoded;
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

}  // namespace

bool isLoopbackHost(const std::string& host) {
  const std::string name = nameOfHost(host);
  return name == kLoopback || name == "localhost" || name == "[::1]";
}

bool asksForLoopback(const httplib::Request& request) {
  return request.get_header_value_count("Host") == 1 &&
         isLoopbackHost(request.get_header_value("Host"));
}

void answerLoopbackAlone(httplib::Server& server) {
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (asksForLoopback(request)) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
}

Result<int> bindServer(httplib::Server& server, const std::string& address, int port) {
  // By default httplib shares a port with whoever listens there, and either gets the other's
  // requests.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const int bound = port == 0                            ? server.bind_to_any_port(address)
                    : server.bind_to_port(address, port) ? port
                                                         : -1;
  if (bound > 0) return bound;
  const std::string place = address == kLoopback ? "" : " of " + shownText(address);
  return Status(TKS_IO, port == 0 ? "there is no free port" + place
                                  : "port " + std::to_string(port) + place + " is taken");
}

std::string nameInUrl(const std::string& path, const std::string& usual) {
  std::string name = std::filesystem::path(path).filename().string();
  const bool is_utf8 = isUtf8(name);
  for (char& letter : name)
    if (isAscii(letter) ? !isPlain(letter) : !is_utf8) letter = '_';
  return name.empty() || name[0] == '.' ? usual : name;
}

std::string percentEncoded(const std::string& name) {
  return encodedBut(isAscii, name);
}

std::string valueInUrl(const std::string& text) {
  return encodedBut(isPlain, text);
}

void addBytes(httplib::Server& server, const std::string& path, ServedBytes bytes) {
  server.Get(path, [bytes = std::move(bytes)](const httplib::Request& request,
                                              httplib::Response& response) {
    const size_t size = bytes.size();
    // The request is the server's own object, which it reads the ranges from afterwards.
    auto& ranges = const_cast<httplib::Request&>(request).ranges;
    if (!cutRanges(ranges, static_cast<ssize_t>(size))) {
      response.set_header("Content-Range", "bytes */" + std::to_string(size));
      response.status = 416;
      return;
    }
    response.set_content_provider(size, "application/octet-stream", bytes.write);
  });
}

}  // namespace tetrakis::tools
