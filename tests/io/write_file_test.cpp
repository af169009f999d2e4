// The old content or the new one, never half, and nothing left behind.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "places.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

namespace fs = std::filesystem;

size_t count_files(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

mode_t mode_of(const fs::path& path) {
  struct stat status;
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

TEST(WriteFile, CreatesAndReplaces) {
  const TempFolder folder;
  write_file(folder / "a.txt", "one");
  EXPECT_EQ(read_text(folder / "a.txt"), "one");
  write_file(folder / "a.txt", std::string("two\0\n", 5));
  EXPECT_EQ(read_text(folder / "a.txt"), std::string("two\0\n", 5));
  EXPECT_EQ(count_files(folder.path()), 1u);
}

TEST(WriteFile, WritesToTheCurrentFolder) {
  const TempFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_file("a.txt", "here");
  fs::current_path(before);
  EXPECT_EQ(read_text(folder / "a.txt"), "here");
}

TEST(WriteFile, KeepsPermissionsAndElseFollowsTheUmask) {
  const TempFolder folder;
  const mode_t before = ::umask(027);
  write_file(folder / "new", "");
  ::umask(before);
  EXPECT_EQ(mode_of(folder / "new"), 0640u);
  ::chmod((folder / "new").c_str(), 0604);
  write_file(folder / "new", "again");
  EXPECT_EQ(mode_of(folder / "new"), 0604u);
}

TEST(WriteFile, ReplacesRatherThanRewrites) {
  const TempFolder folder;
  write_file(folder / "a", "old");
  fs::create_hard_link(folder / "a", folder / "other");
  write_file(folder / "a", "new");
  EXPECT_EQ(read_text(folder / "other"), "old");
}

TEST(WriteFile, WritesThroughSymbolicLinks) {
  const TempFolder folder;
  fs::create_directory(folder / "deep");
  fs::create_symlink("deep/real", folder / "link");
  fs::create_symlink(folder / "link", folder / "far");
  write_file(folder / "far", "content");
  EXPECT_TRUE(fs::is_symlink(folder / "far"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_text(folder / "deep" / "real"), "content");
}

TEST(WriteFile, WritesIntoDevicesAndPipes) {
  const TempFolder folder;
  EXPECT_NO_THROW(write_file("/dev/null", "content"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_text(folder / "pipe"); });
  write_file(folder / "pipe", "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(WriteFile, FailsInWordsAndLeavesNothing) {
  const TempFolder folder;
  fs::create_directory(folder / "folder");
  fs::create_symlink("loop", folder / "loop");
  write_file(folder / "file", "kept");
  const size_t before = count_files(folder.path());
  EXPECT_THROW(write_file(folder / "folder", "x"), UnwritableFile);
  EXPECT_THROW(write_file(folder / "missing" / "file", "x"), UnwritableFile);
  EXPECT_THROW(write_file(folder / "file" / "below", "x"), UnwritableFile);
  EXPECT_THROW(write_file(folder / "loop", "x"), UnwritableFile);
  EXPECT_THROW(write_file(folder / std::string(300, 'n'), "x"), UnwritableFile);
  EXPECT_THROW(write_file("/dev/full", "x"), UnwritableFile);
  EXPECT_EQ(count_files(folder.path()), before);
  EXPECT_EQ(read_text(folder / "file"), "kept");
}

TEST(WriteFile, LeavesReadOnlyFilesAlone) {
  if (::geteuid() == 0) GTEST_SKIP() << "nothing is read-only for root";
  const TempFolder folder;
  write_file(folder / "file", "kept");
  ::chmod((folder / "file").c_str(), 0444);
  EXPECT_THROW(write_file(folder / "file", "x"), UnwritableFile);
  EXPECT_EQ(read_text(folder / "file"), "kept");
}

}  // namespace
}  // namespace swage::test
