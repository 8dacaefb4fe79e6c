#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <gale/outputs/persistence.hpp>

// What the text of an option means. Each throws UsageError, with the option and the text, for a text that means
// nothing.

namespace gale::app {

/// Bytes: "1000000", "512MiB", "1.5GiB", "8G"; at least one. Units in either case, all of them powers of 1024: K, KB
/// and KiB are one.
std::size_t parse_size(const std::string& option, const std::string& text);

/// "0.5" or "20%", at least 0.
outputs::Persistence parse_persistence(const std::string& option, const std::string& text);

/// K of "random:K", a whole number of at least 1; nothing if `text` begins otherwise.
std::optional<std::int64_t> parse_random(const std::string& option, const std::string& text);

}  // namespace gale::app
