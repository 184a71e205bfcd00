// SPDX-License-Identifier: Apache-2.0
// CrowdedServer is an HTTP server whose connections take turns: there are so many threads, and
// where more clients come, the connection ends that has waited for its client longest. So clients
// that begin a request and never end it, that send or read it byte by byte, or that merely stay,
// hold up nobody, whatever their number. A connection of httplib's own would keep its thread as
// long as a byte comes in time, and the memory of a request that has no end.
#pragma once

#include <httplib.h>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>

namespace tetrakis::tools {

/// The socket of a client, with a note of how long it has kept the server waiting. A wait begins
/// with a request, with an answer, or with the rest between these, and whatever comes or goes
/// meanwhile does not shorten it.
class Connection : public httplib::Stream {
 public:
  using Clock = std::chrono::steady_clock;
  struct Limits {
    std::chrono::milliseconds read, write;  ///< without a byte
    size_t request_bytes;
  };

  Connection(socket_t socket, Limits limits) : socket_(socket), limits_(limits) {}

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, size_t size) override;
  ssize_t write(const char* from, size_t size) override;
  using httplib::Stream::write;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

  /// Rests until the next request begins, of so many bytes at most. False: none does within this
  /// time.
  bool awaitRequest(std::chrono::milliseconds most);

  /// Says that no more is answered, and takes what is on its way: bytes that nobody reads would
  /// have the answer thrown away.
  void drain();

  /// When the wait began that goes on; none: the server is at work.
  std::optional<Clock::time_point> waitsSince() const;
  /// Ends it, from another thread.
  void end() const;

 private:
  enum class Phase { kResting, kReading, kWriting };
  bool await(Phase phase, short events, std::chrono::milliseconds most) const;

  socket_t socket_;
  Limits limits_;
  std::array<char, 4096> buffer_ = {};
  size_t begin_ = 0, end_ = 0;  ///< of what came and was not read
  size_t left_ = 0;             ///< bytes that the request may still have
  mutable Phase phase_ = Phase::kResting;
  mutable std::atomic<bool> waits_ = false;
  mutable std::atomic<Clock::rep> since_ = Clock::now().time_since_epoch().count();
};

class CrowdedServer : public httplib::Server {
 public:
  /// request_bytes: that a request may have, with its head. Connections with longer ones end.
  CrowdedServer(size_t threads, size_t request_bytes);

  /// Behind bind: lets many clients come at once, where httplib has the sixth try again after 1 s.
  void widen();

  /// Called by a handler: what follows its request is not read, such as a body that nobody asked
  /// for, which else would be taken for requests. So it is behind every refusal.
  static void endBehindAnswer();

 private:
  class Pool;
  bool process_and_close_socket(socket_t socket) override;
  void serve(Connection& connection);
  void clientCame();
  /// Ends the connections that have waited longest, one for each client without a thread.
  void makeRoom();
  void endAll();

  const size_t threads_, request_bytes_;
  std::mutex lock_;
  std::set<const Connection*> connections_;  ///< but for those that were ended
  size_t queued_ = 0;                        ///< clients that wait for a thread
};

}  // namespace tetrakis::tools
