#pragma once

#include <csignal>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/export.hpp>

namespace gale::io {

/// Has the signals that end a process, and an `exit`, remove the temporary files of all `AtomicFile`s first, from now
/// on; the process still ends by the signal. A signal that is ignored or has a handler keeps that. For an application
/// that has none of its own: the library never calls it.
GALE_EXPORT void remove_temporary_files_at_end();

/// Removes the temporary files of all `AtomicFile`s now, in a signal handler too: for who ends the process otherwise.
GALE_EXPORT void remove_temporary_files();

namespace detail {

/// The path that a link leads to, by as many links as it takes, whether there is a file or not; any other path itself.
/// Throws gale::Error for links that lead in a circle or can't be read.
GALE_EXPORT std::string end_of_links(const std::string& path);

/// While it lives, the handler of the above waits, two seconds at most, before it ends the process: what is begun on
/// this thread is done. To be destroyed on the thread that made it.
class GALE_EXPORT Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

 private:
  sigset_t before_;
};

/// The name of a file that goes with this object, whether there is one or not, or with the process.
class GALE_EXPORT TemporaryName {
 public:
  TemporaryName() = default;
  explicit TemporaryName(const std::string& path);
  ~TemporaryName();
  TemporaryName(TemporaryName&& other) noexcept;
  TemporaryName& operator=(TemporaryName&& other) noexcept;

  /// The file has another name now, or none.
  void forget();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  char* copy_ = nullptr;   ///< for the handler; null when there is nothing to remove
  void* place_ = nullptr;  ///< where the handler finds it
};

}  // namespace detail
/// How VTK's XML files have their arrays: after all XML, as they are in memory; or as base64 in it, which takes a third
/// more and more time, and which readers take that refuse what isn't XML.
enum class Encoding { appended, base64 };

/// A file that appears under its name complete or not at all.
///
/// Write to `temporary()`, a new, empty file in the same directory, and close it; `commit` then gives it its name,
/// replacing what had it before. Without `commit` the destructor removes it, and what had the name before stays as it
/// was. A link is followed. Until `commit` the file has no name where the file system can do that (O_TMPFILE), so that
/// nothing is left of it however the process ends; else a hidden one.
class GALE_EXPORT AtomicFile {
 public:
  /// Throws `Error` if the directory takes no new file, or if `path` exists and is no regular file.
  explicit AtomicFile(const std::string& path, Encoding encoding = Encoding::appended);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The path, as it was given.
  const std::string& path() const { return path_; }

  /// The path of the file to write to, in this process.
  const std::string& temporary() const { return unnamed_ < 0 ? temporary_.path() : unnamed_path_; }

  /// The encoding of its arrays, if it is to be one of VTK's XML files.
  Encoding encoding() const { return encoding_; }

  /// Waits until what was written is on disk. Throws `Error` if it does not get there.
  void sync() const;

  /// Waits until the data is on disk, and its name too. Throws `Error` if they do not get there.
  void commit();

 private:
  friend class AtomicFiles;

  /// Gives the file a hidden name, if it has none.
  void name();

  std::string path_, target_;  ///< `target_`: where links lead
  Encoding encoding_;
  int unnamed_ = -1;  ///< the descriptor of a file that has no name yet
  std::string unnamed_path_;
  detail::TemporaryName temporary_;
};

/// Files that appear together or not at all, as far as the file system can: all are written and synced before the first
/// gets its name, and if one doesn't get its name, or the names don't reach the disk, then those that did lose it
/// again to what had it before. A signal comes before or after all that, if `remove_temporary_files_at_end` was called.
/// All errors name the file.
class GALE_EXPORT AtomicFiles {
 public:
  /// Files whose arrays are all to be written in this encoding.
  explicit AtomicFiles(Encoding encoding = Encoding::appended) : encoding_(encoding) {}

  /// Adds a file, which stays where it is as long as this object. Throws as the constructor of AtomicFile does.
  AtomicFile& add(const std::string& path);

  /// Syncs one of them, so that less is left to do at the end.
  static void sync(const AtomicFile& file);

  /// Gives all of them their names, and calls confirm(): if that throws, they lose them again, and what it threw passes
  /// on. To be called once, when all are written and closed.
  void commit(const std::function<void()>& confirm = [] {});

  /// All files, in the order in which they were added.
  const std::vector<std::unique_ptr<AtomicFile>>& all() const { return files_; }

 private:
  Encoding encoding_;
  std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// The error that `path` can't be written, and why.
[[noreturn]] GALE_EXPORT void refuse_to_write(const std::string& path, const std::string& reason);

}  // namespace gale::io
