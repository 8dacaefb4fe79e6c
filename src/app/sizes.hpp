#pragma once

#include <cstddef>
#include <string>

namespace gale::app {

/// Bytes: "1000000", "512MiB", "1.5GiB", "8G". Units in either case, all of them powers of 1024: K, KB and KiB are one.
/// Throws UsageError, naming `option` and `text`, for anything else, and unless it is at least one byte.
std::size_t parse_size(const std::string& option, const std::string& text);

}  // namespace gale::app
