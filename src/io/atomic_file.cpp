#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <sstream>
#include <system_error>

#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>

namespace gale::io {
namespace {

/// Hidden, and with a name that no other process or thread takes.
std::string temporary_for(const std::filesystem::path& path) {
  std::random_device random;
  std::ostringstream name;
  name << "." << path.filename().string() << "." << std::hex << random() << random() << ".part";
  return (path.parent_path() / name.str()).string();
}

/// A call that returns -1 and sets errno where it fails.
int checked(int result) {
  if (result == -1) throw Error(std::strerror(errno));
  return result;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  namespace fs = std::filesystem;
  std::error_code unknown;  // what can't be looked at can't be opened either, which says why
  if (fs::is_symlink(path_, unknown)) path_ = fs::weakly_canonical(path_).string();
  const fs::file_status there = fs::status(path_, unknown);
  if (fs::is_directory(there)) throw Error("it is a directory");
  if (fs::exists(there) && !fs::is_regular_file(there)) throw Error("it is not a regular file");
  temporary_ = temporary_for(path_);
  close(checked(open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)));
}

AtomicFile::~AtomicFile() {
  if (!committed_) unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  const int file = checked(open(temporary_.c_str(), O_RDONLY | O_CLOEXEC));
  const int synced = fsync(file);
  const int failure = errno;
  close(file);
  if (synced == -1 && failure != EINVAL) throw Error(std::strerror(failure));  // EINVAL: a file system that can't
  checked(std::rename(temporary_.c_str(), path_.c_str()));
  committed_ = true;
}

}  // namespace gale::io
