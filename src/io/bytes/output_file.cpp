#include <fcntl.h>

#include <cerrno>
#include <cstring>

#include <gale/base/error.hpp>
#include <gale/io/bytes/output_file.hpp>

namespace gale::io::detail {
namespace {

constexpr std::size_t buffer_size = 1 << 16;

void write_at(int descriptor, std::uint64_t at, const char* bytes, std::size_t size) {
  const auto write_some = [&](std::size_t done, std::size_t rest) {
    return pwrite(descriptor, bytes + done, rest, static_cast<off_t>(at + done));
  };
  if (!move_all(size, write_some)) throw Error(std::strerror(errno != 0 ? errno : ENOSPC));
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : descriptor_(open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC)) {
  if (descriptor_ < 0) throw Error(std::strerror(errno));
  buffered_.reserve(buffer_size);
}

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
