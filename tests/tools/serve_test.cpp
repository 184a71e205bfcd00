// SPDX-License-Identifier: Apache-2.0
// SequenceServer and its client: ranges for anybody, the helpful bytes for receivers, whoever lies,
// is slow or stops writing.
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <thread>

#include "apps/tools/serve/received_sequence.hpp"
#include "apps/tools/serve/sequence_server.hpp"
#include "bitstream/sequence/control_message.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/sequences.hpp"

namespace tetrakis::test {
namespace {

using tools::ReceiveOptions;
using tools::Reception;
using tools::SequenceServer;

constexpr uint32_t kFrames = 12;

FrameRasters hills() {
  return movingFrames({samples::Pattern::kHills, 70, 60, 1, TKS_I16}, kFrames);
}

const Bytes& encodedHills() {
  static const Bytes bytes = [] {
    const tks_encode_options encode = lossless();
    tks_sequence_options options = optionsOf(encode, 2);
    options.clock.numerator = 1;
    options.clock.denominator = 3;
    options.reference = 500;
    return encodeSequence(hills(), options).bytes;
  }();
  return bytes;
}

/// A server that runs while it lives.
class Running {
 public:
  explicit Running(const std::string& path, bool live = false,
                   std::vector<std::string> origins = {})
      : server_(
            *SequenceServer::open({.path = path,
                                   .live = live,
                                   .origins = std::move(origins),
                                   .tell = [this](const auto& text) { told_.set_value(text); }})),
        thread_([this] { EXPECT_TRUE(server_->run().ok()); }) {
    while (!client().Get("/")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ~Running() {
    server_->stop();
    thread_.join();
  }
  std::string url() const { return server_->url(); }
  std::string host() const { return url().substr(0, url().rfind('/')); }
  std::string path() const { return url().substr(url().rfind('/')); }
  int port() const { return std::stoi(host().substr(host().rfind(':') + 1)); }
  httplib::Client client() const { return httplib::Client(host()); }
  /// What the server says of itself, once it does.
  std::string told() { return told_.get_future().get(); }

 private:
  std::promise<std::string> told_;
  std::unique_ptr<SequenceServer> server_;
  std::thread thread_;
};

class Serving : public ScratchFolder {
 protected:
  /// What a receiver gets.
  static Bytes received(const ReceiveOptions& options) {
    Bytes all;
    const Result<Reception> reception =
        tools::receiveSequence(options, [&](std::span<const uint8_t> bytes) {
          all.insert(all.end(), bytes.begin(), bytes.end());
          return Status();
        });
    EXPECT_TRUE(reception.ok()) << reception.status().message();
    return all;
  }
  static void expectFrames(const Bytes& bytes) {
    const FrameRasters truth = hills();
    Sequence sequence{bytes};
    ASSERT_EQ(sequence.status, TKS_OK);
    ASSERT_EQ(sequence.info().end_frame, kFrames);
    for (uint64_t frame = 0; frame < kFrames; ++frame)
      EXPECT_TRUE(sameBytes(sequence.heights(frame), truth[frame].data)) << frame;
  }
  const Bytes& bytes_ = encodedHills();
};

TEST_F(Serving, GivesReceiversAllAndAnybodyRanges) {
  const Running server(save("a b.tks", bytes_));
  EXPECT_EQ(server.path(), "/a_b.tks");
  expectFrames(received({.url = server.url()}));
  httplib::Client client = server.client();
  for (const auto& [range, from, size] :
       {std::tuple("bytes=0-9", 0u, 10u), {"bytes=100-", 100u, 0u}, {"bytes=-50", 0u, 50u}}) {
    const auto got = client.Get(server.path(), {{"Range", range}});
    ASSERT_TRUE(got);
    EXPECT_EQ(got->status, 206);
    const size_t begin = std::string(range) == "bytes=-50" ? bytes_.size() - 50 : from;
    const size_t end = size > 0 ? begin + size : bytes_.size();
    EXPECT_EQ(Bytes(got->body.begin(), got->body.end()),
              Bytes(bytes_.begin() + static_cast<ptrdiff_t>(begin),
                    bytes_.begin() + static_cast<ptrdiff_t>(end)));
  }
  EXPECT_EQ(client.Get(server.path(), {{"Range", "bytes=9999999-"}})->status, 416);
}

TEST_F(Serving, ThinLinksGetLessOfEveryGroup) {
  const Running server(save("a.tks", bytes_));
  const Bytes thin = received({.url = server.url(), .link = 400, .has_link = true});
  EXPECT_LT(thin.size(), bytes_.size() * 3 / 4);
  Sequence sequence{thin};
  ASSERT_EQ(sequence.status, TKS_OK);
  EXPECT_EQ(sequence.info().end_frame, kFrames);
  for (uint64_t frame = 0; frame < kFrames; ++frame) EXPECT_FALSE(sequence.heights(frame).empty());
}

TEST_F(Serving, ReceiversTellOfTheirCameraOnceTheyKnowTheGround) {
  const Running server(save("v.tks", bytes_));
  int looks = 0;
  ReceiveOptions options{.url = server.url()};
  options.look = [&](Decoder& decoder) -> Result<tks_screen_camera> {
    ++looks;
    EXPECT_EQ(decoder.info().width, 70u);
    tks_screen_camera camera = makeScreenCamera();
    camera.width = 320;
    camera.height = 240;
    camera.clip[0] = 2 / 69., camera.clip[3] = -1;  // from above, all ground
    camera.clip[5] = 2 / 59., camera.clip[7] = -1;
    camera.clip[15] = 1;
    return camera;
  };
  Bytes all;
  const Result<Reception> looked =
      tools::receiveSequence(options, [&](std::span<const uint8_t> bytes) {
        all.insert(all.end(), bytes.begin(), bytes.end());
        return Status();
      });
  ASSERT_TRUE(looked.ok()) << looked.status().message();
  expectFrames(all);
  EXPECT_EQ(looks, 1);
  constexpr uint64_t kOfView = 48;  // bytes of a matrix
  EXPECT_GE(looked->control_bytes, kOfView * (looked->messages - 1));
  options.look = [](Decoder&) -> Result<tks_screen_camera> {
    return Status(TKS_USAGE, "sees no ground");
  };
  EXPECT_EQ(tools::receiveSequence(options, {}).status().message(), "sees no ground");
}

TEST_F(Serving, LiesAndStrangersAreRefused) {
  const Running server(save("a.tks", bytes_));
  httplib::Client client = server.client();
  const auto post = [&](const std::string& body) {
    const auto answer = client.Post(server.path(), body, "application/octet-stream");
    return answer ? answer->status : 0;
  };
  EXPECT_EQ(post(""), 400);
  EXPECT_EQ(post("GET / HTTP/1.1"), 400);
  EXPECT_EQ(post(std::string(101, 'T')), 413);
  const std::vector<uint8_t> lie = writeControl({.receiver = 3, .answers = 7});
  EXPECT_EQ(post(std::string(lie.begin(), lie.end())), 409);
  EXPECT_EQ(client.Get("/../a.tks")->status, 404);
  EXPECT_EQ(client.Get(server.path(), {{"Host", "example.org"}})->status, 403);
  expectFrames(received({.url = server.url()}));
}

/// More sockets than the server has threads, which send this and read nothing.
class Stuck {
 public:
  Stuck(const Running& server, const std::string& text) {
    for (int i = 0; i < 100; ++i) {
      sockets_.push_back(socket(AF_INET, SOCK_STREAM, 0));
      sockaddr_in address = {};
      address.sin_family = AF_INET;
      address.sin_port = htons(static_cast<uint16_t>(server.port()));
      address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      const int little = 4096;
      setsockopt(sockets_.back(), SOL_SOCKET, SO_RCVBUF, &little, sizeof little);
      EXPECT_EQ(connect(sockets_.back(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
      EXPECT_EQ(send(sockets_.back(), text.data(), text.size(), MSG_NOSIGNAL),
                ssize_t(text.size()));
    }
  }
  ~Stuck() {
    for (const int socket : sockets_) close(socket);
  }
  /// A byte more of each, as far as the server still takes it.
  void drip() const {
    for (const int socket : sockets_) send(socket, "t", 1, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

 private:
  std::vector<int> sockets_;
};

/// A message that has no end.
std::string begunMessage(const Running& server) {
  return "POST " + server.path() + " HTTP/1.1\r\nHost: 127.0.0.1\r\nCon";
}

TEST_F(Serving, SlowReceiversHoldUpNobody) {
  const Running server(save("a.tks", bytes_));
  const Stuck stuck(server, begunMessage(server));
  const auto begin = std::chrono::steady_clock::now();
  expectFrames(received({.url = server.url()}));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST_F(Serving, DrippingReceiversHoldUpNobody) {
  const Running server(save("a.tks", bytes_));
  const Stuck stuck(server, begunMessage(server));
  std::atomic<bool> ends = false;
  std::thread dripping([&] {
    for (; !ends; std::this_thread::sleep_for(std::chrono::milliseconds(50))) stuck.drip();
  });
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) expectFrames(received({.url = server.url()}));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
  ends = true;
  dripping.join();
}

TEST_F(Serving, ReadersThatStopHoldUpNobody) {
  const Running server(save("a.tks", bytes_));
  std::string all;
  for (int i = 0; i < 1000; ++i)
    all += "GET " + server.path() + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  const Stuck stuck(server, all);
  const auto begin = std::chrono::steady_clock::now();
  expectFrames(received({.url = server.url()}));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST_F(Serving, BodiesWithoutEndAreRefused) {
  const Running server(save("a.tks", bytes_));
  for (const auto& [path, status] : {std::pair(server.path(), 413), {std::string("/none"), 404}}) {
    size_t sent = 0;
    httplib::Client client = server.client();
    const auto more = [&](size_t, httplib::DataSink& sink) {
      const std::string chunk(1 << 16, 'x');
      sent += chunk.size();
      return sent < (64 << 20) && sink.write(chunk.data(), chunk.size());
    };
    const auto answer = client.Post(path, more, "application/octet-stream");
    EXPECT_TRUE(!answer || answer->status == status) << path;  // no answer: the connection broke
    EXPECT_LT(sent, size_t{32} << 20) << path;
  }
  expectFrames(received({.url = server.url()}));
}

/// What a page of an origin is told: {status, Access-Control-Allow-Origin}.
std::pair<int, std::string> toldTo(const Running& server, const std::string& origin,
                                   const std::string& method) {
  httplib::Client client = server.client();
  httplib::Request request;
  request.method = method;
  request.path = server.path();
  request.headers = {{"Origin", origin}};
  const std::vector<uint8_t> control = writeControl({.receiver = 1});
  if (method == "POST") request.body.assign(control.begin(), control.end());
  const auto answer = client.send(request);
  if (!answer) return {0, ""};
  return {answer->status, answer->get_header_value("Access-Control-Allow-Origin")};
}

TEST_F(Serving, PagesComeFromThisMachineOrAreNamed) {
  const std::string file = save("a.tks", bytes_);
  const std::string named = "https://example.org";
  const Running strict(file), open(file, false, {named}), any(file, false, {"*"});
  for (const char* method : {"GET", "POST", "OPTIONS"}) {
    const int good = std::string(method) == "OPTIONS" ? 204 : 200;
    const auto allowed = [&](const std::string& origin) { return std::pair(good, origin); };
    const std::pair<int, std::string> refused(403, "");
    for (const std::string origin :
         {"http://127.0.0.1:8080", "http://localhost", "https://[::1]:1"})
      EXPECT_EQ(toldTo(strict, origin, method), allowed(origin)) << method;
    for (const std::string origin : {"https://example.org", "null", "http://127.0.0.1.example.org",
                                     "http://localhost.evil", "file://"}) {
      EXPECT_EQ(toldTo(strict, origin, method), refused) << method << " " << origin;
      EXPECT_EQ(toldTo(any, origin, method), allowed(origin)) << method << " " << origin;
      EXPECT_EQ(toldTo(open, origin, method), origin == named ? allowed(origin) : refused);
    }
  }
  for (const std::string wrong : {"", "example.org", "https://", "https://a/b", "https://a b"})
    EXPECT_EQ(SequenceServer::open({.path = file, .origins = {wrong}}).status().code(), TKS_USAGE);
}

/// What lies behind a refused message is no message.
TEST_F(Serving, NothingIsSmuggledBehindARefusal) {
  const Running server(save("a.tks", bytes_));
  httplib::Client client = server.client();
  const std::string second = "GET " + server.path() + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  client.set_keep_alive(true);
  const auto refused =
      client.Post(server.path(), {{"Origin", "https://example.org"}}, second, "text/plain");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 403);
  const auto next = client.Get("/none");
  EXPECT_TRUE(!next || next->status == 404) << next->status;  // none: the connection has ended
}

TEST_F(Serving, LiveSequencesGrowAndStayWhenTheirWriterStops) {
  const std::string file = save("live.tks", Bytes());
  Sequence whole{bytes_};
  const Running server(file, true);
  Bytes got;
  std::thread reader([&] { got = received({.url = server.url(), .live = true, .seconds = 2}); });
  std::ofstream writer(file, std::ios::binary | std::ios::app);
  for (uint64_t frame = 0; frame < kFrames; frame += 2) {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    const tks_group group = whole.group(frame);
    const uint64_t bytes = frame + 2 < kFrames ? group.bytes : group.bytes / 2;  // the disk is full
    writer.write(reinterpret_cast<const char*>(bytes_.data()) + group.offset,
                 static_cast<std::streamsize>(bytes));
    writer.flush();
  }
  reader.join();
  const FrameRasters truth = hills();
  Sequence sequence{got};
  ASSERT_EQ(sequence.status, TKS_OK);
  EXPECT_EQ(sequence.info().end_frame, kFrames);
  for (uint64_t frame = 0; frame < kFrames - 2; ++frame)
    EXPECT_TRUE(sameBytes(sequence.heights(frame), truth[frame].data)) << frame;
  EXPECT_FALSE(sequence.heights(kFrames - 1).empty());
}

TEST_F(Serving, WhatWasThereStaysWhenTheFileBreaks) {
  const std::string file = save("live.tks", bytes_);
  Running server(file, true);
  std::filesystem::resize_file(file, bytes_.size() / 2);
  EXPECT_NE(server.told().find("shorter"), std::string::npos);
  expectFrames(received({.url = server.url()}));
}

TEST_F(Serving, WhatIsNoSequenceIsRefused) {
  EXPECT_EQ(SequenceServer::open({.path = path("none.tks")}).status().code(), TKS_IO);
  EXPECT_EQ(SequenceServer::open({.path = path("")}).status().code(), TKS_IO);
  EXPECT_EQ(SequenceServer::open({.path = save("e.tks", Bytes())}).status().code(), TKS_TRUNCATED);
  EXPECT_EQ(SequenceServer::open({.path = save("t.txt", Bytes(99, 'a'))}).status().code(),
            TKS_CORRUPT);
  for (const char* url : {"", "http://", "http:///a", "http://127.0.0.1:1", "ftp://a/b"})
    EXPECT_EQ(tools::receiveSequence({.url = url}, {}).status().code(), TKS_USAGE) << url;
  EXPECT_EQ(tools::receiveSequence({.url = "http://127.0.0.1:1/a.tks"}, {}).status().code(),
            TKS_IO);
}

}  // namespace
}  // namespace tetrakis::test
