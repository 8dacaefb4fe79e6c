#include <gale/outputs/manifolds.hpp>

namespace gale::outputs {

namespace {

/// Appends the sizes of the manifolds 0 to count-1.
void append_sizes(const Mirrored<Id>& found, Id count, std::vector<Id>& sizes) {
  const auto& manifold = found.in<HostMemory>();
  const bool is_there = manifold.extent(0) != 0;
  const std::size_t first = sizes.size();
  sizes.resize(first + count, is_there ? 0 : -1);
  for (std::size_t v = 0; v < manifold.extent(0); ++v) {
    if (manifold(v) != no_id) ++sizes[first + manifold(v)];
  }
}

}  // namespace

std::vector<io::PointArray> manifold_arrays(const MorseSmaleComplex& complex) {
  std::vector<io::PointArray> arrays;
  const auto add = [&](const char* name, const Mirrored<Id>& found) {
    if (found.size() == 0) return;
    const auto& manifold = found.in<HostMemory>();
    arrays.push_back({name, 1, std::vector<Id>(manifold.data(), manifold.data() + manifold.extent(0))});
  };
  add("AscendingManifold", complex.ascending_manifold);
  add("DescendingManifold", complex.descending_manifold);
  add("MorseSmaleManifold", complex.morse_smale_manifold);
  return arrays;
}

io::PointArray manifold_sizes(const MorseSmaleComplex& complex) {
  const auto counts = complex.critical.counts();
  std::vector<Id> sizes;
  append_sizes(complex.descending_manifold, counts[0], sizes);
  sizes.resize(sizes.size() + counts[1] + counts[2], 0);
  append_sizes(complex.ascending_manifold, counts[3], sizes);
  return {"ManifoldSize", 1, std::move(sizes)};
}

}  // namespace gale::outputs
