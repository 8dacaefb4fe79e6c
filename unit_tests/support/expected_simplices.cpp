#include "support/expected_simplices.hpp"

#include <algorithm>

#include "support/arrays.hpp"
#include "support/brute_force.hpp"

namespace gale::test {

namespace {

std::vector<Id> inverse_of(const Array<const Id, HostMemory>& permutation) {
  std::vector<Id> inverse(permutation.extent(0), no_id);
  for (std::size_t i = 0; i < inverse.size(); ++i) inverse.at(permutation(i)) = static_cast<Id>(i);
  return inverse;
}

std::vector<Id> ordered(std::size_t count) {
  std::vector<Id> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<Id>(i);
  return numbers;
}

}  // namespace

ExpectedSimplices::ExpectedSimplices(const BruteForce& brute_force, const Mesh& mesh, int highest)
    : vertex_begin(to_vector(mesh.vertex_begin())) {
  number[0] = inverse_of(mesh.vertex_input());
  number[3] = inverse_of(mesh.cell_input());
  for (const int dimension : {0, 1, 2, 3}) {
    if (dimension > highest && dimension < 3) continue;
    auto simplices = brute_force.simplices(dimension);
    for (auto& simplex : simplices) {
      for (Id& vertex : simplex) vertex = number[0][vertex];
      std::sort(simplex.begin(), simplex.end());
    }
    if (number[dimension].empty()) {
      auto order = ordered(simplices.size());
      std::sort(order.begin(), order.end(), [&](Id a, Id b) { return simplices[a] < simplices[b]; });
      number[dimension].resize(order.size());
      for (std::size_t i = 0; i < order.size(); ++i) number[dimension][order[i]] = static_cast<Id>(i);
    }
    vertices[dimension].resize(simplices.size());
    for (std::size_t i = 0; i < simplices.size(); ++i) vertices[dimension].at(number[dimension][i]) = simplices[i];
  }
}

Interval ExpectedSimplices::internal_to(Id segment, int dimension) const {
  const auto& all = vertices[dimension];
  const auto first_from = [&](Id vertex) {
    const auto before = [](const std::vector<Id>& simplex, Id limit) { return simplex[0] < limit; };
    return static_cast<Id>(std::lower_bound(all.begin(), all.end(), vertex, before) - all.begin());
  };
  return {first_from(vertex_begin.at(segment)), first_from(vertex_begin.at(segment + 1))};
}

}  // namespace gale::test
