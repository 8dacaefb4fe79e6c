#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/excerpt/wall_rows.hpp>
#include <gale/algorithms/excerpt/ways_beyond.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/distributed/distributed_mesh.hpp>

#include "support/message_of.hpp"

namespace gale::test {

namespace {

/// A grid of which so many of a hundred points are there at random, none in layers `gap`.
Grid grid_with_holes(const std::array<Id, 3>& points, int percent, const Interval& gap) {
  std::mt19937 random(static_cast<unsigned>(percent + points[0]));
  const std::size_t words = Grid::words_of_row(points[0]);
  const Array<std::uint64_t, HostMemory> inside("test", words * points[1] * points[2]);
  for (Id row = 0; row < points[1] * points[2]; ++row) {
    if (gap.has(points[2] == 1 ? row : row / points[1])) continue;
    for (Id x = 0; x < points[0]; ++x) {
      if (static_cast<int>(random() % 100) < percent) inside(row * words + x / 64) |= std::uint64_t(1) << (x % 64);
    }
  }
  return Grid(points, inside);
}

std::vector<Grid> grids() {
  return {Grid({6, 5, 9}),
          Grid({70, 3, 2}),
          Grid({13, 11, 1}),
          grid_with_holes({9, 8, 12}, 93, {}),
          grid_with_holes({70, 4, 7}, 96, {}),
          grid_with_holes({6, 5, 9}, 97, {3, 5}),
          grid_with_holes({14, 15, 1}, 88, {4, 6})};
}

Id layers_of(const Grid& grid) { return grid.points()[grid.dimension() - 1]; }

/// The first vertex in a layer, or behind the last.
Id first_vertex(const Grid& grid, Id layer) {
  if (layer == layers_of(grid)) return grid.vertices();
  const GridView view = grid.in<HostMemory>();
  return grid.dimension() == 3 ? view.vertex_at(0, 0, layer) : view.vertex_at(0, layer, 0);
}

/// What a rank hands over of a whole grid.
GridLayers layers_of_rank(const Grid& grid, const Ranks& ranks) {
  const auto begin =
      detail::shared_layers(layers_of(grid), ranks.size(), [&](Id at) { return first_vertex(grid, at); });
  GridLayers part{grid.points(), {begin[ranks.rank()], begin[ranks.rank() + 1]}, {}, {}};
  if (grid.is_whole() || part.layers.size() == 0) return part;
  const Id rows = grid.dimension() == 3 ? grid.points()[1] : 1;
  const std::size_t words = Grid::words_of_row(grid.points()[0]) * rows;
  const Id first = std::max(part.layers.first - 1, 0), last = std::min(part.layers.last + 1, layers_of(grid));
  const Array<std::uint64_t, HostMemory> inside("test", words * (last - first));
  for (std::size_t w = 0; w < inside.extent(0); ++w)
    inside(w) = grid.in<HostMemory>().vertices.words[words * first + w];
  part.inside = inside;
  return part;
}

/// Few values: most neighbours have equal ones.
std::vector<float> ties(Id count) {
  std::mt19937 random(7);
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(random() % 4);
  return values;
}

/// The separatrices of a complex: a number for the kind, and the global ids of what they lead through.
using Lines = std::map<std::vector<GlobalId>, std::int64_t>;

Lines lines_of(const MorseSmaleComplex& found) {
  const Mesh& mesh = found.excerpt.mesh();
  const auto vertex = [&](Id v) { return mesh.vertex_id(mesh.vertices_in_input()[v]); };
  Lines lines;
  const auto add = [&](GlobalId kind, const auto& paths, const auto& put) {
    for (Id i = 0; i < paths.count(); ++i) {
      std::vector<GlobalId> line{kind};
      for (const auto* at = paths.first(i); at != paths.last(i); ++at) put(line, *at);
      ++lines[line];
    }
  };
  add(0, found.descending, [&](auto& line, Id v) { line.push_back(vertex(v)); });
  add(1, found.ascending, [&](auto& line, Id t) { line.push_back(mesh.cell_id(mesh.cells_in_input()[t])); });
  add(2, found.connectors, [&](auto& line, const TriangleVertices& triangle) {
    for (const Id v : triangle) line.push_back(vertex(v));
  });
  return lines;
}

/// Pairs by the places of their simplices.
std::vector<std::pair<Id, Id>> as_pairs(const std::vector<PersistencePair>& some) {
  std::vector<std::pair<Id, Id>> pairs;
  for (const auto& [lower, upper] : some) pairs.emplace_back(lower, upper);
  return pairs;
}

}  // namespace

TEST(GridLayersOfRanks, have_the_ids_of_the_whole_grid) {
  const Communicator ranks(MPI_COMM_WORLD, 1000);
  for (const Grid& grid : grids()) {
    const GridLayers part = layers_of_rank(grid, ranks);
    const DistributedMesh mesh(ranks, part);
    EXPECT_EQ(mesh.all_vertices(), grid.vertices());
    EXPECT_EQ(mesh.all_cells(), grid.cells());
    const Interval owned = mesh.owned_vertices();
    const Id first = first_vertex(grid, part.layers.first), last = first_vertex(grid, part.layers.last);
    EXPECT_EQ(owned.size(), last - first);
    const GridView whole = grid.in<HostMemory>();
    int wrong = 0;
    for (Id v = 0; v < mesh.vertices(); ++v) {
      const auto id = static_cast<Id>(mesh.vertex_id(v));
      wrong += owned.has(v) != (id >= first && id < last) || mesh.vertex_of(id) != v ||
               (v > 0 && mesh.vertex_id(v - 1) >= id);
      wrong += mesh.exchange().owner(v) != ranks.rank() && owned.has(v);
    }
    std::vector<bool> held(grid.cells(), false);
    for (Id t = 0; t < mesh.cells(); ++t) {
      const auto id = static_cast<Id>(mesh.cell_id(t));
      const Quad here = mesh.cell_reader()(t), there = whole.cell(id);
      for (int k = 0; k <= grid.dimension(); ++k) wrong += mesh.vertex_id(here[k]) != there[k];
      wrong += mesh.exchange().cell_of(id) != t;
      held[id] = true;
    }
    for (Id t = 0; t < grid.cells(); ++t) {
      bool is_wanted = false;
      for (int k = 0; k <= grid.dimension(); ++k)
        is_wanted = is_wanted || (whole.cell(t)[k] >= first && whole.cell(t)[k] < last);
      wrong += held[t] != is_wanted;
    }
    EXPECT_EQ(wrong, 0);
  }
}

TEST(GridLayersOfRanks, have_the_critical_simplices_of_the_whole_grid) {
  const Communicator ranks(MPI_COMM_WORLD, 1000);
  for (const Grid& grid : grids()) {
    const std::vector<float> all = ties(grid.vertices());
    const GridLayers part = layers_of_rank(grid, ranks);
    const DistributedMesh mesh(ranks, part);
    const Id first = first_vertex(grid, part.layers.first);
    const VertexOrder order(mesh, all.data() + first, mesh.owned_vertices().size());
    const Mesh whole(grid);
    const VertexOrder order_of_all(whole, all.data(), all.size());
    const CriticalPoints found = find_critical_points(order), expected = find_critical_points(order_of_all);
    EXPECT_EQ(found.counts, expected.counts);
    std::size_t at =
        std::lower_bound(expected.vertices.begin(), expected.vertices.end(), first) - expected.vertices.begin();
    for (std::size_t i = 0; i < found.vertices.size(); ++i, ++at) {
      ASSERT_LT(at, expected.vertices.size());
      EXPECT_EQ(mesh.vertex_id(found.vertices[i]), expected.vertices[at]);
      EXPECT_EQ(found.types[i], expected.types[at]);
      EXPECT_EQ(found.on_surface[i], expected.on_surface[at]);
    }
    EXPECT_EQ(find_discrete_gradient(order).counts(), find_discrete_gradient(order_of_all).counts());
  }
}

/// Layers, or rows of a grid of triangles: what is owned. Other vertices may leave some cells out, but have none
/// beside.
TEST(GridLayersOfRanks, know_the_cells_all_of_whose_vertices_they_own) {
  std::mt19937 random(11);
  for (const Grid& grid : grids()) {
    const GridView view = grid.in<HostMemory>();
    const auto within = [&](Id t, const Interval& some) {
      return some.has(view.cell(t).a) && some.has(view.cell(t).d);
    };
    for (Id first = 0; first < layers_of(grid); ++first) {
      for (Id last = first; last <= layers_of(grid); ++last) {
        const Interval some{first_vertex(grid, first), first_vertex(grid, last)}, cells = grid.cells_within(some);
        int wrong = 0;
        for (Id t = 0; t < grid.cells(); ++t) wrong += within(t, some) != cells.has(t);
        EXPECT_EQ(wrong, 0) << first << " to " << last;
      }
      const Id vertex = static_cast<Id>(random() % grid.vertices());
      const Interval some{vertex, static_cast<Id>(vertex + random() % (grid.vertices() - vertex))};
      for (const Id t : grid.cells_within(some)) EXPECT_TRUE(within(t, some)) << t;
    }
  }
}

/// Compares what consumers and kernels lead to. Excerpts are made when they are asked for.
TEST(GridLayersOfRanks, have_the_complex_and_the_pairs_of_the_whole_grid) {
  const Communicator ranks(MPI_COMM_WORLD, 1000);
  for (const Grid& grid : grids()) {
    const std::vector<float> all = ties(grid.vertices());
    const GridLayers part = layers_of_rank(grid, ranks);
    const DistributedMesh mesh(ranks, part);
    const VertexOrder order(mesh, all.data() + first_vertex(grid, part.layers.first), mesh.owned_vertices().size());
    const VertexOrder order_of_all(Mesh(grid), all.data(), all.size());
    const DiscreteGradient gradient_of_all = find_discrete_gradient(order_of_all);
    const MorseSmaleComplex expected = find_morse_smale_complex(gradient_of_all);
    const PersistencePairs expected_pairs = find_persistence_pairs(gradient_of_all);
    for (const DiscreteGradient& gradient :
         {find_discrete_gradient(order), find_discrete_gradient(WorkerSpace(), order)}) {
      const MorseSmaleComplex found = find_morse_smale_complex(gradient);
      const Lines here = lines_of(found), there = lines_of(expected);
      for (const auto& [line, times] : here) EXPECT_EQ(there.count(line), 1u) << testing::PrintToString(line);
      for (const auto& [line, times] : there)
        EXPECT_EQ(ranks.sum(here.count(line) == 0 ? 0 : here.at(line)), times) << testing::PrintToString(line);
      for (Id v = 0; v < mesh.vertices(); ++v) {
        const auto id = static_cast<Id>(mesh.vertex_id(v));
        EXPECT_EQ(found.descending_manifold.in<HostMemory>()(v), expected.descending_manifold.in<HostMemory>()(id));
        EXPECT_EQ(found.ascending_manifold.in<HostMemory>()(v), expected.ascending_manifold.in<HostMemory>()(id));
      }
      const GatheredPairs gathered = gather_persistence_pairs(gradient);
      if (ranks.rank() != 0) continue;
      for (int d = 0; d < 3; ++d) EXPECT_EQ(as_pairs(gathered.pairs.pairs[d]), as_pairs(expected_pairs.pairs[d])) << d;
    }
  }
}

/// Walls that cross parts again and again, and messages that are packed by several threads.
TEST(GridLayersOfRanks, have_the_separatrices_of_the_whole_grid_by_kernels) {
  const Communicator ranks(MPI_COMM_WORLD, 1000);
  const Grid grid({48, 48, 48});
  std::mt19937 random(13);
  std::vector<float> all(grid.vertices());
  for (Id v = 0; v < grid.vertices(); ++v) {
    const double x = v % 48, y = v / 48 % 48, z = v / (48 * 48);
    all[v] = static_cast<float>(std::sin(0.6 * x) * std::cos(0.7 * y) + std::sin(0.9 * z + 0.2 * x) +
                                0.2 * static_cast<double>(random() % 1000) / 1000);
  }
  const GridLayers part = layers_of_rank(grid, ranks);
  const DistributedMesh mesh(ranks, part);
  const VertexOrder order(mesh, all.data() + first_vertex(grid, part.layers.first), mesh.owned_vertices().size());
  const VertexOrder order_of_all(Mesh(grid), all.data(), all.size());
  const DiscreteGradient gradient = find_discrete_gradient(WorkerSpace(), order);
  ASSERT_TRUE(gradient.store().is_from_kernels());
  const Lines expected = lines_of(find_morse_smale_complex(find_discrete_gradient(order_of_all)));
  const Lines found = lines_of(find_morse_smale_complex(gradient));
  for (const auto& [line, times] : found) EXPECT_EQ(expected.count(line), 1u) << "a line of kind " << line[0];
  const auto count_of = [](const Lines& lines) {
    return std::accumulate(lines.begin(), lines.end(), std::int64_t(0),
                           [](std::int64_t sum, const auto& line) { return sum + line.second; });
  };
  EXPECT_EQ(ranks.sum(count_of(found)), count_of(expected));
}

/// What kernels read as the numbers of edges.
std::vector<Offset> numbers_in_kernels(const detail::WallRows& rows, const std::vector<std::array<Id, 2>>& edges) {
  const auto ends = in_memory<WorkerMemory>(Array<const Id, HostMemory>(edges[0].data(), 2 * edges.size()));
  const auto numbers = allocate<Array<Offset, WorkerMemory>>("test", edges.size());
  parallel_for(
      "test", WorkerSpace(), static_cast<Offset>(edges.size()),
      KOKKOS_LAMBDA(Offset i) { numbers(i) = rows.edge(ends(2 * i), ends(2 * i + 1)).number; });
  WorkerSpace().fence();
  return vector_of(numbers);
}

TEST(GridLayersOfRanks, have_a_number_of_its_own_for_each_edge_that_walls_come_to) {
  const Communicator ranks(MPI_COMM_WORLD, 1000);
  const Grid grid({9, 8, 24});
  const std::vector<float> all = ties(grid.vertices());
  const GridLayers part = layers_of_rank(grid, ranks);
  const DistributedMesh mesh(ranks, part);
  const VertexOrder order(mesh, all.data() + first_vertex(grid, part.layers.first), mesh.owned_vertices().size());
  const DiscreteGradient gradient = find_discrete_gradient(WorkerSpace(), order);
  const CellReader cells = mesh.cell_reader();
  const std::uint64_t* const keys = order.keys();
  std::set<std::array<Id, 2>> own, others;
  for (Id t = 0; t < mesh.cells(); ++t) {
    const Quad corners = cells(t);
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 4; ++k) {
        const std::array<Id, 2> edge{corners[i], corners[k]};
        if (keys[edge[0]] > keys[edge[1]]) (mesh.owned_vertices().has(edge[0]) ? own : others).insert(edge);
      }
    }
  }
  detail::WayExits exits;
  exits.edges.assign(others.begin(), others.end());
  const detail::PathSimplices paths(gradient, detail::PathSimplices::Kind::rising_cells);
  const detail::Reached reached = detail::reach_beyond(gradient, paths, exits);
  const detail::WiderGradient wider(gradient, std::make_shared<const detail::WiderSimplices>(gradient, paths, reached),
                                    reached);
  EXPECT_EQ(wider.told_edges().empty(), others.empty());
  const detail::WiderRows there(wider);
  std::vector<std::array<Id, 2>> edges(own.begin(), own.end());
  for (const detail::ToldEdge& edge : wider.told_edges()) edges.push_back({edge.high, edge.low});
  if (edges.empty()) return;
  std::vector<Offset> numbers = numbers_in_kernels(there.rows(), edges);
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end());
  EXPECT_GE(numbers.front(), 0);
  EXPECT_LT(numbers.back(), there.rows().edges());
}

