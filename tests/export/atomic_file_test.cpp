// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/input_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/export/sample_scene.h"

namespace trueflank::io {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

std::string content_of(const fs::path& path) { return read_file(path).value(); }

TEST(AtomicFile, WritesWhatItWasGiven) {
  const ScratchFolder folder;
  std::string content(3'000'000, 'x');
  for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 7 % 251);
  auto file = AtomicFile::create(folder / "a");
  ASSERT_TRUE(file);
  for (std::size_t at = 0; at < content.size(); at += 777'777)
    file->write(std::string_view(content).substr(at, 777'777));
  EXPECT_EQ(file->size(), content.size());
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content_of(folder / "a"), content);
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit) {
  const ScratchFolder folder;
  {
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file);
    file->write(std::string(2'000'000, 'x'));
    EXPECT_FALSE(fs::exists(folder / "a"));
    EXPECT_EQ(folder.entries(), 1U);
  }
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(AtomicFile, WhatAKilledProcessLeftIsRemovedByTheNextRun) {
  const ScratchFolder folder;
  int begun[2];
  ASSERT_EQ(pipe(begun), 0);
  const pid_t child = fork();
  if (child == 0) {
    auto file = AtomicFile::create(folder / "a");
    file->write(std::string(2'000'000, 'x'));
    [[maybe_unused]] const ssize_t told = ::write(begun[1], "x", 1);
    pause();
    _exit(0);
  }
  char told = 0;
  ASSERT_EQ(::read(begun[0], &told, 1), 1);
  ASSERT_TRUE(create_folder(folder.path()));
  EXPECT_EQ(folder.entries(), 1U) << "its process still runs";
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(folder.entries(), 1U);
  ASSERT_TRUE(create_folder(folder.path()));
  EXPECT_EQ(folder.entries(), 0U);
  ::close(begun[0]), ::close(begun[1]);
}

TEST(AtomicFile, OtherFilesAndThoseThatSomebodyHoldsAreNotLeftOver) {
  const ScratchFolder folder;
  const pid_t ended = fork();
  if (ended == 0) _exit(0);
  waitpid(ended, nullptr, 0);
  const std::string dead = std::to_string(ended);
  for (const std::string& name : std::vector<std::string>{
           ".trueflank-" + dead + "-0.txt", ".trueflank-" + dead + ".tmp",
           ".trueflank-" + dead + "-0x.tmp", "trueflank-" + dead + "-0.tmp", ".trueflank--5-0.tmp",
           ".trueflank-99999999999-0.tmp", ".trueflank-" + std::to_string(getpid()) + "-77.tmp"})
    std::ofstream(folder / name) << name;
  fs::create_directory(folder / (".trueflank-" + dead + "-1.tmp"));
  fs::create_symlink("/dev/null", folder / (".trueflank-" + dead + "-2.tmp"));
  // of a process in another container, which is not seen here but holds its lock
  const fs::path held = folder / (".trueflank-" + dead + "-3.tmp");
  const int descriptor = ::open(held.c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  ASSERT_TRUE(create_folder(folder.path()));
  EXPECT_EQ(folder.entries(), 10U);
  ::close(descriptor);
  ASSERT_TRUE(create_folder(folder.path()));
  EXPECT_EQ(folder.entries(), 9U);
  EXPECT_FALSE(fs::exists(held));
}

TEST(AtomicFile, KeepsTheOldContentUntilTheNewIsWhole) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "a", "old"));
  auto file = AtomicFile::create(folder / "a");
  ASSERT_TRUE(file);
  file->write(std::string(2'000'000, 'x'));
  EXPECT_EQ(content_of(folder / "a"), "old");
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content_of(folder / "a").size(), 2'000'000U);
}

TEST(AtomicFile, KeepsThePermissionsOfAFileItReplaces) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "a", "old"));
  fs::permissions(folder / "a", fs::perms::owner_all | fs::perms::group_read);
  ASSERT_TRUE(write_file(folder / "a", "new"));
  EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms::owner_all | fs::perms::group_read);
}

TEST(AtomicFile, FollowsSymbolicLinksAlsoToWhatIsNotThereYet) {
  const ScratchFolder folder;
  fs::create_directory(folder / "inner");
  fs::create_symlink("inner/target", folder / "link");
  fs::create_symlink("link", folder / "second");
  ASSERT_TRUE(write_file(folder / "second", "one"));
  EXPECT_TRUE(fs::is_symlink(folder / "second"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content_of(folder / "inner/target"), "one");
  ASSERT_TRUE(write_file(folder / "link", "two"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content_of(folder / "inner/target"), "two");
}

TEST(AtomicFile, ReportsALoopOfLinks) {
  const ScratchFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  const auto status = write_file(folder / "a", "x");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kDisk);
}

TEST(AtomicFile, ReportsAFullDiskAndDoesNotReplaceTheDevice) {
  const auto status = write_file("/dev/full", "x");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kDisk);
  EXPECT_NE(status.error().message.find("No space left on device"), std::string::npos);
  EXPECT_NE(status.error().message.find("/dev/full"), std::string::npos);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, WritesToADeviceAndToAPipe) {
  EXPECT_TRUE(write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const ScratchFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const int reader = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_TRUE(write_file(folder / "pipe", "through"));
  char text[16] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 7);
  EXPECT_STREQ(text, "through");
  ::close(reader);
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

// /dev/stdout may lead to a regular file: its descriptor is written to, behind what stands there.
TEST(AtomicFile, AppendsToAnOpenDescriptorInsteadOfReplacingItsFile) {
  const ScratchFolder folder;
  const int open_file = ::open((folder / "log").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_EQ(::write(open_file, "first ", 6), 6);
  ASSERT_TRUE(write_file("/dev/fd/" + std::to_string(open_file), "second"));
  ASSERT_TRUE(write_file("/proc/self/fd/" + std::to_string(open_file), " third"));
  struct stat by_name {}, by_descriptor {};
  ::stat((folder / "log").c_str(), &by_name);
  ::fstat(open_file, &by_descriptor);
  EXPECT_EQ(by_name.st_ino, by_descriptor.st_ino);
  ::close(open_file);
  EXPECT_EQ(content_of(folder / "log"), "first second third");
}

TEST(AtomicFile, NamesAMissingFolder) {
  const ScratchFolder folder;
  const auto status = write_file(folder / "none" / "a.stl", "x");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kFileNotFound);
  EXPECT_NE(status.error().message.find("none/a.stl"), std::string::npos);
  EXPECT_EQ(status.error().file, (folder / "none" / "a.stl").string());
}

TEST(AtomicFile, RefusesAFileInThePlaceOfAFolder) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "file", "x"));
  EXPECT_EQ(write_file(folder / "file" / "a", "x").error().code, ErrorCode::kFileNotFound);
  EXPECT_FALSE(create_folder(folder / "file"));
  EXPECT_FALSE(create_folder(folder / "file" / "deeper"));
}

