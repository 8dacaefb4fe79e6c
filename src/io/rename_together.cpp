#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <set>
#include <sstream>
#include <utility>

#include <gale/io/rename_together.hpp>

namespace gale::io::detail {
namespace {

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Some file systems sync no folders, or nothing.
bool cannot_sync(int failure) { return failure == EINVAL || failure == EROFS || failure == ENOTSUP; }

int sync(const std::string& path, int flags) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file == -1) return errno;
  const int failure = fsync(file) == 0 || cannot_sync(errno) ? 0 : errno;
  close(file);
  return failure;
}

/// What has the name that a file is to get.
struct Before {
  TemporaryName name;  ///< another name for it
  bool exists = false, is_kept = false;
};

Before keep(const std::string& path) {
  Before before;
  before.exists = access(path.c_str(), F_OK) == 0;
  if (!before.exists) return before;
  before.name = TemporaryName(hidden_name_beside(path));
  before.is_kept = link(path.c_str(), before.name.path().c_str()) == 0;
  if (!before.is_kept) before.name.forget();
  return before;
}

void undo(const std::string& path, Before& before) {
  if (!before.exists) {
    unlink(path.c_str());
  } else if (before.is_kept && std::rename(before.name.path().c_str(), path.c_str()) == 0) {
    before.name.forget();
  }
}

}  // namespace

std::string hidden_name_beside(const std::string& path) {
  const std::filesystem::path whole(path);
  std::random_device random;
  std::ostringstream name;
  name << "." << whole.filename().string().substr(0, 200) << "." << std::hex << random() << random() << ".part";
  return (whole.parent_path() / name.str()).string();
}

int sync_file(const std::string& path) { return sync(path, O_RDONLY); }

FailedRename rename_together(const std::vector<Renaming>& renamings, const std::function<void()>& confirm) {
  std::vector<Before> before;
  std::vector<std::string> folders;
  for (const Renaming& renaming : renamings) {
    folders.push_back(folder_of(renaming.to));
    before.push_back(keep(renaming.to));
  }
  FailedRename failed;
  std::size_t done = 0;
  const Uninterrupted renaming_all;
  for (; done < renamings.size() && failed.reason == 0; ++done) {
    if (std::rename(renamings[done].from->path().c_str(), renamings[done].to.c_str()) != 0) {
      failed = {done, errno};
      break;
    }
    renamings[done].from->forget();
  }
  for (std::size_t i = 0; i < done && failed.reason == 0; ++i) {
    if (i > 0 && folders[i] == folders[i - 1]) continue;
    const int failure = sync(folders[i], O_RDONLY | O_DIRECTORY);
    if (failure != 0 && failure != EACCES) failed = {i, failure};  // EACCES: a folder that only takes files
  }
  const auto undo_all = [&] {
    for (std::size_t i = 0; i < done; ++i) undo(renamings[i].to, before[i]);
  };
  if (failed.reason != 0) {
    undo_all();
    return failed;
  }
  try {
    confirm();
  } catch (...) {
    undo_all();
    throw;
  }
  return failed;
}

}  // namespace gale::io::detail
