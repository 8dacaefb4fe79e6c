#include <gtest/gtest.h>

#include <gale/io/atomic_file.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::content_of;
using test::error_of;
using test::Folder;
using Names = std::set<std::string>;

TEST(AtomicFile, AppearsWhenItIsCommitted) {
  const Folder folder;
  AtomicFile file(folder / "result");
  std::ofstream(file.temporary()) << "new";
  EXPECT_EQ(folder.names().count("result"), 0u);
  file.commit();
  EXPECT_EQ(folder.names(), Names{"result"});
  EXPECT_EQ(content_of(folder / "result"), "new");
}

TEST(AtomicFile, ReplacesWhatWasThere) {
  const Folder folder;
  folder.put("result", "old");
  AtomicFile file(folder / "result");
  std::ofstream(file.temporary()) << "new";
  EXPECT_EQ(content_of(folder / "result"), "old");
  file.commit();
  EXPECT_EQ(content_of(folder / "result"), "new");
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const Folder folder;
  folder.put("result", "old");
  {
    AtomicFile file(folder / "result");
    std::ofstream(file.temporary()) << "half";
  }
  EXPECT_EQ(folder.names(), Names{"result"});
  EXPECT_EQ(content_of(folder / "result"), "old");
}

TEST(AtomicFile, FollowsALink) {
  const Folder folder;
  folder.put("target", "old");
  std::filesystem::create_symlink(folder / "target", folder / "link");
  AtomicFile file(folder / "link");
  std::ofstream(file.temporary()) << "new";
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(content_of(folder / "target"), "new");
}

TEST(AtomicFile, FollowsALinkToAFileThatIsNotThere) {
  const Folder folder;
  std::filesystem::create_symlink("target", folder / "link");
  AtomicFile file(folder / "link");
  std::ofstream(file.temporary()) << "new";
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(content_of(folder / "target"), "new");
}

TEST(AtomicFile, TakesANameInTheWorkingDirectory) {
  const Folder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / ".");
  {
    AtomicFile file("result");
    file.commit();
  }
  std::filesystem::current_path(before);
  EXPECT_EQ(folder.names(), Names{"result"});
}

TEST(AtomicFile, RefusesWhatIsNoFile) {
  const Folder folder;
  folder.put("file", "");
  EXPECT_EQ(error_of([&] { AtomicFile(folder / "."); }), "it is a directory");
  EXPECT_EQ(error_of([&] { AtomicFile("/dev/null"); }), "it is not a regular file");
  EXPECT_EQ(error_of([&] { AtomicFile(folder / "none/result"); }), "No such file or directory");
  EXPECT_EQ(error_of([&] { AtomicFile(folder / "file/result"); }), "Not a directory");
  EXPECT_EQ(folder.names(), Names{"file"});
  std::filesystem::create_symlink("loop", folder / "loop");
  EXPECT_EQ(error_of([&] { AtomicFile(folder / "loop"); }), "Too many levels of symbolic links");
}

}  // namespace
}  // namespace gale::io
