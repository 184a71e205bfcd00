// SPDX-License-Identifier: Apache-2.0
// Signals: a command that one ends leaves the folder as it was, and ends as the signal ends others.
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

class CliSignals : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    std::filesystem::create_directory(path("tmp"));
  }

  /// Starts "tetrakis <arguments>" in the folder, with its temporary files in tmp/.
  pid_t start(const std::vector<std::string>& arguments) {
    const pid_t child = fork();
    if (child != 0) return child;
    std::filesystem::current_path(folder());
    setenv("TMPDIR", path("tmp").c_str(), 1);
    dup2(open("/dev/null", O_RDWR), STDERR_FILENO);
    std::vector<char*> argv{const_cast<char*>("tetrakis")};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(TETRAKIS_CLI, argv.data());
    _exit(127);
  }

  static bool within(milliseconds limit, const std::function<bool()>& condition) {
    for (const auto end = steady_clock::now() + limit; steady_clock::now() < end;
         std::this_thread::sleep_for(milliseconds(1)))
      if (condition()) return true;
    return condition();
  }

  /// The status of the child, which gets half a minute to end.
  static int waitFor(pid_t child) {
    int status = 0;
    const auto ended = [&] { return waitpid(child, &status, WNOHANG) == child; };
    if (within(milliseconds(30000), ended)) return status;
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    ADD_FAILURE() << "the process did not end";
    return status;
  }

  std::set<std::string> everything() const {
    std::set<std::string> result;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder()))
      result.insert(entry.path().string());
    return result;
  }

  bool hasHidden(const std::string& where) const {
    for (const auto& entry : std::filesystem::directory_iterator(where))
      if (entry.path().filename().string().starts_with(".tetrakis-")) return true;
    return false;
  }

  /// Sends the signal as soon as `begun` holds.
  void expectCleanEnd(const std::vector<std::string>& arguments, int signal,
                      const std::function<bool()>& begun) {
    const std::set<std::string> before = everything();
    const pid_t child = start(arguments);
    ASSERT_GT(child, 0);
    EXPECT_TRUE(within(milliseconds(30000), begun));
    kill(child, signal);
    const int status = waitFor(child);
    EXPECT_EQ(WIFSIGNALED(status) ? WTERMSIG(status) : 0, signal) << status;
    EXPECT_EQ(everything(), before);
  }
};

TEST_F(CliSignals, LongEncodingsLeaveNoFolders) {
  makeInputs(1025);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    expectCleanEnd({"encode", "height.tif", "--lossless", "-o", "a.tks", "--report", "deep/report"},
                   signal, [this] { return std::filesystem::exists(path("deep/report")); });
  }
}

/// A pipe that nobody reads: all is staged, beside its place and in tmp/, and nothing in place.
TEST_F(CliSignals, StagedFilesAreRemoved) {
  makeStream();
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    expectCleanEnd({"decode", "a.tks", "--height", "h.tif", "--texture", "pipe"}, signal,
                   [this] { return hasHidden(folder()) && hasHidden(path("tmp")); });
  }
}

TEST_F(CliSignals, BrokenPipesAreErrorsThatLeaveNothing) {
  makeStream(129);
  const std::set<std::string> before = everything();
  const Outcome run = shell(
      "export TMPDIR=$PWD/tmp; { \"$TETRAKIS\" decode a.tks --height h.tif --texture -; "
      "echo $? >&2; } | true");
  EXPECT_NE(run.err.find("\n2\n"), std::string::npos) << run.err;
  EXPECT_EQ(everything(), before);
}

TEST_F(CliSignals, IgnoredSignalsStayIgnored) {
  makeInputs();
  ASSERT_EQ(mkfifo(path("slow").c_str(), 0600), 0);
  const Outcome run = shell(
      "trap '' INT; \"$TETRAKIS\" encode - --lossless -o a.tks < slow & exec 3> slow; "
      "sleep 0.3; kill -INT $!; cat height.tif >&3; exec 3>&-; wait $!");
  EXPECT_EQ(run.code, 0) << run.err;
}

}  // namespace
}  // namespace tetrakis::test
