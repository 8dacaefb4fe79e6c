#include "fuzz/batches.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "fuzz/case.hpp"

namespace gale::fuzz {

namespace {

constexpr std::uint64_t batch = 500;
constexpr double too_long = 10;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Memory that parent and child both see.
struct Shared {
  std::atomic<std::uint64_t> next{0};  ///< that the child is at
  std::atomic<double> begun{0};
  std::atomic<std::uint64_t> succeeded{0};
  std::atomic<bool> complains{false};
  char complaint[1000] = {};
};

Shared* make_shared() {
  void* const place = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  return new (place) Shared;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return std::string("ended by a signal: ") + strsignal(WTERMSIG(status));
  return "ended the process with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

Batches::Tried Batches::run(std::uint64_t from, std::uint64_t count, double seconds) {
  Shared* const shared = make_shared();
  const std::filesystem::path output = folder_ / "output.txt";
  const std::uint64_t end = from + count;
  const double start = seconds_now();
  shared->next = from;
  const auto work = [&] {
    const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0666);
    dup2(file, 1);
    dup2(file, 2);
    begin();
    for (std::uint64_t last = std::min(end, shared->next + batch); shared->next < last; ++shared->next) {
      shared->begun = seconds_now();
      std::string complaint = check(shared->next);
      std::fflush(nullptr);
      struct stat status {};
      if (complaint.empty() && fstat(file, &status) == 0 && status.st_size != 0) complaint = "it printed something";
      shared->succeeded += succeeded() ? 1 : 0;
      if (complaint.empty()) continue;
      std::snprintf(shared->complaint, sizeof shared->complaint, "%s", complaint.c_str());
      shared->complains = true;
      _exit(0);
    }
    _exit(0);
  };
  while (shared->next < end && seconds_now() - start < seconds) {
    shared->begun = seconds_now();
    const pid_t child = fork();
    if (child == 0) work();
    int status = 0;
    bool hung = false;
    while (waitpid(child, &status, WNOHANG) == 0) {
      usleep(1000);
      hung = seconds_now() - shared->begun > too_long;
      if (!hung) continue;
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      break;
    }
    const bool complains = shared->complains.exchange(false);
    if (!complains && WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
    const std::string what = complains ? shared->complaint : hung ? "it took more than 10 s" : how_it_ended(status);
    found(shared->next, what, content_of(output));
    ++shared->next;
  }
  const Tried tried{shared->next - from, shared->succeeded, seconds_now() - start};
  munmap(shared, sizeof(Shared));
  return tried;
}

}  // namespace gale::fuzz
