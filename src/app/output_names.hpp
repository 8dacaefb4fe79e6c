#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <gale/mesh/ranks.hpp>

// What files are called that stand for one that the command line names: of a step, of a rank, and what names these.

namespace gale::app {

/// Files that are written, and those of them that a rank writes itself.
struct WrittenFiles {
  std::vector<std::string> all, own;
};

/// The files that stand for those that the command line names: for each of so many steps its own, and what names these;
/// where `steps` is 0, themselves. On several ranks also the pieces; what names these the first rank writes.
WrittenFiles files_written(const std::vector<std::string>& named, std::size_t steps, const Ranks& ranks);

/// Throws UsageError if two of the files are the same, or if one is an input, by whatever link or spelling.
void require_distinct(const std::vector<std::string>& files, const std::vector<std::string>& inputs);

/// NAME_0012.vtp for the step 12 of NAME.vtp.
std::string name_of_step(const std::string& path, std::size_t step);

/// NAME.pvd for NAME.vtp and its like, NAME.vtkhdf.series for NAME.vtkhdf: the file that names those of all steps, as
/// the format says; empty for others.
std::string name_of_series(const std::string& path);

/// Whether it is a file that names pieces, one of each rank; others the first rank writes.
bool has_pieces(const std::string& path);

/// NAME_RANK.vtp for NAME.pvtp, NAME_RANK.vtu for NAME.pvtu: for a file that `has_pieces`.
std::string piece_of(const std::string& path, int rank);

}  // namespace gale::app
