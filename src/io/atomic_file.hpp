#pragma once

#include <string>

#include <gale/export.hpp>

namespace gale::io {

/// A file that appears under its name complete or not at all.
///
/// Write to `temporary()`, a new, empty file in the same directory, and close it; `commit` then gives it its name,
/// replacing what had it before. Without `commit` the destructor removes it, and what had the name before stays as it
/// was. A link is followed.
class GALE_EXPORT AtomicFile {
 public:
  /// Throws `Error` if the directory takes no new file, or if `path` exists and is no regular file.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary() const { return temporary_; }

  /// Waits until the data is on disk. Throws `Error` if it does not get there.
  void commit();

 private:
  std::string path_, temporary_;
  bool committed_ = false;
};

}  // namespace gale::io
