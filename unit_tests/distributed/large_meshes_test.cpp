#include <cstdlib>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/arrays.hpp"

// Meshes that are too large to compare simplex by simplex: sums of numbers that all of a kind are mixed to.

namespace gale::test {

namespace {

/// What some simplices are mixed to, in any order.
class Sum {
 public:
  template <class... Numbers>
  void add(Numbers... numbers) {
    std::uint64_t mixed = 1;
    for (const auto number : {static_cast<std::uint64_t>(numbers)...}) mixed = (mixed ^ number) * 0x9e3779b97f4a7c15u;
    sum_ += mixed ^ mixed >> 29;
  }

  std::int64_t value() const { return static_cast<std::int64_t>(sum_); }

 private:
  std::uint64_t sum_ = 0;
};

/// The sums of critical points, of critical edges and triangles, of manifolds, and of separatrices of both kinds.
using Sums = std::array<std::int64_t, 5>;

using WholeField = Kokkos::View<const float*, HostMemory>;

Sums sums_on_ranks(const DistributedMesh& mesh, const WholeField& field) {
  const VertexOrder order(mesh, field);
  const auto structure = make_structure(mesh, discrete_gradient_relations);
  Sum points, simplices, manifolds, paths[2];
  const auto critical = find_critical_points(*structure, order);
  for (std::size_t i = 0; i < critical.vertices.size(); ++i)
    points.add(mesh.vertex_id(critical.vertices[i]), static_cast<int>(critical.types[i]), critical.on_surface[i]);
  const auto complex = find_morse_smale_complex(*structure, find_discrete_gradient(*structure, order));
  const Mesh& named_in = complex.excerpt.mesh();
  const auto id = [&](Id v) { return named_in.vertex_id(named_in.vertex_input()(v)); };
  const auto cell_id = [&](Id t) { return named_in.cell_id(named_in.cell_input()(t)); };
  for (std::size_t i = 0; i < complex.critical.edges.size(); ++i) {
    if (complex.owns(1, static_cast<Id>(i)))
      simplices.add(id(complex.critical.edges[i][0]), id(complex.critical.edges[i][1]));
  }
  for (const auto& [high, middle, low] : complex.critical.triangles) simplices.add(id(high), id(middle), id(low));
  const auto down = to_vector(complex.descending_manifold), up = to_vector(complex.ascending_manifold),
             pairs = to_vector(complex.morse_smale_manifold);
  for (const Id v : mesh.owned_vertices()) {
    const Id at = mesh.vertex_input()(v);
    manifolds.add(mesh.vertex_ids()(at), down[at], up[at], pairs[at]);
  }
  for (Id i = 0; i < complex.descending.count(); ++i) {
    const auto& some = complex.descending;
    for (const Id* cell = some.first(i); cell != some.last(i); ++cell)
      paths[0].add(id(complex.critical.edges[some.sources[i]][0]), id(complex.critical.vertices[some.destinations[i]]),
                   cell - some.first(i), id(*cell));
  }
  for (Id i = 0; i < complex.ascending.count(); ++i) {
    const auto& some = complex.ascending;
    for (const Id* cell = some.first(i); cell != some.last(i); ++cell)
      paths[1].add(id(complex.critical.triangles[some.sources[i]][0]),
                   cell_id(complex.critical.cells[some.destinations[i]]), cell - some.first(i), cell_id(*cell));
  }
  Sums sums{points.value(), simplices.value(), manifolds.value(), paths[0].value(), paths[1].value()};
  mesh.exchange().ranks().sum(sums.data(), static_cast<int>(sums.size()));
  return sums;
}

/// Sums on this rank alone, of input ids.
Sums sums_on_one(const io::Dataset& data, const WholeField& field) {
  const Mesh mesh = std::visit([&](const auto& points) { return make_mesh(points, data.tetrahedra); }, data.points);
  const VertexOrder order(mesh, field);
  const auto structure = make_structure(mesh, discrete_gradient_relations);
  Sum points, simplices, manifolds, paths[2];
  const auto critical = find_critical_points(*structure, order);
  for (std::size_t i = 0; i < critical.vertices.size(); ++i)
    points.add(critical.vertices[i], static_cast<int>(critical.types[i]), critical.on_surface[i]);
  const auto complex = find_morse_smale_complex(*structure, find_discrete_gradient(*structure, order));
  const auto& input = mesh.vertex_input();
  for (const auto& [high, low] : complex.critical.edges) simplices.add(input(high), input(low));
  for (const auto& [high, middle, low] : complex.critical.triangles)
    simplices.add(input(high), input(middle), input(low));
  const auto down = to_vector(complex.descending_manifold), up = to_vector(complex.ascending_manifold),
             pairs = to_vector(complex.morse_smale_manifold);
  for (Id v = 0; v < mesh.vertices(); ++v) manifolds.add(v, down[v], up[v], pairs[v]);
  for (int kind = 0; kind < 2; ++kind) {
    const auto& some = kind == 0 ? complex.descending : complex.ascending;
    const auto& numbers = kind == 0 ? input : mesh.cell_input();
    const auto& extrema = kind == 0 ? complex.critical.vertices : complex.critical.cells;
    for (Id i = 0; i < some.count(); ++i) {
      const Id highest =
          kind == 0 ? complex.critical.edges[some.sources[i]][0] : complex.critical.triangles[some.sources[i]][0];
      for (const Id* cell = some.first(i); cell != some.last(i); ++cell)
        paths[kind].add(input(highest), numbers(extrema[some.destinations[i]]), cell - some.first(i), numbers(*cell));
    }
  }
  return {points.value(), simplices.value(), manifolds.value(), paths[0].value(), paths[1].value()};
}

Array<GlobalId, HostMemory> counted(std::int64_t first, std::size_t count) {
  const Array<GlobalId, HostMemory> ids("test", count);
  for (std::size_t i = 0; i < count; ++i) ids(i) = first + static_cast<GlobalId>(i);
  return ids;
}

/// What rank 0 finds alone, on all.
Sums from_rank_0(const Communicator& ranks, const std::function<Sums()>& find) {
  Sums sums{};
  if (ranks.rank() == 0) sums = find();
  ranks.sum(sums.data(), static_cast<int>(sums.size()));
  return sums;
}

}  // namespace

TEST(LargeMeshes, slabs_of_a_grid_have_what_it_has_on_one_rank) {
  const Communicator ranks(MPI_COMM_WORLD, 100000);
  constexpr int n = 40;
  const Sums expected = from_rank_0(ranks, [&] {
    const io::Dataset data = io::make_grid(n);
    return sums_on_one(data, view_of(std::get<std::vector<float>>(data.arrays[0].values)));
  });
  const io::GridPart slab = io::make_grid_part(n, ranks.rank(), ranks.size());
  const auto part = make_part(counted(slab.first_vertex, slab.field.size()), slab.points, slab.tetrahedra,
                              counted(slab.first_tetrahedron, slab.tetrahedra.extent(0)));
  for (const bool repartition : {false, true}) {
    PartitionOptions options;
    options.repartition = repartition;
    EXPECT_EQ(sums_on_ranks(DistributedMesh(ranks, part, options), view_of(slab.field)), expected);
  }
}

TEST(LargeMeshes, a_grid_of_64_has_the_known_counts) {
  const Communicator ranks(MPI_COMM_WORLD);
  const io::GridPart slab = io::make_grid_part(64, ranks.rank(), ranks.size());
  const auto part = make_part(counted(slab.first_vertex, slab.field.size()), slab.points, slab.tetrahedra);
  const DistributedMesh mesh(ranks, part);
  const VertexOrder order(mesh, view_of(slab.field));
  const auto structure = make_structure(mesh, discrete_gradient_relations);
  EXPECT_EQ(find_critical_points(*structure, order).counts, (std::array<GlobalId, 5>{134, 383, 387, 127, 22}));
  EXPECT_EQ(find_discrete_gradient(*structure, order).counts(), (std::array<GlobalId, 4>{134, 356, 263, 40}));
}

class Brains : public testing::TestWithParam<std::string> {};

/// A volume that one rank reads, and that is dealt out: a part of it, or all where GALE_WHOLE_BRAINS is set.
TEST_P(Brains, have_what_they_have_on_one_rank) {
  const std::string file = "/usr/share/mricron/templates/" + GetParam() + ".nii.gz";
  const Communicator ranks(MPI_COMM_WORLD);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file;
#if defined(GALE_ENABLE_VTK)
  io::Dataset data;
  std::vector<float> field;
  if (ranks.rank() == 0) {
    io::ReadOptions options;
    options.above = std::getenv("GALE_WHOLE_BRAINS") != nullptr ? 0 : 110;
    data = io::read(file, options);
    std::visit([&](const auto& values) { field.assign(values.begin(), values.end()); }, data.arrays[0].values);
  } else {
    data.points = io::Dataset::Points<float>("test", 0);
  }
  const Sums expected = from_rank_0(ranks, [&] { return sums_on_one(data, view_of(field)); });
  PartitionOptions options;
  options.repartition = true;
  const auto part =
      std::visit([&](const auto& points) { return make_part(counted(0, points.extent(0)), points, data.tetrahedra); },
                 data.points);
  EXPECT_EQ(sums_on_ranks(DistributedMesh(ranks, part, options), view_of(field)), expected);
#else
  GTEST_SKIP() << "this build reads no files";
#endif
}

INSTANTIATE_TEST_SUITE_P(LargeMeshes, Brains, testing::Values("ch2bet", "inia19-t1-brain"),
                         [](const auto& info) { return info.param.substr(0, info.param.find('-')); });

}  // namespace gale::test
