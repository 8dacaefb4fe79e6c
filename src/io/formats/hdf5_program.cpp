#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/formats/hdf5_file.hpp>
#include <gale/io/installed.hpp>

extern char** environ;

namespace gale::io::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_errno(const char* what) { refuse(what, ": ", std::strerror(errno)); }

struct Spawning {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  Spawning(int talk, int message) {
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, talk, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, talk, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, message, STDERR_FILENO);
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

/// Connects `one` and `other`, whose numbers are above those that the program has as its own.
void connect(Descriptor& one, Descriptor& other) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw_errno("no socket");
  const Descriptor first(ends[0]), second(ends[1]);
  one = Descriptor(fcntl(first, F_DUPFD_CLOEXEC, 16));
  other = Descriptor(fcntl(second, F_DUPFD_CLOEXEC, 16));
  if (one < 0 || other < 0) throw_errno("no descriptor");
}

/// Waits until there is something to read, or an end; asks meanwhile whether to stop.
void wait_for(int descriptor) {
  constexpr int milliseconds = 50;
  pollfd ready = {descriptor, POLLIN, 0};
  do {
    gale::detail::stop_if_asked();
  } while (poll(&ready, 1, milliseconds) == 0);
}

std::string all_of(int pipe) {
  std::string text;
  char buffer[1024];
  for (;;) {
    wait_for(pipe);
    const ssize_t got = ::read(pipe, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    if (text.size() < 4096) text.append(buffer, static_cast<std::size_t>(got));
  }
}

}  // namespace

Hdf5Program::Hdf5Program(const std::string& path) {
  Descriptor its_talk, its_message;
  connect(talk_, its_talk);
  connect(message_, its_message);
  const std::string program =
      find_installed("gale-hdf5-reader", X_OK, "such files are read", "where VTK has HDF5, on Linux");
  const Spawning spawning(its_talk, its_message);
  const std::string absolute = fs::absolute(path).string();
  char* const arguments[] = {const_cast<char*>(program.c_str()), const_cast<char*>(absolute.c_str()), nullptr};
  const int failure =
      posix_spawn(&process_, program.c_str(), &spawning.files, &spawning.attributes, arguments, environ);
  if (failure != 0) {
    process_ = -1;
    refuse(program, " can't be run: ", std::strerror(failure));
  }
}

Hdf5Program::~Hdf5Program() {
  if (process_ < 0) return;
  talk_.close();  // so that it ends, or is of no use any more
  message_.close();
  kill(process_, SIGKILL);
  wait();
}

int Hdf5Program::wait() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

void Hdf5Program::throw_end() {
  talk_.close();
  const std::string message = all_of(message_);
  const int status = wait();
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
    damaged("HDF5 takes longer than a file of its size may");
  if (WIFSIGNALED(status)) damaged("HDF5 ended by a signal: ", strsignal(WTERMSIG(status)));
  throw Error(message.empty() ? "gale-hdf5-reader ended without a word" : printable(message));
}

void Hdf5Program::ask(reader::RequestKind request, const std::vector<std::string>& texts) {
  std::string all(1, static_cast<char>(request));
  for (const std::string& text : texts) all += text + '\0';
  const auto length = static_cast<std::uint32_t>(all.size());
  all.insert(0, reinterpret_cast<const char*>(&length), sizeof length);
  const auto send_some = [&](std::size_t done, std::size_t rest) {
    return send(talk_, all.data() + done, rest, MSG_NOSIGNAL);
  };
  if (!move_all(all.size(), send_some)) throw_end();
}

void Hdf5Program::receive(void* to, std::size_t bytes) {
  const auto receive_some = [&](std::size_t done, std::size_t rest) {
    wait_for(talk_);
    return recv(talk_, static_cast<char*>(to) + done, rest, 0);
  };
  if (!move_all(bytes, receive_some)) throw_end();
}

std::string Hdf5Program::receive_text(std::uint32_t most) {
  const auto length = receive<std::uint32_t>();
  if (length > most) damaged("a name of ", length, " characters");
  std::string text(length, '\0');
  receive(text.data(), length);
  return text;
}

}  // namespace gale::io::detail
