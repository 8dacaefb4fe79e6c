#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/rename_together.hpp>

namespace gale::io {
namespace {

/// Throws for a value of errno that isn't 0.
void check(int failure) {
  if (failure != 0) throw Error(std::strerror(failure));
}

/// What `use` does; names `path` in whatever goes wrong.
template <class Use>
void named(const std::string& path, const Use& use) {
  try {
    use();
  } catch (const Error& error) {
    refuse_to_write(path, error.what());
  }
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path, Encoding encoding) : path_(path), target_(path), encoding_(encoding) {
  namespace fs = std::filesystem;
  std::error_code unknown;  // what can't be looked at can't be opened either, which says why
  if (fs::is_symlink(target_, unknown)) target_ = fs::weakly_canonical(target_).string();
  const fs::file_status there = fs::status(target_, unknown);
  if (fs::is_directory(there)) throw Error("it is a directory");
  if (fs::exists(there) && !fs::is_regular_file(there)) throw Error("it is not a regular file");
  const std::string name = detail::hidden_name_beside(target_);
  const detail::Uninterrupted creating;
  temporary_ = detail::TemporaryName(name);
  const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const int failure = file == -1 ? errno : 0;
  if (failure != 0) temporary_.forget();
  check(failure);
  close(file);
}

void AtomicFile::sync() const { check(detail::sync_file(temporary())); }

void AtomicFile::commit() {
  check(detail::sync_file(temporary()));
  check(detail::rename_together({{&temporary_, target_}}, [] {}).reason);
}

AtomicFile& AtomicFiles::add(const std::string& path) {
  named(path, [&] { files_.push_back(std::make_unique<AtomicFile>(path, encoding_)); });
  return *files_.back();
}

void AtomicFiles::sync(const AtomicFile& file) {
  named(file.path(), [&] { file.sync(); });
}

void AtomicFiles::commit(const std::function<void()>& confirm) {
  std::vector<detail::Renaming> renamings;
  for (const auto& file : files_) {
    sync(*file);
    renamings.push_back({&file->temporary_, file->target_});
  }
  const detail::FailedRename failed = detail::rename_together(renamings, confirm);
  if (failed.reason != 0) refuse_to_write(files_[failed.which]->path(), std::strerror(failed.reason));
}

void refuse_to_write(const std::string& path, const std::string& reason) {
  throw Error("cannot write '" + path + "': " + reason);
}

}  // namespace gale::io
