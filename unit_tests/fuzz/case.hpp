#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gale/io/read.hpp>

namespace gale::fuzz {

/// A file to read, and how.
struct Case {
  std::string extension;  ///< with its dot: ".nii.gz"
  std::string content;
  std::string companion;  ///< what is in input.raw beside it; empty if there is none
  io::ReadOptions options;
};

/// A file, with FILE.raw as its companion if there is one.
Case load(const std::filesystem::path& file);

/// Writes the case as `load` reads it, to `file` and the case's extension; returns the name.
std::filesystem::path save(const Case& one, const std::filesystem::path& file);

/// Each file in a folder but the companions, by name.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);

/// The bytes of a file, or those written to it.
std::string content_of(const std::filesystem::path& file);
void put(const std::filesystem::path& file, const std::string& content);

}  // namespace gale::fuzz
