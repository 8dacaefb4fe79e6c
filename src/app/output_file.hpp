#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gale/io/atomic_file.hpp>

namespace gale::app {

/// Throws UsageError if two of the files are the same, or if one is the input.
void require_distinct(const std::vector<std::string>& files, const std::string& input);

/// Throws gale::Error, naming the path, unless a file can be made there now. A file that is there stays as it is.
void require_writable(const std::string& path);

/// Writes what `write` puts out to the temporary of `file`. Throws gale::Error, naming the file, with the system's
/// reason, as soon as something can't be written; whatever `write` throws, too.
void write_text(const io::AtomicFile& file, const std::function<void(std::ostream&)>& write);

}  // namespace gale::app
