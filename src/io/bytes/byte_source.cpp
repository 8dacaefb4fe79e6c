#include <algorithm>

#include <gale/io/bytes/byte_source.hpp>
#include <gale/io/bytes/damaged.hpp>

namespace gale::io::detail {

void read_all(ByteSource& source, char* to, std::size_t bytes, const char* what) {
  const std::size_t got = source.read(to, bytes);
  if (got < bytes) {
    damaged(std::string(what) + " ends after " + std::to_string(got) + " of " + std::to_string(bytes) + " bytes");
  }
}

FileBytes::FileBytes(const InputFile& file, std::uint64_t begin, std::uint64_t end)
    : file_(file), at_(std::min(begin, file.size())), end_(std::clamp(end, at_, file.size())) {}

FileBytes::FileBytes(const InputFile& file, std::uint64_t begin) : FileBytes(file, begin, file.size()) {}

std::size_t FileBytes::read(char* to, std::size_t bytes) {
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, end_ - at_));
  file_.read(at_, to, count);
  at_ += count;
  return count;
}

FileSequence::FileSequence(const std::vector<std::string>& paths, std::uint64_t begin, std::uint64_t bytes)
    : paths_(paths), begin_(begin), bytes_(bytes) {
  DistinctFiles files;
  for (const std::string& path : paths_) {
    const std::unique_ptr<InputFile> file = open_input(path);
    const std::uint64_t size = file->size();
    files.add(*file, path);
    if (size >= begin && size - begin >= bytes) continue;
    damaged("its file '" + path + "' has " + std::to_string(size) + " bytes, not " + std::to_string(bytes) +
            " from byte " + std::to_string(begin) + " on");
  }
}

std::size_t FileSequence::read(char* to, std::size_t bytes) {
  std::size_t got = 0;
  while (got < bytes && current_ < paths_.size()) {
    if (!file_) file_ = open_input(paths_[current_]);
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(bytes - got, bytes_ - read_));
    file_->read(begin_ + read_, to + got, count);
    got += count;
    read_ += count;
    if (read_ < bytes_) continue;
    file_.reset();
    read_ = 0;
    ++current_;
  }
  return got;
}

}  // namespace gale::io::detail
