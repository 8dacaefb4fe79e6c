#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/input_file.hpp>
#include <gale/io/bytes/text.hpp>

namespace gale::io::detail {

// Not blocking: a pipe would keep us waiting for somebody who writes to it.
InputFile::InputFile(const std::string& path)
    : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  struct stat status;
  if (descriptor_ < 0 || fstat(descriptor_, &status) != 0) refuse(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) refuse("it is a directory");
  if (!S_ISREG(status.st_mode)) refuse("it is not a regular file");
  size_ = static_cast<std::uint64_t>(status.st_size);
  identity_ = {status.st_dev, status.st_ino};
}

void InputFile::read(std::uint64_t at, char* to, std::size_t bytes) const {
  if (at > size_ || bytes > size_ - at)
    damaged("it ends after ", size_, " bytes, where ", bytes, " from byte ", at, " on were to come");
  const auto read_some = [&](std::size_t done, std::size_t rest) {
    gale::detail::stop_if_asked();
    return pread(descriptor_, to + done, rest, static_cast<off_t>(at + done));
  };
  if (move_all(bytes, read_some, std::size_t(1) << 24)) return;
  if (errno != 0) refuse(std::strerror(errno));
  damaged("it became shorter while it was read");
}

bool InputFile::begins_with(const std::string& magic) const {
  std::string begin(magic.size(), '\0');
  if (size_ < magic.size()) return false;
  read(0, begin.data(), begin.size());
  return begin == magic;
}

void DistinctFiles::add(const InputFile& file, const std::string& name) {
  const auto [found, is_new] = names_.emplace(file.identity(), name);
  if (is_new) return;
  const std::string first = printable(found->second), again = printable(name);
  refuse("it names the file '", again, "' twice", first == again ? "" : ", first as '" + first + "'");
}

std::unique_ptr<InputFile> open_input(const std::string& path) {
  try {
    return std::make_unique<InputFile>(path);
  } catch (const Error& error) {
    damaged("its file '", path, "': ", error.what());
  }
}

void read_all(ByteSource& source, char* to, std::size_t bytes, const char* what) {
  const std::size_t got = source.read(to, bytes);
  if (got < bytes) damaged(what, " ends after ", got, " of ", bytes, " bytes");
}

void skip_all(ByteSource& source, std::uint64_t bytes, const char* what) {
  std::vector<char> buffer(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, 1 << 16)));
  while (bytes > 0) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, buffer.size()));
    read_all(source, buffer.data(), part, what);
    bytes -= part;
  }
}

FileBytes::FileBytes(const InputFile& file, std::uint64_t begin) : file_(file), at_(std::min(begin, file.size())) {}

std::size_t FileBytes::read(char* to, std::size_t bytes) {
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, at_most()));
  file_.read(at_, to, count);
  at_ += count;
  return count;
}

FileSequence::FileSequence(const std::vector<std::string>& paths, const Begin& begin, std::uint64_t bytes)
    : paths_(paths), bytes_(bytes) {
  DistinctFiles files;
  for (const std::string& path : paths_) {
    const std::unique_ptr<InputFile> file = open_input(path);
    const std::uint64_t size = file->size(), first = begin(*file);
    files.add(*file, path);
    if (size < first || size - first < bytes)
      damaged("its file '", path, "' has ", size, " bytes, not ", bytes, " from byte ", first, " on");
    begin_.push_back(first);
  }
}

std::size_t FileSequence::read(char* to, std::size_t bytes) {
  std::size_t got = 0;
  while (got < bytes && current_ < paths_.size()) {
    if (!file_) file_ = open_input(paths_[current_]);
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(bytes - got, bytes_ - read_));
    file_->read(begin_[current_] + read_, to + got, count);
    got += count;
    read_ += count;
    if (read_ < bytes_) continue;
    file_.reset();
    read_ = 0;
    ++current_;
  }
  return got;
}

std::size_t MemoryBytes::read(char* to, std::size_t bytes) {
  const std::size_t count = std::min(bytes, bytes_.size() - at_);
  std::memcpy(to, bytes_.data() + at_, count);
  at_ += count;
  return count;
}

}  // namespace gale::io::detail
