#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <gtest/gtest.h>

#include <gale/io/atomic_file.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::content_of;
using test::error_of;
using test::Folder;
using Names = std::set<std::string>;

void add(AtomicFiles& files, const std::string& path, const std::string& content) {
  std::ofstream(files.add(path).temporary()) << content;
}

TEST(AtomicFiles, AppearTogether) {
  const Folder folder;
  folder.put("b", "old");
  AtomicFiles files;
  add(files, folder / "a", "1");
  add(files, folder / "b", "2");
  EXPECT_EQ(folder.names().count("a"), 0u);
  EXPECT_EQ(content_of(folder / "b"), "old");
  files.commit();
  EXPECT_EQ(folder.names(), (Names{"a", "b"}));
  EXPECT_EQ(content_of(folder / "a") + content_of(folder / "b"), "12");
}

TEST(AtomicFiles, LeaveNothingWithoutCommit) {
  const Folder folder;
  {
    AtomicFiles files;
    add(files, folder / "a", "1");
    add(files, folder / "b", "2");
  }
  EXPECT_EQ(folder.names(), Names{});
}

/// The last can't have its name: a folder took it meanwhile.
TEST(AtomicFiles, AppearTogetherOrNotAtAll) {
  const Folder folder;
  folder.put("b", "old");
  {
    AtomicFiles files;
    add(files, folder / "a", "1");
    add(files, folder / "b", "2");
    add(files, folder / "c", "3");
    std::filesystem::create_directory(folder / "c");
    EXPECT_EQ(error_of([&] { files.commit(); }), "cannot write '" + folder / "c" + "': Is a directory");
  }
  EXPECT_EQ(folder.names(), (Names{"b", "c"}));
  EXPECT_EQ(content_of(folder / "b"), "old");
}

/// Fails what comes after them: all have their names then, and lose them.
TEST(AtomicFiles, LoseTheirNamesWhereThatIsNotConfirmed) {
  const Folder folder;
  folder.put("b", "old");
  {
    AtomicFiles files;
    add(files, folder / "a", "1");
    add(files, folder / "b", "2");
    const auto refuse = [&] {
      EXPECT_EQ(content_of(folder / "a") + content_of(folder / "b"), "12");
      throw Error("no");
    };
    EXPECT_EQ(error_of([&] { files.commit(refuse); }), "no");
  }
  EXPECT_EQ(folder.names(), Names{"b"});
  EXPECT_EQ(content_of(folder / "b"), "old");
}

TEST(AtomicFiles, NameTheOneThatCannotBe) {
  AtomicFiles files;
  EXPECT_EQ(error_of([&] { files.add("/nowhere/a"); }), "cannot write '/nowhere/a': No such file or directory");
}

TEST(AtomicFile, OfALongNameHasATemporary) {
  const Folder folder;
  const std::string name(255, 'a');
  AtomicFile(folder / name).commit();
  EXPECT_EQ(folder.names(), Names{name});
}

/// The status that a child process which calls `run` ends with.
int status_of_child(const std::function<void()>& run) {
  const pid_t child = fork();
  if (child == 0) {
    run();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(TemporaryFiles, GoWithAProcessThatASignalEnds) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGABRT}) {
    const Folder folder;
    const int status = status_of_child([&] {
      std::signal(signal, SIG_DFL);  // shells start some of what they run with signals ignored
      remove_temporary_files_at_end();
      AtomicFiles files;
      for (int i = 0; i < 100; ++i) add(files, folder / std::to_string(i), "half");
      raise(signal);
    });
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(folder.names(), Names{});
  }
}

/// Many files may be open at once: no more have no name than descriptors allow.
TEST(TemporaryFiles, HaveHiddenNamesWhereDescriptorsAreShort) {
  const Folder folder;
  const int status = status_of_child([&] {
    const int next = dup(0);  // a device has many open
    close(next);
    const rlim_t most = static_cast<rlim_t>(next) + 5;
    const rlimit few{most, most};
    setrlimit(RLIMIT_NOFILE, &few);
    AtomicFiles files;
    for (int i = 0; i < 20; ++i) add(files, folder / std::to_string(i), std::to_string(i));
    files.commit();
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(folder.names().size(), 20u);
  EXPECT_EQ(content_of(folder / "0") + content_of(folder / "19"), "019");
}

TEST(TemporaryFiles, GoWithAProcessThatExits) {
  const Folder folder;
  const int status = status_of_child([&] {
    remove_temporary_files_at_end();
    const AtomicFile file(folder / "a");
    std::exit(7);
  });
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(folder.names(), Names{});
}

TEST(TemporaryFiles, StayAsTheyAreForASignalThatIsIgnored) {
  const Folder folder;
  const int status = status_of_child([&] {
    std::signal(SIGHUP, SIG_IGN);
    remove_temporary_files_at_end();
    AtomicFile file(folder / "a");
    raise(SIGHUP);
    file.commit();
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(folder.names(), Names{"a"});
}

}  // namespace
}  // namespace gale::io
