#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/case.hpp"
#include "fuzz/random.hpp"

namespace gale::fuzz {

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
