// SPDX-License-Identifier: Apache-2.0
// A SequenceServer serves a sequence by HTTP: GET gives ranges of its file to anybody, POST takes a
// control message and answers it with the bytes that help that receiver most. Nobody waits for
// anybody: each connection has its thread, and the transmitter is locked while it chooses bytes,
// not while they are sent.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "apps/tools/serve/connections.hpp"
#include "apps/tools/serve/growing_file.hpp"
#include "apps/tools/serve/http_server.hpp"
#include "apps/tools/serve/origins.hpp"
#include "tetrakis/transmit.hpp"

namespace tetrakis::tools {

struct ServeOptions {
  std::string path;
  std::string address = kLoopback;
  int port = 0;                           ///< 0: any free one
  bool live = false;                      ///< the file grows
  std::vector<std::string> origins = {};  ///< whose pages are let in, as Origins takes them
  std::function<void(const std::string&)> tell =
      {};  ///< is told why a file is not followed any more
};

class SequenceServer {
 public:
  /// Reads what there is of the file, and takes the port.
  static Result<std::unique_ptr<SequenceServer>> open(const ServeOptions& options);
  ~SequenceServer();

  /// Of the file; control messages go there as well.
  std::string url() const;

  /// Serves until stop(). TKS_IO: the server ended by itself.
  Status run();
  void stop();

 private:
  struct Parts {
    GrowingFile file;
    Transmitter transmitter;
    Origins origins;
  };
  SequenceServer(const ServeOptions& options, Parts parts);

  std::string path() const;
  void addRoutes();
  /// Whether a request is answered before its body is read.
  bool answersAtOnce(const httplib::Request& request, httplib::Response& response) const;
  void takeMessage(const httplib::Request& request, httplib::Response& response,
                   const httplib::ContentReader& read);
  Result<Buffer> answer(std::span<const uint8_t> control, std::optional<uint64_t> after);
  /// Takes the bytes that the file has more.
  Status follow();
  void followUntilStopped();

  ServeOptions options_;
  Origins origins_;
  int port_ = 0;
  GrowingFile file_;
  std::mutex lock_;  ///< of the transmitter
  std::condition_variable grown_;
  Transmitter transmitter_;
  std::atomic<bool> stopped_ = false;
  CrowdedServer server_;
  std::thread follower_;
};

}  // namespace tetrakis::tools
