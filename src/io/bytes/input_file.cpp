#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/input_file.hpp>

namespace gale::io::detail {

// Not blocking: a pipe would keep us waiting for somebody who writes to it.
InputFile::InputFile(const std::string& path)
    : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ == -1) throw Error(std::strerror(errno));
  struct stat status;
  std::string refusal;
  if (fstat(descriptor_, &status) != 0) {
    refusal = std::strerror(errno);
  } else if (S_ISDIR(status.st_mode)) {
    refusal = "it is a directory";
  } else if (!S_ISREG(status.st_mode)) {
    refusal = "it is not a regular file";
  }
  if (!refusal.empty()) {
    close(descriptor_);
    throw Error(refusal);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  identity_ = {status.st_dev, status.st_ino};
}

InputFile::~InputFile() { close(descriptor_); }

void InputFile::read(std::uint64_t at, char* to, std::size_t bytes) const {
  if (at > size_ || bytes > size_ - at) {
    damaged("it ends after " + std::to_string(size_) + " bytes, where " + std::to_string(bytes) + " from byte " +
            std::to_string(at) + " on were to come");
  }
  constexpr std::size_t most_at_once = 1 << 24;
  while (bytes > 0) {
    gale::detail::stop_if_asked();
    const ssize_t got = pread(descriptor_, to, std::min(bytes, most_at_once), static_cast<off_t>(at));
    if (got == -1 && errno == EINTR) continue;
    if (got == -1) throw Error(std::strerror(errno));
    if (got == 0) damaged("it became shorter while it was read");
    at += static_cast<std::uint64_t>(got);
    to += got;
    bytes -= static_cast<std::size_t>(got);
  }
}

void DistinctFiles::add(const InputFile& file, const std::string& name) {
  const auto [found, is_new] = names_.emplace(file.identity(), name);
  if (is_new) return;
  const std::string first = printable(found->second), again = printable(name);
  throw Error("it names the file '" + again + "' twice" + (first == again ? "" : ", first as '" + first + "'"));
}

std::unique_ptr<InputFile> open_input(const std::string& path) {
  try {
    return std::make_unique<InputFile>(path);
  } catch (const Error& error) {
    damaged("its file '" + path + "': " + error.what());
  }
}

}  // namespace gale::io::detail
