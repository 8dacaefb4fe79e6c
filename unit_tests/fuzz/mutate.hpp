#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/case.hpp"

namespace gale::fuzz {

/// A small, fast generator whose numbers are the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next();

  /// 0 to count - 1; 0 if count is 0.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : static_cast<std::size_t>(next() % count); }

  bool one_in(std::size_t count) { return below(count) == 0; }

  template <class T>
  const T& one_of(const std::vector<T>& all) {
    return all[below(all.size())];
  }

 private:
  std::uint64_t state_;
};

/// A mutated seed: numbers, words, attributes, lines and blocks of it changed, its data cut, spliced, and noised. The
/// same for the same seeds and number.
struct Mutation {
  Case result;
  std::string story;  ///< what was done to which seed
};

/// `names` are those of the seeds.
Mutation mutated(const std::vector<Case>& seeds, const std::vector<std::string>& names, std::uint64_t number);

/// One mutation of a file's content, on its own; says what it did. `other` is one to splice with.
std::string mutate(std::string& content, const std::string& other, Random& random);

}  // namespace gale::fuzz
