#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>

#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/bytes/descriptor.hpp>
#include <gale/io/bytes/text.hpp>

namespace gale::io {
namespace {

using detail::refuse;

/// A name in the folder of `path` that no other process or thread takes.
std::string hidden_name_beside(const std::string& path) {
  const std::filesystem::path whole(path);
  std::random_device random;
  std::ostringstream name;
  name << "." << whole.filename().string().substr(0, 200) << "." << std::hex << random() << random() << ".part";
  return (whole.parent_path() / name.str()).string();
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// The path of an open file, in this process.
std::string path_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// Whether fsync() failed since the file system syncs no folders, or nothing.
bool cannot_sync(int failure) { return failure == EINVAL || failure == EROFS || failure == ENOTSUP; }

int sync(const std::string& path, int flags) {
  const detail::Descriptor file(open(path.c_str(), flags | O_CLOEXEC));
  return file >= 0 && (fsync(file) == 0 || cannot_sync(errno)) ? 0 : errno;
}

/// The file that has the name which another is to get.
struct Before {
  detail::TemporaryName name;  ///< another name for it
  bool exists = false, is_kept = false;
};

Before keep(const std::string& path) {
  Before before;
  before.exists = access(path.c_str(), F_OK) == 0;
  if (!before.exists) return before;
  before.name = detail::TemporaryName(hidden_name_beside(path));
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

/// A new file without a name in a folder, which ends with the process. -1 where the file system has none, or where
/// descriptors are short: many files may be open at once.
int make_unnamed(const std::string& folder) {
#ifdef O_TMPFILE
  struct rlimit limit {};
  detail::Descriptor file(open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  if (file < 0 || getrlimit(RLIMIT_NOFILE, &limit) != 0 || static_cast<rlim_t>(file) > limit.rlim_cur / 2) return -1;
  return access(path_of(file).c_str(), W_OK) == 0 ? file.release() : -1;
#else
  return -1;
#endif
}

struct Renaming {
  detail::TemporaryName* from;
  std::string to;
};

/// Waits until what is in a file is on disk. A value of errno, or 0 where that went well.
int sync_file(const std::string& path) { return sync(path, O_RDONLY); }

/// Throws for a value of errno that isn't 0.
void check(int failure) {
  if (failure != 0) throw Error(std::strerror(failure));
}

/// Renames all files, syncs their folders, and calls confirm(). If one of that fails, what the names had before gets
/// them again, unless the file system has no hard links. Throws what confirm() throws, and what failed(i, errno) throws
/// of the i-th file.
template <class Failed>
void rename_together(const std::vector<Renaming>& renamings, const Failed& failed,
                     const std::function<void()>& confirm) {
  std::vector<Before> before;
  for (const Renaming& renaming : renamings) before.push_back(keep(renaming.to));
  std::size_t done = 0;
  const detail::Uninterrupted renaming_all;
  try {
    for (; done < renamings.size(); ++done) {
      if (std::rename(renamings[done].from->path().c_str(), renamings[done].to.c_str()) != 0) failed(done, errno);
      renamings[done].from->forget();
    }
    std::string synced;
    for (std::size_t i = 0; i < renamings.size(); ++i) {
      const std::string folder = folder_of(renamings[i].to);
      if (folder == synced) continue;
      const int failure = sync(folder, O_RDONLY | O_DIRECTORY);
      if (failure != 0 && failure != EACCES) failed(i, failure);  // EACCES: a folder that only takes files
      synced = folder;
    }
    confirm();
  } catch (...) {
    for (std::size_t i = 0; i < done; ++i) undo(renamings[i].to, before[i]);
    throw;
  }
}

/// Does what `use` does; names `path` in whatever goes wrong.
template <class Use>
void named(const std::string& path, const Use& use) {
  try {
    use();
  } catch (const Error& error) {
    refuse_to_write(path, error.what());
  }
}

}  // namespace

std::string detail::end_of_links(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int most_links = 40;  // as Linux has it
  std::error_code failure;
  fs::path at = path;
  for (int links = 0; fs::is_symlink(at, failure); ++links) {
    if (links == most_links) throw Error(std::make_error_code(std::errc::too_many_symbolic_link_levels).message());
    const fs::path next = fs::read_symlink(at, failure);
    if (failure) throw Error(failure.message());
    at = at.parent_path() / next;
  }
  return at.string();
}

AtomicFile::AtomicFile(const std::string& path, Encoding encoding) : path_(path), target_(path), encoding_(encoding) {
  namespace fs = std::filesystem;
  std::error_code unknown;  // what can't be looked at can't be opened either, which says why
  const fs::file_status there = fs::status(target_, unknown);
  if (fs::is_directory(there)) throw Error("it is a directory");
  if (fs::exists(there) && !fs::is_regular_file(there)) throw Error("it is not a regular file");
  target_ = detail::end_of_links(target_);
  unnamed_ = make_unnamed(folder_of(target_));
  if (unnamed_ >= 0) {
    unnamed_path_ = path_of(unnamed_);
    return;
  }
  const std::string name = hidden_name_beside(target_);
  const detail::Uninterrupted creating;
  temporary_ = detail::TemporaryName(name);
  if (detail::Descriptor(open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) >= 0) return;
  const int failure = errno;
  temporary_.forget();
  check(failure);
}

AtomicFile::~AtomicFile() { const detail::Descriptor unnamed(unnamed_); }

void AtomicFile::name() {
  if (unnamed_ < 0) return;
  const std::string name = hidden_name_beside(target_);
  const detail::Uninterrupted naming;
  detail::TemporaryName hidden(name);
  if (linkat(AT_FDCWD, unnamed_path_.c_str(), AT_FDCWD, hidden.path().c_str(), AT_SYMLINK_FOLLOW) != 0) {
    // What makes files without a name may refuse to give them one: then a copy has it.
    std::error_code failure;
    if (!std::filesystem::copy_file(unnamed_path_, hidden.path(), failure)) throw Error(failure.message());
    check(sync_file(hidden.path()));
  }
  temporary_ = std::move(hidden);
  const detail::Descriptor unnamed(std::exchange(unnamed_, -1));
}

void AtomicFile::sync() const { check(sync_file(temporary())); }

void AtomicFile::commit() {
  check(sync_file(temporary()));
  name();
  rename_together(
      {{&temporary_, target_}}, [](std::size_t, int failure) { check(failure); }, [] {});
}

AtomicFile& AtomicFiles::add(const std::string& path) {
  named(path, [&] { files_.push_back(std::make_unique<AtomicFile>(path, encoding_)); });
  return *files_.back();
}

void AtomicFiles::sync(const AtomicFile& file) {
  named(file.path(), [&] { file.sync(); });
}

void AtomicFiles::commit(const std::function<void()>& confirm) {
  for (const auto& file : files_) sync(*file);
  std::vector<Renaming> renamings;
  for (const auto& file : files_) {
    named(file->path(), [&] { file->name(); });
    renamings.push_back({&file->temporary_, file->target_});
  }
  const auto failed = [this](std::size_t i, int failure) {
    refuse_to_write(files_[i]->path(), std::strerror(failure));
  };
  rename_together(renamings, failed, confirm);
}

void refuse_to_write(const std::string& path, const std::string& reason) {
  refuse("cannot write '", path, "': ", reason);
}

}  // namespace gale::io
