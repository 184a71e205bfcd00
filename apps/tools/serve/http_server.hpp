// SPDX-License-Identifier: Apache-2.0
// What the servers of `tetrakis view` and `tetrakis serve` have in common: an address that pages
// elsewhere cannot reach, names in URLs, and bytes by ranges.
#pragma once

#include <httplib.h>
#include <functional>
#include <string>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

inline constexpr const char* kLoopback = "127.0.0.1";

/// Whether a host, with or without a port, is a name of this machine to itself.
bool isLoopbackHost(const std::string& host);

/// Whether the Host of a request is this machine: a page elsewhere may not read through a name of
/// its own that leads here.
bool asksForLoopback(const httplib::Request& request);

/// Refuses requests for other hosts.
void answerLoopbackAlone(httplib::Server& server);

/// Takes a port of an address; with 0 a free one.
Result<int> bindServer(httplib::Server& server, const std::string& address, int port);

/// What a file is called in URLs: letters and digits of any script, and "._-", of its name. usual:
/// where nothing is left of it.
std::string nameInUrl(const std::string& path, const std::string& usual);

/// RFC 3986: bytes that are not ASCII as %XX.
std::string percentEncoded(const std::string& name);

/// The same of all bytes but letters, digits and "._-", which is what a value may hold in a query.
std::string valueInUrl(const std::string& text);

/// Bytes that may become more.
struct ServedBytes {
  std::function<size_t()> size;
  /// Writes some of `count` bytes from `begin` on. False: they cannot be had.
  std::function<bool(size_t begin, size_t count, httplib::DataSink& sink)> write;
};

/// Hands out bytes in the ranges that are asked for.
void addBytes(httplib::Server& server, const std::string& path, ServedBytes bytes);

}  // namespace tetrakis::tools
