// SPDX-License-Identifier: Apache-2.0
#include "bench/peers/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

namespace tetrakis::bench {
namespace {

std::string lastLineOf(const std::string& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string text; std::getline(file, text);) {
    if (!text.empty()) last = text;
  }
  return last;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "tetrakis-bench-XXXXXX").string();
  if (mkdtemp(name.data()) != nullptr) path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (made()) std::filesystem::remove_all(path_, ignored);
}

Status runProgram(std::vector<std::string> words, const std::string& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {TKS_UNSUPPORTED, words[0] + " does not start: " + std::strerror(error)};
  int state = 0;
  if (waitpid(child, &state, 0) != child || !WIFEXITED(state) || WEXITSTATUS(state) != 0) {
    return {TKS_MISMATCH, words[0] + " failed: " + lastLineOf(log)};
  }
  return {};
}

}  // namespace tetrakis::bench
