#include <gale/mesh/exchange/places.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/manifolds.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

/// Appends the sizes of the manifolds 0 to count-1.
void append_sizes(const Mirrored<Id>& found, Id count, std::vector<GlobalId>& sizes) {
  const auto& manifold = found.in<HostMemory>();
  const bool is_there = manifold.extent(0) != 0;
  const std::size_t first = sizes.size();
  sizes.resize(first + count, is_there ? 0 : -1);
  for (std::size_t v = 0; v < manifold.extent(0); ++v) {
    if (manifold(v) != no_id) ++sizes[first + manifold(v)];
  }
}

using Labels = Array<GlobalId, HostMemory>;

/// Appends how many vertices of all ranks are in each of the manifolds that are `asked` for. Collective.
void append_sizes(const Mesh& mesh, const Mirrored<Id>& found, const Labels& asked, std::vector<GlobalId>& sizes) {
  Labels owned;
  gale::detail::together(mesh.exchange().ranks(), [&] {
    const auto& manifold = found.in<HostMemory>();
    std::vector<GlobalId> all;
    for (const Id v : mesh.owned_vertices()) {
      const Id label = manifold(mesh.vertices_in_input()[v]);
      if (label != no_id) all.push_back(label);
    }
    owned = gale::detail::array_of("GALE::owned_labels", all);
  });
  const auto counts = gale::detail::occurrences(mesh.exchange().ranks(), owned, asked);
  sizes.insert(sizes.end(), counts.data(), counts.data() + counts.extent(0));
}

/// The places of this rank's minima, or maxima, among those of all, by the global ids of `simplices` (GALE's ids).
template <class IdOf>
Labels places_of_extrema(const Ranks& ranks, const std::vector<Id>& simplices, const IdOf& id_of) {
  Array<gale::detail::SimplexKey, HostMemory> keys;
  gale::detail::together(ranks, [&] {
    keys = allocate<decltype(keys)>("GALE::extrema", simplices.size());
    for (std::size_t i = 0; i < simplices.size(); ++i) keys(i) = {id_of(simplices[i]), 0, 0};
  });
  return gale::detail::places_of_keys(ranks, keys).places;
}

/// How many saddles of this rank's there are.
std::size_t saddles_of(const MorseSmaleComplex& complex) {
  const auto counts = complex.own_counts();
  return complex.critical.dimension == 2 ? counts[1] : counts[1] + counts[2];
}

/// Leaves out critical vertices, or cells, that aren't this rank's.
std::vector<Id> own_of(const MorseSmaleComplex& complex, int dimension, const std::vector<Id>& all) {
  std::vector<Id> own;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (complex.owns(dimension, static_cast<Id>(i))) own.push_back(all[i]);
  }
  return own;
}

std::vector<GlobalId> sizes_on_ranks(const MorseSmaleComplex& complex) {
  const Mesh &mesh = complex.gradient.mesh(), &named_in = mesh_of_excerpt(complex);
  const Ranks& ranks = mesh.exchange().ranks();
  const int top = complex.critical.dimension;
  const auto counts = complex.own_counts();
  const std::size_t saddles = saddles_of(complex);
  std::vector<GlobalId> sizes;
  if (complex.parts.descending_manifolds) {
    const auto minima = places_of_extrema(ranks, own_of(complex, 0, complex.critical.vertices),
                                          [&](Id v) { return named_in.vertex_id(named_in.vertices_in_input()[v]); });
    append_sizes(mesh, complex.descending_manifold, minima, sizes);
  }
  sizes.resize(counts[0], -1);
  sizes.resize(sizes.size() + saddles, 0);
  if (complex.parts.ascending_manifolds) {
    const auto maxima = places_of_extrema(ranks, own_of(complex, top, complex.critical.cells),
                                          [&](Id t) { return named_in.cell_id(named_in.cells_in_input()[t]); });
    append_sizes(mesh, complex.ascending_manifold, maxima, sizes);
  }
  sizes.resize(counts[0] + saddles + counts[top], -1);
  return sizes;
}

std::vector<GlobalId> sizes_of_all(const MorseSmaleComplex& complex) {
  const auto counts = complex.critical.counts();
  std::vector<GlobalId> sizes;
  append_sizes(complex.descending_manifold, counts[0], sizes);
  sizes.resize(sizes.size() + saddles_of(complex), 0);
  append_sizes(complex.ascending_manifold, static_cast<Id>(complex.critical.cells.size()), sizes);
  return sizes;
}

}  // namespace

std::vector<io::PointArray> manifold_arrays(const MorseSmaleComplex& complex) {
  const MorseSmaleParts& parts = complex.parts;
  const bool is_part = complex.gradient.mesh().is_part();  // which may have no vertices
  std::vector<io::PointArray> arrays;
  const auto add = [&](const char* name, bool is_wanted, const Mirrored<Id>& found) {
    if (found.size() == 0 && !(is_part && is_wanted)) return;
    const auto& manifold = found.in<HostMemory>();
    const Id* const end = manifold.data() + manifold.extent(0);
    arrays.push_back({name, 1, {}});
    if (is_part) {
      arrays.back().values = std::vector<GlobalId>(manifold.data(), end);
    } else {
      arrays.back().values = std::vector<Id>(manifold.data(), end);
    }
  };
  add("AscendingManifold", parts.ascending_manifolds, complex.ascending_manifold);
  add("DescendingManifold", parts.descending_manifolds, complex.descending_manifold);
  add("MorseSmaleManifold", parts.ascending_manifolds && parts.descending_manifolds, complex.morse_smale_manifold);
  return arrays;
}

io::PointArray manifold_sizes(const MorseSmaleComplex& complex) {
  const Exchange& exchange = complex.gradient.mesh().exchange();
  auto sizes = exchange.is_of_part() ? sizes_on_ranks(complex) : sizes_of_all(complex);
  return {"ManifoldSize", 1, detail::ids_as(exchange, std::move(sizes))};
}

}  // namespace gale::outputs
