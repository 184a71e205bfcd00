// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/serve/connections.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <optional>

namespace tetrakis::tools {

namespace {

bool isReady(socket_t socket, short events, std::chrono::milliseconds most) {
  pollfd polled = {socket, events, 0};
  int ready = 0;
  do ready = poll(&polled, 1, static_cast<int>(most.count()));
  while (ready < 0 && errno == EINTR);
  return ready > 0;
}

/// Whether the connection that this thread serves ends behind the answer.
thread_local bool ends = false;

using NameOf = int (*)(int, sockaddr*, socklen_t*);

void nameInto(NameOf nameOf, socket_t socket, std::string& ip, int& port) {
  sockaddr_storage address = {};
  socklen_t size = sizeof address;
  char text[INET6_ADDRSTRLEN] = "";
  if (nameOf(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return;
  if (address.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
    inet_ntop(AF_INET, &v4.sin_addr, text, sizeof text);
    port = ntohs(v4.sin_port);
  } else if (address.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
    inet_ntop(AF_INET6, &v6.sin6_addr, text, sizeof text);
    port = ntohs(v6.sin6_port);
  }
  ip = text;
}

}  // namespace

bool Connection::await(Phase phase, short events, std::chrono::milliseconds most) const {
  if (phase != phase_) since_ = Clock::now().time_since_epoch().count();
  phase_ = phase;
  waits_ = true;
  const bool is_ready = isReady(socket_, events, most);
  waits_ = false;
  return is_ready;
}

bool Connection::is_readable() const {
  return begin_ < end_ || await(Phase::kReading, POLLIN, limits_.read);
}

bool Connection::is_writable() const {
  return await(Phase::kWriting, POLLOUT, limits_.write);
}

ssize_t Connection::read(char* to, size_t size) {
  if (left_ == 0) return -1;
  if (begin_ == end_) {
    if (!await(Phase::kReading, POLLIN, limits_.read)) return -1;
    ssize_t got = 0;
    do got = recv(socket_, buffer_.data(), buffer_.size(), 0);
    while (got < 0 && errno == EINTR);
    if (got <= 0) return got;
    begin_ = 0;
    end_ = static_cast<size_t>(got);
  }
  const size_t given = std::min({size, end_ - begin_, left_});
  std::copy_n(buffer_.begin() + static_cast<ptrdiff_t>(begin_), given, to);
  begin_ += given;
  left_ -= given;
  return static_cast<ssize_t>(given);
}

ssize_t Connection::write(const char* from, size_t size) {
  if (!await(Phase::kWriting, POLLOUT, limits_.write)) return -1;
  ssize_t given = 0;
  do given = send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  while (given < 0 && errno == EINTR);
  return given < 0 && errno == EAGAIN ? 0 : given;
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  nameInto(getpeername, socket_, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  nameInto(getsockname, socket_, ip, port);
}

bool Connection::awaitRequest(std::chrono::milliseconds most) {
  left_ = limits_.request_bytes;
  return begin_ < end_ || await(Phase::kResting, POLLIN, most);
}

void Connection::drain() {
  constexpr std::chrono::milliseconds kLongest(100);
  constexpr size_t kMost = 64 << 10;
  shutdown(socket_, SHUT_WR);
  for (size_t left = kMost; left >= buffer_.size() && await(Phase::kReading, POLLIN, kLongest);
       left -= buffer_.size())
    if (recv(socket_, buffer_.data(), buffer_.size(), 0) <= 0) return;
}

std::optional<Connection::Clock::time_point> Connection::waitsSince() const {
  if (!waits_) return std::nullopt;
  return Clock::time_point(Clock::duration(since_));
}

void Connection::end() const {
  shutdown(socket_, SHUT_RDWR);
}

/// Tells the server of clients that wait for a thread, and of time that passes while they do.
class CrowdedServer::Pool : public httplib::ThreadPool {
 public:
  explicit Pool(CrowdedServer& server) : ThreadPool(server.threads_), server_(server) {}
  void enqueue(std::function<void()> job) override {
    server_.clientCame();
    ThreadPool::enqueue(std::move(job));
  }
  void on_idle() override { server_.makeRoom(); }
  void shutdown() override {
    server_.endAll();
    ThreadPool::shutdown();
  }

 private:
  CrowdedServer& server_;
};

CrowdedServer::CrowdedServer(size_t threads, size_t request_bytes)
    : threads_(threads), request_bytes_(request_bytes) {
  constexpr std::chrono::milliseconds kBetweenLooks(50);
  new_task_queue = [this] { return new Pool(*this); };
  set_idle_interval(kBetweenLooks);
  // Of what httplib refuses it may have left the rest in the socket.
  set_error_handler(HandlerWithResponse([](const httplib::Request&, httplib::Response&) {
    endBehindAnswer();
    return HandlerResponse::Unhandled;
  }));
}

void CrowdedServer::endBehindAnswer() {
  ends = true;
}

void CrowdedServer::widen() {
  ::listen(svr_sock_, SOMAXCONN);
}

void CrowdedServer::endAll() {
  const std::lock_guard held(lock_);
  for (const Connection* connection : connections_) connection->end();
}

void CrowdedServer::clientCame() {
  {
    const std::lock_guard held(lock_);
    ++queued_;
  }
  makeRoom();
}

void CrowdedServer::makeRoom() {
  const std::lock_guard held(lock_);
  while (queued_ > 0 && connections_.size() + queued_ > threads_) {
    const Connection* longest = nullptr;
    Connection::Clock::time_point begin;
    for (const Connection* connection : connections_) {
      const auto since = connection->waitsSince();
      if (!since || (longest != nullptr && *since >= begin)) continue;
      longest = connection;
      begin = *since;
    }
    if (longest == nullptr) return;  // all are at work, which takes no longer than others wait
    longest->end();
    connections_.erase(longest);
  }
}

bool CrowdedServer::process_and_close_socket(socket_t socket) {
  using std::chrono::milliseconds, std::chrono::seconds;
  Connection connection(socket, {milliseconds(seconds(read_timeout_sec_)),
                                 milliseconds(seconds(write_timeout_sec_)), request_bytes_});
  {
    const std::lock_guard held(lock_);
    --queued_;
    connections_.insert(&connection);
  }
  serve(connection);
  {
    const std::lock_guard held(lock_);
    connections_.erase(&connection);
  }
  shutdown(socket, SHUT_RDWR);
  close(socket);
  return true;
}

void CrowdedServer::serve(Connection& connection) {
  const std::chrono::seconds most(keep_alive_timeout_sec_);
  for (size_t left = keep_alive_max_count_; left > 0; --left) {
    // In short steps, as a server that ends waits for no client.
    constexpr std::chrono::milliseconds kStep(100);
    auto rested = std::chrono::milliseconds(0);
    while (svr_sock_ != INVALID_SOCKET && rested < most && !connection.awaitRequest(kStep))
      rested += kStep;
    if (svr_sock_ == INVALID_SOCKET || rested >= most) return;
    bool is_closed = ends = false;
    const bool goes_on = process_request(connection, left == 1, is_closed, nullptr) && !is_closed;
    if (ends) connection.drain();
    if (!goes_on || ends) return;
  }
}

}  // namespace tetrakis::tools
