// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/serve/sequence_server.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "apps/tools/files/stream.hpp"

namespace tetrakis::tools {

namespace {

constexpr uint32_t kReceivers = 64;
constexpr size_t kThreads = kReceivers + 16;    ///< for those who read ranges besides
constexpr size_t kMostRequestBytes = 32 << 10;  ///< with their heads: more than browsers send
constexpr uint64_t kKeptFrames = 1024;          ///< of a live sequence; ranges give older ones
constexpr std::chrono::milliseconds kBetweenLooks(30);
constexpr std::chrono::seconds kLongestWait(2), kLongestWrite(30);

std::string_view textOf(std::span<const uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void refuse(const Status& status, httplib::Response& response) {
  response.status = status.code() == TKS_USAGE ? 409 : 400;
  response.set_content(status.message() + "\n", "text/plain; charset=utf-8");
}

/// Sends an answer chunk by chunk, as its reader takes it.
void send(Buffer answer, httplib::Response& response) {
  constexpr size_t kChunk = 16 << 10;
  const auto kept = std::make_shared<const Buffer>(std::move(answer));
  response.set_chunked_content_provider("application/octet-stream",
                                        [kept](size_t begin, httplib::DataSink& sink) {
                                          const std::string_view all = textOf(kept->bytes());
                                          if (begin >= all.size()) return sink.done(), true;
                                          const std::string_view chunk = all.substr(begin, kChunk);
                                          return sink.write(chunk.data(), chunk.size());
                                        });
}

/// The number of ?after=N.
std::optional<uint64_t> afterOf(const httplib::Request& request) {
  if (!request.has_param("after")) return std::nullopt;
  const std::string text = request.get_param_value("after");
  const bool is_number = !text.empty() && text.size() < 19 &&
                         text.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::optional<uint64_t>(std::stoull(text)) : std::nullopt;
}

}  // namespace

SequenceServer::SequenceServer(const ServeOptions& options, Parts parts)
    : options_(options),
      origins_(std::move(parts.origins)),
      file_(std::move(parts.file)),
      transmitter_(std::move(parts.transmitter)),
      server_(kThreads, kMostRequestBytes) {}

Result<std::unique_ptr<SequenceServer>> SequenceServer::open(const ServeOptions& options) {
  Result<Origins> origins = Origins::of(options.origins);
  if (!origins.ok()) return origins.status();
  Result<GrowingFile> file = GrowingFile::open(options.path);
  if (!file.ok()) return file.status();
  tks_transmitter_options transmit = makeTransmitterOptions();
  const tks_limits limits = limitsOfTools();
  transmit.limits = &limits;
  transmit.receivers = kReceivers;
  Result<Transmitter> transmitter = Transmitter::open(transmit);
  if (!transmitter.ok()) return transmitter.status();
  std::unique_ptr<SequenceServer> server(new SequenceServer(
      options, {*std::move(file), *std::move(transmitter), *std::move(origins)}));
  if (Status status = server->follow(); !status.ok()) return status;
  if (!options.live && server->transmitter_.info().end_frame == 0)
    return Status(TKS_TRUNCATED, "the sequence has no frame; --live waits for some");
  server->addRoutes();
  const Result<int> port = bindServer(server->server_, options.address, options.port);
  if (!port.ok()) return port.status();
  server->server_.widen();
  server->port_ = *port;
  return server;
}

SequenceServer::~SequenceServer() {
  stop();
  if (follower_.joinable()) follower_.join();
}

std::string SequenceServer::path() const {
  return "/" + nameInUrl(options_.path, "sequence.tks");
}

std::string SequenceServer::url() const {
  return "http://" + options_.address + ":" + std::to_string(port_) + percentEncoded(path());
}

Status SequenceServer::run() {
  if (stopped_) return {};
  if (options_.live) follower_ = std::thread([this] { followUntilStopped(); });
  const bool ended_well = server_.listen_after_bind() || stopped_;
  stop();
  return ended_well ? Status() : Status(TKS_IO, "the server ended unexpectedly");
}

void SequenceServer::stop() {
  {
    const std::lock_guard held(lock_);
    stopped_ = true;
  }
  grown_.notify_all();
  server_.stop();
}

void SequenceServer::addRoutes() {
  server_.set_payload_max_length(TKS_MOST_CONTROL_BYTES);
  server_.set_keep_alive_max_count(1 << 20);
  server_.set_write_timeout(kLongestWrite);
  server_.set_tcp_nodelay(true);
  server_.set_pre_routing_handler(
      [this](const httplib::Request& request, httplib::Response& response) {
        using Answer = httplib::Server::HandlerResponse;
        const bool is_answered = answersAtOnce(request, response);
        // The request is the server's own object: httplib would cut such parts out of an answer.
        if (is_answered || request.method == "POST")
          const_cast<httplib::Request&>(request).ranges.clear();
        if (!is_answered) return Answer::Unhandled;
        CrowdedServer::endBehindAnswer();  // there may be a body
        return Answer::Handled;
      });
  addBytes(server_, path(),
           {[this] { return static_cast<size_t>(file_.size()); },
            [this](size_t begin, size_t count, httplib::DataSink& sink) {
              std::vector<uint8_t> bytes(std::min<size_t>(count, 64 << 10));
              const std::string_view text = textOf(bytes);
              return file_.read(begin, bytes) && sink.write(text.data(), text.size());
            }});
  server_.Post(
      path(), [this](const httplib::Request& request, httplib::Response& response,
                     const httplib::ContentReader& read) { takeMessage(request, response, read); });
}

bool SequenceServer::answersAtOnce(const httplib::Request& request,
                                   httplib::Response& response) const {
  const bool is_read = request.method == "GET" || request.method == "HEAD";
  if (options_.address == kLoopback && !asksForLoopback(request))
    return response.status = 403, true;
  if (request.path != path()) return response.status = 404, true;
  if (origins_.answers(request, response)) return true;
  if (!is_read && request.method != "POST") return response.status = 405, true;
  if (!is_read && request.is_multipart_form_data()) return response.status = 415, true;
  return false;
}

void SequenceServer::takeMessage(const httplib::Request& request, httplib::Response& response,
                                 const httplib::ContentReader& read) {
  std::vector<uint8_t> control;
  const auto take = [&](const char* data, size_t size) {
    control.insert(control.end(), data, data + std::min(size, TKS_MOST_CONTROL_BYTES + size_t{1}));
    return control.size() <= TKS_MOST_CONTROL_BYTES;  // whatever length was announced, if any
  };
  if (!read(take)) {
    if (response.status != 413)
      response.status = control.size() > TKS_MOST_CONTROL_BYTES ? 413 : 400;
    return;
  }
  Result<Buffer> given = answer(control, afterOf(request));
  if (given.ok())
    send(*std::move(given), response);
  else
    refuse(given.status(), response);
}

Result<Buffer> SequenceServer::answer(std::span<const uint8_t> control,
                                      std::optional<uint64_t> after) {
  std::unique_lock held(lock_);
  if (after && options_.live) {
    const uint64_t bytes = transmitter_.info().bytes;  // a group may come in parts
    grown_.wait_for(held, kLongestWait, [&] {
      const tks_sequence_info info = transmitter_.info();
      return stopped_ || info.end_frame > *after || info.bytes != bytes;
    });
  }
  return transmitter_.answer(control);
}

Status SequenceServer::follow() {
  for (;;) {
    const Result<std::vector<uint8_t>> more = file_.more();
    if (!more.ok()) return more.status();
    if (more->empty()) return {};
    const std::lock_guard held(lock_);
    if (Status status = transmitter_.append(*more); !status.ok()) return status;
    const uint64_t end = transmitter_.info().end_frame;
    if (!options_.live || end <= kKeptFrames) continue;
    if (Status status = transmitter_.forget(end - kKeptFrames); !status.ok()) return status;
  }
}

void SequenceServer::followUntilStopped() {
  while (!stopped_) {
    if (const Status status = follow(); !status.ok()) {
      return options_.tell(status.message() + "; what was there before is still served");
    }
    grown_.notify_all();
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

}  // namespace tetrakis::tools
