// SPDX-License-Identifier: Apache-2.0
// A folder of its own for each test that writes files, removed afterwards.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tetrakis::test {

class ScratchFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "tetrakis-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  template <class T>
  std::string save(const std::string& name, const std::vector<T>& bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size() * sizeof(T)));
    EXPECT_TRUE(file.good());
    return path(name);
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace tetrakis::test
