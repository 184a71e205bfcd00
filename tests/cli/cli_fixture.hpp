// SPDX-License-Identifier: Apache-2.0
// Runs the command line in an empty folder of its own.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/same_bytes.hpp"

#include "apps/tools/commands/command_line.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"

namespace tetrakis::test {

/// What a process left: exit code, standard output, standard error.
struct Outcome {
  int code = -1;
  std::string out, err;
};

/// Points a standard stream at a file while alive.
class Redirection {
 public:
  Redirection(std::FILE* stream, const char* path, int flags)
      : stream_(stream), saved_(dup(fileno(stream))) {
    const int file = open(path, flags, 0600);
    EXPECT_GE(file, 0) << path;
    std::fflush(stream_);
    dup2(file, fileno(stream_));
    close(file);
  }
  ~Redirection() {
    std::fflush(stream_);
    std::clearerr(stream_);
    dup2(saved_, fileno(stream_));
    close(saved_);
  }

 private:
  std::FILE* stream_;
  int saved_;
};

class CliTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "tetrakis-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    root_ = name;
    std::filesystem::create_directory(root_ / "work");
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  /// Runs "tetrakis <arguments>" (split at spaces) in the folder, inside this process: starting one
  /// loads some hundred libraries. `input` names the file that is standard input.
  Outcome cli(const std::string& arguments, const std::string& input = "/dev/null") {
    std::vector<std::string> words;
    std::istringstream split(arguments);
    for (std::string word; split >> word;) words.push_back(word);
    return cliOf(words, input);
  }

  /// The same for arguments that hold spaces.
  Outcome cliOf(const std::vector<std::string>& words, const std::string& input = "/dev/null") {
    std::vector<const char*> argv{"tetrakis"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    const auto home = std::filesystem::current_path();
    std::filesystem::current_path(folder());
    Outcome outcome;
    {
      const Redirection in(stdin, input.c_str(), O_RDONLY);
      const Redirection out(stdout, (root_ / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC);
      const Redirection err(stderr, (root_ / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC);
      outcome.code = tools::runCommandLine(static_cast<int>(argv.size()), argv.data());
    }
    std::filesystem::current_path(home);
    outcome.out = text((root_ / "out").string());
    outcome.err = text((root_ / "err").string());
    return outcome;
  }

  /// Runs a shell command in the folder; "$TETRAKIS" is the program. Its standard output comes
  /// back.
  Outcome shell(const std::string& command) {
    const std::string out = (root_ / "out").string(), err = (root_ / "err").string();
    const std::string line = "cd '" + folder().string() +
                             "' && export TETRAKIS='" TETRAKIS_CLI "' && { " + command + "; } >'" +
                             out + "' 2>'" + err + "' </dev/null";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
  }

  std::filesystem::path folder() const { return root_ / "work"; }
  std::string path(const std::string& name) const { return (folder() / name).string(); }

  static std::string text(const std::string& path) {
    const auto bytes = tools::readBytes(path);
    if (!bytes.ok()) return "";
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
  }
  std::string content(const std::string& name) const { return text(path(name)); }

  void write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(tools::writeBytes(path(name), std::as_bytes(std::span(text))).ok());
  }

  /// Names in the folder, hidden ones too.
  std::set<std::string> names() const {
    std::set<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
      result.insert(entry.path().filename().string());
    return result;
  }

  /// size x size u16 decimetres with relief, unit m.
  static tools::HeightFile hills(uint32_t size) {
    tools::HeightFile file;
    file.width = file.height = size;
    file.sample = TKS_U16;
    file.scale = 0.1;
    file.spacing_x = file.spacing_y = 30;
    file.unit = "m";
    for (uint32_t i = 0; i < size * size; ++i) {
      const double x = i % size, y = i / size;
      appendSample(file, static_cast<uint16_t>(4000 + 900 * std::sin(x / 4) * std::cos(y / 5) + x));
    }
    return file;
  }

  static void appendSample(tools::HeightFile& file, uint16_t sample) {
    const auto bytes = std::as_bytes(std::span(&sample, 1));
    file.data.insert(file.data.end(), bytes.begin(), bytes.end());
  }

  static tools::ImageFile photo(uint32_t size) {
    tools::ImageFile file{size, size, 3, TKS_U8, {}};
    for (uint32_t i = 0; i < 3 * size * size; ++i)
      file.data.push_back(std::byte(static_cast<uint8_t>((i * i / 7 + i / size * 5) % 251)));
    return file;
  }

  /// Writes height.tif and texture.png.
  void makeInputs(uint32_t size = 17) {
    ASSERT_TRUE(tools::writeHeights(path("height.tif"), hills(size)).ok());
    ASSERT_TRUE(tools::writeImage(path("texture.png"), photo(2 * size)).ok());
  }

  /// Also a lossless a.tks of both; the tests of one process encode it once.
  void makeStream(uint32_t size = 17) {
    static std::map<uint32_t, std::string> streams;
    makeInputs(size);
    if (!streams.contains(size)) {
      const Outcome run = cli("encode height.tif --texture texture.png --lossless -o a.tks");
      ASSERT_EQ(run.code, 0) << run.err;
      streams[size] = content("a.tks");
    } else {
      write("a.tks", streams[size]);
    }
  }

 private:
  std::filesystem::path root_;
};

}  // namespace tetrakis::test
