#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/damaged.hpp>
#include <gale/io/formats/readers.hpp>

extern char** environ;

namespace gale::io::detail {

namespace {

namespace fs = std::filesystem;

constexpr char program_name[] = "gale-vtk-reader";

/// The folder of the program, or of the library or module, that holds this code.
fs::path own_folder() {
  static const int here = 0;
  std::error_code unknown;
  Dl_info info;
  const bool is_known = dladdr(&here, &info) != 0 && std::strchr(info.dli_fname, '/') != nullptr;
  const fs::path own = is_known ? fs::canonical(info.dli_fname, unknown) : fs::path();
  return (own.empty() ? fs::read_symlink("/proc/self/exe", unknown) : own).parent_path();
}

/// Beside that, where the Python module has it, or where GALE was installed.
std::string find_program() {
  const fs::path own = own_folder();
  for (const fs::path& folder : {own, own / "bin", own / GALE_LIBEXEC_FROM_BIN, fs::path(GALE_LIBEXEC)}) {
    const fs::path program = folder / program_name;
    if (access(program.c_str(), X_OK) == 0) return program.string();
  }
  throw Error(std::string("such files are read by ") + program_name + ", which isn't beside " + own.string() +
              " nor in " + GALE_LIBEXEC + ": it is built where VTK has its modules IOExodus, IOHDF and IOXML");
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {
    if (number < 0) throw Error(std::string("no descriptor: ") + std::strerror(errno));
  }
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// What the program finds in descriptors 3 and 4: a file for the result, and a pipe for a line about what is wrong or
/// left out.
constexpr int result_number = 3, message_number = 4;

struct Spawning {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  Spawning(int result, int message) {
    posix_spawn_file_actions_init(&files);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&files, standard, "/dev/null", O_RDWR, 0);
    posix_spawn_file_actions_adddup2(&files, result, result_number);
    posix_spawn_file_actions_adddup2(&files, message, message_number);
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  }
  ~Spawning() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;
};

/// Above what the program's own descriptors are.
int moved_up(int number) {
  const int moved = number < 0 ? number : fcntl(number, F_DUPFD_CLOEXEC, 16);
  if (number >= 0) ::close(number);
  return moved;
}

/// A process that doesn't outlive what waits for it.
class Process {
 public:
  explicit Process(pid_t id) : id_(id) {}
  ~Process() {
    if (id_ == 0) return;
    kill(id_, SIGKILL);
    wait();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Its status.
  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
};

std::string all_of(int pipe) {
  std::string text;
  char buffer[1024];
  for (;;) {
    constexpr int milliseconds = 50;
    pollfd ready = {pipe, POLLIN, 0};
    gale::detail::stop_if_asked();
    if (poll(&ready, 1, milliseconds) == 0) continue;
    const ssize_t got = ::read(pipe, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    if (text.size() < 4096) text.append(buffer, static_cast<std::size_t>(got));
  }
}

/// Runs the program, and returns what it has to note. Throws gale::Error with what it says, or how it ended.
std::string run(const char* format, const std::string& path, int result) {
  const std::string program = find_program();
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("no pipe: ") + std::strerror(errno));
  Descriptor from(moved_up(ends[0])), to(moved_up(ends[1]));
  const Spawning spawning(result, to);
  const std::string absolute = fs::absolute(path).string();
  char* const arguments[] = {const_cast<char*>(program.c_str()), const_cast<char*>(format),
                             const_cast<char*>(absolute.c_str()), nullptr};
  pid_t id;
  const int failure = posix_spawn(&id, program.c_str(), &spawning.files, &spawning.attributes, arguments, environ);
  if (failure != 0) throw Error(program + " can't be run: " + std::strerror(failure));
  Process process(id);
  to.close();
  const std::string message = all_of(from);
  const int status = process.wait();
  if (WIFSIGNALED(status)) damaged(std::string("VTK's reader ended by a signal (") + strsignal(WTERMSIG(status)) + ")");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(message.empty() ? "VTK's reader ended without a word" : printable(message));
  return message;
}

bool is_image(const InputFile& file) {
  std::string start(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), 512)), '\0');
  file.read(0, start.data(), start.size());
  return start.find("type=\"ImageData\"") != std::string::npos;
}

}  // namespace

Content read_by_program(const InputFile& input, Format format, const ReadOptions& options) {
#if defined(__linux__)
  const Descriptor result(moved_up(memfd_create("gale", MFD_CLOEXEC)));
  const std::string notice = run(format == Format::exodus ? "exodus" : "vtkhdf", input.path(), result);
  const InputFile file("/proc/self/fd/" + std::to_string(int(result)));
  Content content = is_image(file) ? read_vti(file, options) : read_vtu(file, options);
  if (!notice.empty()) std::visit([&](auto& found) { found.notices.push_back(printable(notice)); }, content);
  return content;
#else
  throw Error("such files are read on Linux alone");
#endif
}

}  // namespace gale::io::detail
