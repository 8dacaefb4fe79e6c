#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace gale::fuzz {

/// Checks many numbered things in child processes, many in each: one that ends its process, or takes more than ten
/// seconds, is a find, and a new child goes on after it.
class Batches {
 public:
  /// `folder`: where the children's output goes.
  explicit Batches(const std::filesystem::path& folder) : folder_(folder) {}

  std::function<void()> begin;                             ///< in each child, first
  std::function<std::string(std::uint64_t number)> check;  ///< what is wrong; empty if nothing is
  std::function<bool()> succeeded;                         ///< of the last check, for statistics
  std::function<void(std::uint64_t number, const std::string& what, const std::string& output)> found;

  struct Tried {
    std::uint64_t count = 0, succeeded = 0;
    double seconds = 0;
  };

  /// `count` of them from number `from` on, but none begins after some seconds.
  Tried run(std::uint64_t from, std::uint64_t count, double seconds);

 private:
  std::filesystem::path folder_;
};

}  // namespace gale::fuzz
