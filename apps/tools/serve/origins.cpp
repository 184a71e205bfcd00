// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/serve/origins.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/serve/http_server.hpp"

namespace tetrakis::tools {

namespace {

/// The host of an origin, with its port; "": it has none.
std::string hostOf(const std::string& origin) {
  for (const std::string_view scheme : {"http://", "https://"})
    if (origin.starts_with(scheme)) return origin.substr(scheme.size());
  return {};
}

bool isOrigin(const std::string& text) {
  const std::string host = hostOf(text);
  return text == "*" || (!host.empty() && host.find_first_of("/?# ") == std::string::npos);
}

}  // namespace

Result<Origins> Origins::of(std::vector<std::string> named) {
  for (const std::string& origin : named)
    if (!isOrigin(origin))
      return Status(
          TKS_USAGE,
          tools::quoted(origin) + " is no origin as https://example.org, without a path; * is any");
  Origins origins;
  origins.named_ = std::move(named);
  return origins;
}

bool Origins::allows(const std::string& origin) const {
  if (isLoopbackHost(hostOf(origin))) return true;
  return std::any_of(named_.begin(), named_.end(),
                     [&](const std::string& name) { return name == "*" || name == origin; });
}

bool Origins::answers(const httplib::Request& request, httplib::Response& response) const {
  const bool asks = request.method == "OPTIONS";
  response.set_header("Vary", "Origin");
  if (request.has_header("Origin")) {
    const std::string origin = request.get_header_value("Origin");
    if (request.get_header_value_count("Origin") != 1 || !allows(origin)) {
      response.status = 403;
      response.set_content("pages of this origin are let in by --origin\n",
                           "text/plain; charset=utf-8");
      return true;
    }
    response.set_header("Access-Control-Allow-Origin", origin);
    response.set_header("Access-Control-Expose-Headers", "Content-Range");
  }
  if (!asks) return false;
  response.set_header("Access-Control-Allow-Methods", "GET, POST");
  response.set_header("Access-Control-Allow-Headers", "Content-Type, Range");
  response.set_header("Access-Control-Max-Age", "600");
  response.status = 204;
  return true;
}

}  // namespace tetrakis::tools
