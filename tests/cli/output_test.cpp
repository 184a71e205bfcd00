// SPDX-License-Identifier: Apache-2.0
// Output: staged, committed, or gone.
#include "apps/tools/output/output.hpp"

#include "apps/tools/files/temporary.hpp"
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

using tools::Output;
using tools::OutputFolder;

class OutputTest : public CliTest {
 protected:
  static std::span<const std::byte> bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
  }
};

TEST_F(OutputTest, AppearsOnlyAtCommit) {
  auto output = Output::plan(path("a"), false, "");
  ASSERT_TRUE(output.ok());
  ASSERT_TRUE(output->stage(bytes("text")).ok());
  EXPECT_FALSE(names().contains("a"));
  ASSERT_TRUE(output->commit().ok());
  EXPECT_EQ(content("a"), "text");
}

TEST_F(OutputTest, FoldersAreReplacedOrKept) {
  std::filesystem::create_directory(path("tiles"));
  write("tiles/old", "old");
  const auto replace = [this] {
    return tools::replaceFolder(path("made"), path("tiles"), path("aside"));
  };
  EXPECT_EQ(replace().code(), TKS_IO);  // there is nothing to put there
  EXPECT_EQ(content("tiles/old"), "old");
  EXPECT_FALSE(names().contains("aside"));
  std::filesystem::create_directory(path("made"));
  write("made/new", "new");
  EXPECT_TRUE(replace().ok());
  EXPECT_EQ(content("tiles/new"), "new");
  EXPECT_EQ(content("aside/old"), "old");
}

TEST_F(OutputTest, LeavesNothingWithoutCommit) {
  {
    auto output = Output::plan(path("a"), false, "");
    ASSERT_TRUE(output.ok());
    ASSERT_TRUE(output->stage(bytes("text")).ok());
    const Output moved = std::move(*output);
    EXPECT_EQ(names().size(), 1u);
  }
  EXPECT_EQ(names().size(), 0u);
}

TEST_F(OutputTest, FileThatAppearsMeanwhileIsKept) {
  auto output = Output::plan(path("a"), false, "");
  ASSERT_TRUE(output.ok());
  ASSERT_TRUE(output->stage(bytes("new")).ok());
  write("a", "meanwhile");
  EXPECT_EQ(output->commit().code(), TKS_IO);
  EXPECT_EQ(content("a"), "meanwhile");
}

TEST_F(OutputTest, SideFilesAreHeldToTheSameRule) {
  write("side", "old");
  const auto writeBoth = [](const std::string& main) {
    const auto side = std::filesystem::path(main).parent_path() / "side";
    if (Status status = tools::writeBytes(side, bytes("new")); !status.ok()) return status;
    return tools::writeBytes(main, bytes("new"));
  };
  for (const bool force : {false, true}) {
    auto output = Output::plan(path("main"), force, "");
    ASSERT_TRUE(output.ok());
    ASSERT_TRUE(output->stage(writeBoth).ok());
    EXPECT_EQ(output->commit().ok(), force);
    EXPECT_EQ(content("side"), force ? "new" : "old");
    EXPECT_EQ(names().contains("main"), force);
  }
}

TEST_F(OutputTest, MessagesNameTheFinalFile) {
  auto output = Output::plan(path("a"), false, "");
  ASSERT_TRUE(output.ok());
  const Status status = output->stage(
      [](const std::string& staged) { return Status(TKS_USAGE, "no way to write " + staged); });
  EXPECT_EQ(status.code(), TKS_USAGE);
  EXPECT_EQ(status.message(), "no way to write " + path("a"));
}

TEST_F(OutputTest, EmptyFolderOfOursDisappearsAndOthersStay) {
  std::filesystem::create_directory(path("theirs"));
  { ASSERT_TRUE(OutputFolder::create(path("theirs")).ok()); }
  { ASSERT_TRUE(OutputFolder::create(path("ours")).ok()); }
  EXPECT_EQ(names(), std::set<std::string>{"theirs"});
}

}  // namespace
}  // namespace tetrakis::test
