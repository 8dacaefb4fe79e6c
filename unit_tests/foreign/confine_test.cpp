// What gale-hdf5-reader can still do when it is confined, whatever a file makes it try: each line of defence on its
// own, and all together.
#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gale/io/program/confine.hpp>

namespace gale::reader {
namespace {

constexpr int succeeded = 0, failed = 1, not_confined = 2;

/// Confines a process of its own, and tries something there.
int try_confined(const std::function<bool()>& confines, const std::function<bool()>& what) {
  const pid_t child = fork();
  if (child == 0) _exit(!confines() ? not_confined : what() ? succeeded : failed);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool do_all() {
  confine();
  return true;
}

class Confine : public testing::Test {
 protected:
  Confine() : folder_(testing::TempDir() + "gale_confine_" + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
    std::ofstream(file()) << "secret";
  }
  ~Confine() override { std::filesystem::remove_all(folder_); }

  std::string file() const { return folder_ + "/secret"; }

  bool opens() const { return open(file().c_str(), O_RDONLY) >= 0; }
  bool opens_by_descriptor() const { return open("/proc/self/fd/0", O_RDONLY) >= 0; }
  bool creates() const { return open((folder_ + "/new").c_str(), O_WRONLY | O_CREAT, 0666) >= 0; }
  bool makes_folder() const { return mkdir((folder_ + "/folder").c_str(), 0777) == 0; }
  bool removes() const { return unlink(file().c_str()) == 0; }
  static bool runs() {
    char name[] = "true";
    char* const arguments[] = {name, nullptr};
    execv("/bin/true", arguments);
    return false;  // else the process is another one now, which ends with 0
  }
  static bool opens_socket() { return socket(AF_INET, SOCK_STREAM, 0) >= 0; }
  static bool forks() { return syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, nullptr) >= 0; }

  /// For a process that has nothing open but what it needs, all ways out.
  void expect_none(const std::function<bool()>& confines, const std::vector<std::function<bool()>>& ways) const {
    int number = 0;
    for (const auto& way : ways) {
      SCOPED_TRACE("way " + std::to_string(number++));
      EXPECT_EQ(try_confined([] { return true; }, way), succeeded);  // unless confined
      remake();
      EXPECT_EQ(try_confined(confines, way), failed);
      remake();
    }
    EXPECT_TRUE(std::filesystem::exists(file()));
  }

  void remake() const {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::ofstream(file()) << "secret";
  }

 private:
  std::string folder_;
};

TEST_F(Confine, AllTogetherLeaveNoWayOut) {
  expect_none(do_all, {[&] { return opens(); }, [&] { return opens_by_descriptor(); }, [&] { return creates(); },
                       [&] { return makes_folder(); }, [&] { return removes(); }, runs, opens_socket, forks});
}

TEST_F(Confine, FilterAloneLeavesNoWayOut) {
  if (try_confined(confine_by_filter, [] { return true; }) == not_confined) GTEST_SKIP() << "the kernel has no filters";
  expect_none(confine_by_filter,
              {[&] { return opens(); }, [&] { return opens_by_descriptor(); }, [&] { return creates(); },
               [&] { return makes_folder(); }, [&] { return removes(); }, runs, opens_socket, forks});
}

TEST_F(Confine, LandlockAloneLeavesNoPath) {
  if (try_confined(confine_by_landlock, [] { return true; }) == not_confined)
    GTEST_SKIP() << "the kernel has no Landlock";
  expect_none(confine_by_landlock, {[&] { return opens(); }, [&] { return creates(); }, [&] { return makes_folder(); },
                                    [&] { return removes(); }, runs});
}

TEST_F(Confine, LimitsAloneLeaveNoNewDescriptor) {
  expect_none(confine_by_limits, {[&] { return opens(); }, [&] { return opens_by_descriptor(); },
                                  [&] { return creates(); }, opens_socket});
}

TEST_F(Confine, WhatIsOpenIsReadAndMemoryIsThere) {
  const int open_before = open(file().c_str(), O_RDONLY);
  const auto works = [&] {
    char text[7] = {};
    void* const memory = std::malloc(1 << 24);
    return read(open_before, text, 6) == 6 && std::string(text) == "secret" && memory != nullptr;
  };
  EXPECT_EQ(try_confined(do_all, works), succeeded);
  close(open_before);
}

}  // namespace
}  // namespace gale::reader
