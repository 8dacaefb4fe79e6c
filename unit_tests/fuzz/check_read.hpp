#pragma once

#include <filesystem>
#include <string>

#include "fuzz/case.hpp"

namespace gale::fuzz {

/// Reads a case twice, each time with other bytes in fresh memory, from `folder`, which is its own. Returns what is
/// wrong with that, as one line; empty if nothing is: both times the same error, one line that names the file, or the
/// same dataset, all of whose ids and lengths fit; in 64 MiB and ten times what the file can hold; without a word.
std::string complaint_about(const Case& one, const std::filesystem::path& folder);

/// Whether the case could be read; to be called after the above.
bool was_read();

}  // namespace gale::fuzz
