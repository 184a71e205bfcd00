// SPDX-License-Identifier: Apache-2.0
// What pages of other origins may do with a server (CORS: the Fetch standard, 3.2). A server that
// listens where a page's reader is lets that page in behind every wall, so a page has to come from
// this machine itself, whose programs reach the server in any case, or from an origin that whoever
// started the server has named. Of a strange page not even a message counts: it could make the
// server forget receivers. Programs that are no pages send no Origin.
#pragma once

#include <httplib.h>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

class Origins {
 public:
  /// named: as http://example.org:8000; "*" is any. TKS_USAGE: one is no origin.
  static Result<Origins> of(std::vector<std::string> named);

  /// Says in a response what a page may do. True: that is all of the response, as the page asks
  /// only for that, or may do nothing.
  bool answers(const httplib::Request& request, httplib::Response& response) const;

 private:
  bool allows(const std::string& origin) const;

  std::vector<std::string> named_;
};

}  // namespace tetrakis::tools
