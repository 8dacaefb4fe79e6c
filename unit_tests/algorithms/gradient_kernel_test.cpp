#include <algorithm>

#include <gtest/gtest.h>

#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/algorithms/gradient/lower_star.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/parallel.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_gradient.hpp"
#include "algorithms/fields.hpp"
#include "support/arrays.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"
#include "support/voxel_shapes.hpp"

namespace gale::test {

/// The VV and link rows of all vertices, and their order.
template <class Memory>
struct WholeRows {
  Array<const Id, Memory> neighbours_begin, neighbours, link_begin;
  Array<const std::uint8_t, Memory> link;
  Array<const std::uint64_t, Memory> keys;
};

/// What a vertex's lower star is paired to: how many words of bits it took (0: too many for bits), how many steps, and
/// for each the facet (-1: the cell is critical) and the cell. Cells are three places in the VV row, in a byte each.
struct PairedStar {
  static constexpr int max_steps = 128;
  static constexpr int size = 2 + 2 * max_steps;
};

/// Pairs the lower star of a vertex, on the device or on the host. A functor, since nvcc forbids device lambdas in many
/// places.
template <class Memory>
struct PairStarOfVertex {
  WholeRows<Memory> rows;
  Array<Id, Memory> result;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id vertex = static_cast<Id>(i);
    Id* const out = result.data() + PairedStar::size * i;
    detail::LowerNeighbours lower;
    const Id begin = rows.neighbours_begin(vertex), end = rows.neighbours_begin(vertex + 1);
    const bool fits = lower.find(rows.keys.data(), vertex, Row{rows.neighbours.data() + begin, end - begin});
    if (!fits || (!pair<1>(vertex, lower, out) && !pair<2>(vertex, lower, out))) out[0] = 0;
  }

 private:
  template <int Words>
  KOKKOS_FUNCTION bool pair(Id vertex, const detail::LowerNeighbours& lower, Id* out) const {
    const Id begin = rows.link_begin(vertex), end = rows.link_begin(vertex + 1);
    using Star = detail::LowerStar<Words, have_device>;
    Star star;
    if (!star.build(lower, LinkRow{rows.link.data() + 3 * begin, end - begin, 1})) return false;
    out[0] = Words;
    out[1] = 0;
    if (lower.count() == 0) return true;
    const auto code = [&](int cell) {
      Id places = 0;
      for (int corner = 0; corner < 3; ++corner) {
        const Id place = corner < star.dimension(cell) ? lower.place(lower.with_rank(star.corners(cell)[corner])) : 255;
        places |= place << 8 * corner;
      }
      return places;
    };
    const auto add = [&](Id facet, Id cell) {
      out[2 + 2 * out[1]] = facet;
      out[3 + 2 * out[1]] = cell;
      ++out[1];
    };
    add(0xffffff, code(0));
    detail::pair_cells(
        detail::BitQueues<Star>(star), [&](int facet, int cell) { add(code(facet), code(cell)); },
        [&](int cell) { add(-1, code(cell)); });
    return true;
  }
};

namespace {

struct HostRows {
  std::vector<Id> neighbours_begin = {0}, neighbours, link_begin = {0};
  std::vector<std::uint8_t> link;  // places; those of stars that bits hold take no more
  std::vector<std::uint64_t> keys;

  HostRows(const Mesh& mesh, const std::vector<double>& field) {
    const auto runtime = make_structure(mesh, Relation::VV | link_form);
    SweepOptions options;
    options.threads = 1;
    std::vector<std::vector<Id>> vv(mesh.vertices());
    std::vector<std::vector<std::uint8_t>> links(mesh.vertices());
    runtime->for_each_segment(Relation::VV | link_form, options, [&](int, const SegmentRows& rows) {
      for (const Id v : rows.interval(0)) {
        const Row row = rows[Relation::VV][v];
        vv[v].assign(row.begin(), row.end());
        const LinkRow star = rows.links()[v];
        for (Id t = 0; t < star.size(); ++t) {
          for (int corner = 0; corner < 3; ++corner) links[v].push_back(static_cast<std::uint8_t>(star(t, corner)));
        }
      }
    });
    for (Id v = 0; v < mesh.vertices(); ++v) {
      neighbours.insert(neighbours.end(), vv[v].begin(), vv[v].end());
      link.insert(link.end(), links[v].begin(), links[v].end());
      neighbours_begin.push_back(static_cast<Id>(neighbours.size()));
      link_begin.push_back(static_cast<Id>(link.size()) / 3);
    }
    const VertexOrder order(mesh, field.data(), field.size());
    keys.assign(order.keys(), order.keys() + mesh.vertices());
  }

