// Runs main again and again, each time in a child process of its own with a fault of its own: that costs a fork instead
// of loading some hundred libraries.
//
// With GALE_FAULT_SERVER set, it takes lines from descriptor 3: "KIND AT MORE ERROR SECONDS FOLDER". The child works in
// that folder; what it prints goes to FOLDER.txt. The answer, on descriptor 4: "HOW CODE CALLS FAILED", where HOW is
// exit, signal or hang.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "shim.hpp"

namespace {

using gale::faults::fault;
using gale::faults::Kind;
using Main = int(int, char**, char**);

Main* real_main = nullptr;

Kind kind_named(const char* name) {
  if (std::strcmp(name, "allocation") == 0) return Kind::allocation;
  if (std::strcmp(name, "file") == 0) return Kind::file;
  if (std::strcmp(name, "thread") == 0) return Kind::thread;
  return Kind::none;
}

int counted_main(int argc, char** argv, char** environment) {
  fault->counts = true;
  const int result = real_main(argc, argv, environment);
  fault->counts = false;
  return result;
}

void work_in(const char* folder) {
  char output[4200];
  std::snprintf(output, sizeof output, "%s.txt", folder);
  const int file = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file < 0 || dup2(file, 1) < 0 || dup2(file, 2) < 0 || chdir(folder) != 0) _exit(99);
  close(file);
  close(3);
  close(4);
}

/// The status of the child, or -1 if it takes longer.
int wait_for(pid_t child, double seconds) {
  int status = 0;
  for (double waited = 0; waited < seconds; waited += 0.0005) {
    if (waitpid(child, &status, WNOHANG) == child) return status;
    usleep(500);
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return -1;
}

int serve(int argc, char** argv, char** environment) {
  void* const shared = mmap(nullptr, sizeof(*fault), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return 99;
  FILE* const requests = fdopen(3, "r");
  char kind[32], folder[4096];
  long at = 0, more = 0;
  int error = 0;
  double seconds = 0;
  while (std::fscanf(requests, "%31s %ld %ld %d %lf %4095s", kind, &at, &more, &error, &seconds, folder) == 6) {
    fault = new (shared) gale::faults::Fault;
    fault->at = at;
    fault->more = more;
    fault->error = error;
    fault->kind = kind_named(kind);
    const pid_t child = fork();
    if (child == 0) {
      work_in(folder);
      std::exit(counted_main(argc, argv, environment));
    }
    const int status = wait_for(child, seconds);
    fault->counts = false;  // the child may have ended in the middle
    const char* const how = status == -1 ? "hang" : WIFEXITED(status) ? "exit" : "signal";
    dprintf(4, "%s %d %ld %ld\n", how, WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status), fault->calls.load(),
            fault->failed.load());
  }
  return 0;
}

}  // namespace

extern "C" int __libc_start_main(Main* main, int argc, char** argv, void (*init)(), void (*fini)(), void (*rtld_fini)(),
                                 void* stack_end) {
  using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
  auto* const real = reinterpret_cast<Start*>(dlsym(RTLD_NEXT, "__libc_start_main"));
  real_main = main;
  const bool serves = std::getenv("GALE_FAULT_SERVER") != nullptr;
  return real(serves ? serve : main, argc, argv, init, fini, rtld_fini, stack_end);
}
