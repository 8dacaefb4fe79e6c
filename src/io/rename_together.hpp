#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <gale/io/temporary_files.hpp>

namespace gale::io::detail {

/// A name in the folder of `path` that no other process or thread takes.
std::string hidden_name_beside(const std::string& path);

/// Waits until what is in a file is on disk. A value of errno, or 0 where that went well.
int sync_file(const std::string& path);

struct Renaming {
  TemporaryName* from;
  std::string to;
};

struct FailedRename {
  std::size_t which = 0;
  int reason = 0;  ///< errno, or 0 where all went well
};

/// Renames all files, syncs their folders, and calls confirm(). If one of that fails, what the names had before gets
/// them again, unless the file system has no hard links. Throws what confirm() throws.
FailedRename rename_together(const std::vector<Renaming>& renamings, const std::function<void()>& confirm);

}  // namespace gale::io::detail