TEST(GridLayersOfRanks, are_refused_where_they_do_not_fit) {
  const Communicator ranks(MPI_COMM_WORLD);
  const auto error = [&](const GridLayers& part) { return message_of([&] { DistributedMesh mesh(ranks, part); }); };
  GridLayers part = layers_of_rank(Grid({3, 3, 5}), ranks);
  part.layers.first = part.layers.last = 0;
  EXPECT_EQ(error(part), "ranks hand over 0 layers of a grid of 5");
  part.layers.last = 5;
  if (ranks.size() > 1) {
    EXPECT_EQ(error(part), "rank 1 hands over the layers from 0 to before 5, where those from 5 on are next");
  }
  part.points = {1, 3, 5};
  EXPECT_EQ(error(part), "a grid of 1 x 3 x 5 points has no cells");
  if (ranks.size() > 1) {
    part.points = {3 + ranks.rank(), 3, 5};
    EXPECT_EQ(error(part), "ranks hand over layers of grids of different extents");
  }
  part = layers_of_rank(Grid({3, 3, 5}), ranks);
  const Id held = std::min(part.layers.last + 1, 5) - std::max(part.layers.first - 1, 0);
  part.inside = Array<std::uint64_t, HostMemory>("test", part.layers.size() == 0 ? 0 : 3 * held);
  if (ranks.size() < 6) EXPECT_EQ(error(part), "the mesh has no cells");
  if (part.layers.has(0)) {
    const Array<std::uint64_t, HostMemory> one("test", 3 * held);
    one(0) = 1;
    part.inside = one;
  }
  EXPECT_NE(error(part).find("layer 0 has 1 vertices, of which cubes of vertices use 0"), std::string::npos);
  PartitionOptions options;
  options.most_local = 20;
  EXPECT_NE(message_of([&] {
              DistributedMesh mesh(ranks, layers_of_rank(Grid({3, 3, 40}), ranks), options);
            }).find("vertices"),
            std::string::npos);
}

}  // namespace gale::test
