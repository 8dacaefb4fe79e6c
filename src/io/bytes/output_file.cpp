#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <gale/base/error.hpp>
#include <gale/io/bytes/output_file.hpp>

namespace gale::io::detail {
namespace {

constexpr std::size_t buffer_size = 1 << 20;

void write_at(int descriptor, std::uint64_t at, const char* bytes, std::size_t size) {
  constexpr std::size_t most_at_once = 1 << 30;  // of a call: some systems take no more than 2 GiB
  while (size > 0) {
    const ssize_t taken = pwrite(descriptor, bytes, std::min(size, most_at_once), static_cast<off_t>(at));
    if (taken == -1 && errno == EINTR) continue;
    if (taken == -1) throw Error(std::strerror(errno));
    if (taken == 0) throw Error(std::strerror(ENOSPC));
    at += static_cast<std::uint64_t>(taken);
    bytes += taken;
    size -= static_cast<std::size_t>(taken);
  }
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : descriptor_(-1) {
  buffered_.reserve(buffer_size);
  descriptor_ = open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (descriptor_ == -1) throw Error(std::strerror(errno));
}

OutputFile::~OutputFile() { close(descriptor_); }

void OutputFile::write(const void* bytes, std::size_t size) {
  const char* const begin = static_cast<const char*>(bytes);
  if (buffered_.size() + size > buffer_size) flush();
  if (size > buffer_size) {
    write_at(descriptor_, flushed_, begin, size);
    flushed_ += size;
  } else {
    buffered_.insert(buffered_.end(), begin, begin + size);
  }
}

void OutputFile::rewrite(std::uint64_t at, const void* bytes, std::size_t size) {
  flush();
  write_at(descriptor_, at, static_cast<const char*>(bytes), size);
}

void OutputFile::flush() {
  write_at(descriptor_, flushed_, buffered_.data(), buffered_.size());
  flushed_ += buffered_.size();
  buffered_.clear();
}

}  // namespace gale::io::detail