  template <class T>
  static Array<const T, HostMemory> on_the_host(const std::vector<T>& values) {
    const Array<T, HostMemory> array("test", values.size());
    std::copy(values.begin(), values.end(), array.data());
    return array;
  }
};

/// In WorkerSpace.
std::vector<Id> paired_in_a_kernel(const HostRows& rows) {
  const PairStarOfVertex<WorkerMemory> pair = {{to_worker(rows.neighbours_begin), to_worker(rows.neighbours),
                                                to_worker(rows.link_begin), to_worker(rows.link), to_worker(rows.keys)},
                                               Array<Id, WorkerMemory>("pairs", rows.keys.size() * PairedStar::size)};
  Kokkos::parallel_for("test_pair_stars",
                       Kokkos::RangePolicy<WorkerSpace, Kokkos::IndexType<Offset>>(0, rows.keys.size()), pair);
  Kokkos::fence();
  return to_vector(pair.result);
}

std::vector<Id> paired_on_the_host(const HostRows& rows) {
  const PairStarOfVertex<HostMemory> pair = {
      {rows.on_the_host(rows.neighbours_begin), rows.on_the_host(rows.neighbours), rows.on_the_host(rows.link_begin),
       rows.on_the_host(rows.link), rows.on_the_host(rows.keys)},
      Array<Id, HostMemory>("pairs", rows.keys.size() * PairedStar::size)};
  for (std::size_t v = 0; v < rows.keys.size(); ++v) pair(static_cast<Offset>(v));
  return to_vector(pair.result);
}

/// A cell of a vertex's star in input ids.
Simplex simplex_of(const Mesh& mesh, const HostRows& rows, Id vertex, Id places) {
  Simplex simplex = {mesh.vertex_input()(vertex)};
  for (int corner = 0; corner < 3; ++corner) {
    const Id place = places >> 8 * corner & 255;
    if (place != 255) simplex.push_back(mesh.vertex_input()(rows.neighbours[rows.neighbours_begin[vertex] + place]));
  }
  std::sort(simplex.begin(), simplex.end());
  return simplex;
}

}  // namespace

class GradientKernelOf : public testing::TestWithParam<std::string> {};

TEST_P(GradientKernelOf, every_mesh_pairs_what_the_host_and_brute_force_pair) {
  const InputMesh& input = mesh_named(GetParam());
  const Mesh mesh = encode(input, 7);
  const auto fields = fields_on(input);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    SCOPED_TRACE(fields[i].name);
    const HostRows rows(mesh, fields[i].values);
    const auto paired = paired_in_a_kernel(rows);
    ASSERT_EQ(paired, paired_on_the_host(rows));
    const BruteForceGradient& brute_force = brute_force_gradients(GetParam())[i];
    for (Id v = 0; v < mesh.vertices(); ++v) {
      const Id* const star = paired.data() + PairedStar::size * v;
      if (star[0] == 0) continue;
      for (Id step = 0; step < star[1]; ++step) {
        const Simplex cell = simplex_of(mesh, rows, v, star[3 + 2 * step]);
        if (star[2 + 2 * step] < 0) {
          EXPECT_EQ(brute_force.critical[cell.size() - 1].count(cell), 1u) << "vertex " << v << ", step " << step;
        } else {
          const auto partner = brute_force.partner.find(cell);
          ASSERT_NE(partner, brute_force.partner.end()) << "vertex " << v << ", step " << step;
          EXPECT_EQ(partner->second, simplex_of(mesh, rows, v, star[2 + 2 * step]))
              << "vertex " << v << ", step " << step;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, GradientKernelOf, testing::ValuesIn(mesh_names()),
                         [](const auto& info) { return info.param; });

/// No vertex of it has more than 14 neighbours and 24 tetrahedra; a star with all of them takes more than one word.
TEST(GradientKernel, pairs_every_simplex_of_a_grid_in_stars_of_one_and_of_two_words) {
  const InputMesh input = ball(6);
  const Mesh mesh = encode(input, 50);
  const auto paired = paired_in_a_kernel(HostRows(mesh, random_field(input, 3)));
  std::array<int, 3> words{};
  std::size_t cells = 0;
  for (Id v = 0; v < mesh.vertices(); ++v) {
    const Id* const star = paired.data() + PairedStar::size * v;
    ++words.at(star[0]);
    if (star[1] == 0) ++cells;  // a minimum
    for (Id step = 0; step < star[1]; ++step) cells += star[2 + 2 * step] < 0 ? 1 : 2;
  }
  EXPECT_EQ(words[0], 0);
  EXPECT_GT(words[1], 0);
  EXPECT_GT(words[2], 0);
  const BruteForce brute_force(input);
  std::size_t simplices = 0;
  for (const int dimension : {0, 1, 2, 3}) simplices += brute_force.simplices(dimension).size();
  EXPECT_EQ(cells, simplices);
}

}  // namespace gale::test