TEST(AtomicFile, RefusesAFolderInThePlaceOfAFile) {
  const ScratchFolder folder;
  fs::create_directory(folder / "folder");
  EXPECT_EQ(write_file(folder / "folder", "x").error().code, ErrorCode::kDisk);
  EXPECT_EQ(write_file(folder.path() / "folder" / "", "x").error().code, ErrorCode::kDisk);
  EXPECT_FALSE(write_file("", "x"));
}

TEST(AtomicFile, ReportsMissingPermissions) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "a", "old"));
  fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::others_read);
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec |
                                         fs::perms::others_read | fs::perms::others_exec);
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) ::_exit(9);  // root is refused nothing
    const auto over_file = write_file(folder / "a", "new");
    const auto in_folder = write_file(folder / "locked" / "b", "new");
    if (over_file || over_file.error().code != ErrorCode::kPermission) ::_exit(1);
    if (in_folder || in_folder.error().code != ErrorCode::kPermission) ::_exit(2);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(content_of(folder / "a"), "old");
  fs::permissions(folder / "locked", fs::perms::owner_all);
}

// A limit on the size of files stands in for a disk that fills up in the middle.
TEST(AtomicFile, RemovesWhatDidNotFit) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "a", "old"));
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{1'000'000, before.rlim_max};
  ::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const auto status = write_file(folder / "a", std::string(3'000'000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kDisk);
  EXPECT_EQ(status.error().value, "1000000 bytes");
  EXPECT_NE(status.error().message.find((folder / "a").string()), std::string::npos);
  EXPECT_NE(status.error().message.find("beyond 1000000 bytes"), std::string::npos)
      << status.error().message;
  EXPECT_NE(status.error().remedy.find("ulimit -f"), std::string::npos) << status.error().remedy;
  EXPECT_EQ(content_of(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(AtomicFile, SaysWhichLimitOfOpenFilesStopsItAndWhatHelps) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "a", "old"));
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  const int next = ::open("/dev/null", O_RDONLY);
  ::close(next);
  const rlimit limit{static_cast<rlim_t>(next), before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &limit);
  const auto written = write_file(folder / "a", "new");
  const auto read = read_file(folder / "a");
  ::setrlimit(RLIMIT_NOFILE, &before);
  ASSERT_FALSE(written);
  ASSERT_FALSE(read);
  for (const Error& error : {written.error(), read.error()}) {
    EXPECT_EQ(error.code, ErrorCode::kDisk);
    EXPECT_EQ(error.value, std::to_string(next) + " open files");
    EXPECT_NE(error.message.find((folder / "a").string()), std::string::npos);
    EXPECT_NE(error.message.find("may have " + std::to_string(next) + " open"), std::string::npos)
        << error.message;
    EXPECT_NE(error.remedy.find("ulimit -n"), std::string::npos) << error.remedy;
  }
  EXPECT_EQ(content_of(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1U);
}

// A machine of many processors writes a file on each.
TEST(AtomicFile, HundredsAreWrittenAtOnce) {
  const ScratchFolder folder;
  std::vector<AtomicFile> files;
  for (int i = 0; i < 200; ++i) {
    auto file = AtomicFile::create(folder / std::to_string(i));
    ASSERT_TRUE(file) << i << " " << file.error().message;
    files.push_back(std::move(*file));
  }
  for (AtomicFile& file : files) ASSERT_TRUE(file.commit());
  EXPECT_EQ(folder.entries(), 200U);
}

TEST(AtomicFile, IsRemovedByASignalHandlerInTheMiddle) {
  const ScratchFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGTERM, [](int) {
      remove_temporary_files();
      ::_exit(3);
    });
    auto first = AtomicFile::create(folder / "a");
    auto second = AtomicFile::create(folder / "b");
    first->write(std::string(2'000'000, 'x'));
    ::raise(SIGTERM);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_EQ(folder.entries(), 0U);
}

// A thread that outlives the handler for a moment must not bring a file into being.
TEST(AtomicFile, IsNeitherBegunNorCommittedAfterAnInterruption) {
  const ScratchFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    auto begun = AtomicFile::create(folder / "a");
    begun->write("x");
    remove_temporary_files();
    const bool committed = begun->commit().has_value();
    const auto late = write_file(folder / "b", "x");
    ::_exit(!committed && !late && late.error().code == ErrorCode::kInterrupted ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(folder.entries(), 0U);
}

}  // namespace
}  // namespace trueflank::io
