#include <array>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/algorithms/surface_vertices.hpp>
#include <gale/outputs/analyses.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/relation_of.hpp>

#include "support/arrays.hpp"
#include "support/message_of.hpp"

/// A grid that computes gives what its cells give, written out.
namespace gale::test {

namespace {

/// A grid of points with a number each; a cube is there where those of its corners are above 0. Its cells come from
/// here, without any of the library's.
struct GridCase {
  std::string name;
  std::array<Id, 3> points;
  std::vector<float> values{};  ///< of all points

  bool is_plane() const { return points[2] == 1; }
  Id place(Id x, Id y, Id z) const { return (z * points[1] + y) * points[0] + x; }

  /// Whether the cube is there of which this is the lowest corner.
  bool has_cube(Id x, Id y, Id z) const {
    if (x + 1 >= points[0] || y + 1 >= points[1] || (!is_plane() && z + 1 >= points[2])) return false;
    for (int corner = 0; corner < (is_plane() ? 4 : 8); ++corner) {
      if (!(values[place(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2))] > 0)) return false;
    }
    return true;
  }
};

/// Its points, field and cells, in the order that is promised.
struct Written {
  io::Dataset dataset;
  std::vector<std::vector<Id>> cells;
};

std::vector<std::vector<std::array<Id, 3>>> walks_of(bool is_plane) {
  if (is_plane) return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  std::vector<std::vector<std::array<Id, 3>>> walks;
  std::array<Id, 3> axes = {0, 1, 2};
  do {
    std::vector<std::array<Id, 3>> walk = {{0, 0, 0}};
    for (const Id axis : axes) {
      walk.push_back(walk.back());
      ++walk.back()[axis];
    }
    walks.push_back(walk);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return walks;
}

Written write_out(const GridCase& grid) {
  std::vector<std::vector<Id>> cells_of_places;
  std::map<Id, Id> vertex;  // by place: in the order of these
  for (Id z = 0; z < grid.points[2]; ++z) {
    for (Id y = 0; y < grid.points[1]; ++y) {
      for (Id x = 0; x < grid.points[0]; ++x) {
        if (!grid.has_cube(x, y, z)) continue;
        for (const auto& walk : walks_of(grid.is_plane())) {
          std::vector<Id> cell;
          for (const auto& step : walk) cell.push_back(grid.place(x + step[0], y + step[1], z + step[2]));
          for (const Id place : cell) vertex[place] = 0;
          cells_of_places.push_back(cell);
        }
      }
    }
  }
  Written written;
  std::vector<float> field;
  const io::Dataset::Points<float> points("points", vertex.size());
  Id count = 0;
  for (auto& [place, id] : vertex) {
    id = count++;
    field.push_back(grid.values[place]);
    points(id, 0) = static_cast<float>(place % grid.points[0]);
    points(id, 1) = static_cast<float>(place / grid.points[0] % grid.points[1]);
    points(id, 2) = static_cast<float>(place / grid.points[0] / grid.points[1]);
  }
  written.dataset.points = points;
  written.dataset.arrays.push_back({"field", 1, field});
  const std::size_t cells = cells_of_places.size();
  if (grid.is_plane()) {
    written.dataset.triangles = decltype(io::Dataset::triangles)("triangles", cells);
  } else {
    written.dataset.tetrahedra = decltype(io::Dataset::tetrahedra)("tetrahedra", cells);
  }
  for (std::size_t t = 0; t < cells; ++t) {
    for (Id& place : cells_of_places[t]) place = vertex.at(place);
    for (std::size_t k = 0; k < cells_of_places[t].size(); ++k) {
      (grid.is_plane() ? written.dataset.triangles(t, k) : written.dataset.tetrahedra(t, k)) = cells_of_places[t][k];
    }
  }
  written.cells = cells_of_places;
  return written;
}

/// The bits of the points above 0.
Array<std::uint64_t, HostMemory> inside(const GridCase& grid) {
  const std::size_t words = Grid::words_of_row(grid.points[0]);
  const Array<std::uint64_t, HostMemory> bits("inside", words * grid.points[1] * grid.points[2]);
  for (Id row = 0; row < grid.points[1] * grid.points[2]; ++row) {
    for (Id x = 0; x < grid.points[0]; ++x) {
      if (grid.values[row * grid.points[0] + x] > 0) bits(row * words + x / 64) |= std::uint64_t(1) << (x % 64);
    }
  }
  return bits;
}

Mesh mesh_of(const Written& written, int capacity) {
  const auto points = std::get<io::Dataset::Points<float>>(written.dataset.points);
  const auto segmentation = octree_segmentation(Points<float, HostMemory>(points), capacity);
  return written.dataset.dimension() == 3 ? Mesh(Tetrahedra<Id, HostMemory>(written.dataset.tetrahedra), segmentation)
                                          : Mesh(Triangles<Id, HostMemory>(written.dataset.triangles), segmentation);
}

/// Values above 0 for about so many of a hundred points, 0 for the others; `levels` different ones, so that many tie.
GridCase random_case(const std::string& name, const std::array<Id, 3>& points, int percent, int levels) {
  GridCase grid{name, points};
  std::mt19937 random(static_cast<unsigned>(points[0] + 31 * points[1] + 997 * points[2] + percent));
  for (Id i = 0; i < points[0] * points[1] * points[2]; ++i) {
    const bool is_inside = static_cast<int>(random() % 100) < percent;
    const auto value = static_cast<float>(1 + random() % levels);
    grid.values.push_back(is_inside ? value : 0.0F);
  }
  return grid;
}

std::vector<GridCase> cases() {
  std::vector<GridCase> all;
  const std::array<Id, 3> sizes[] = {{2, 2, 2}, {6, 5, 4}, {2, 7, 6}, {7, 2, 6},  {6, 7, 2},  {67, 3, 3},
                                     {9, 8, 7}, {2, 2, 1}, {8, 7, 1}, {67, 4, 1}, {3, 130, 1}};
  for (const auto& size : sizes) {
    const std::string name =
        std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
    all.push_back(random_case(name + ", all", size, 100, 100000));
    all.push_back(random_case(name + ", all, of few values", size, 100, 3));
    all.push_back(random_case(name + ", holes", size, 92, 1000));
    all.push_back(random_case(name + ", pinches", size, 75, 1000));
  }
  // Two cubes that meet in an edge, two in a corner, and one far from others.
  for (const auto& [at_x, at_y, at_z] : {std::array<Id, 3>{1, 1, 0}, {1, 1, 1}, {130, 1, 1}}) {
    GridCase grid = random_case("two cubes", {at_x + 2, at_y + 2, at_z + 2}, 0, 1);
    for (int corner = 0; corner < 8; ++corner) {
      const Id x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
      grid.values[grid.place(x, y, z)] = static_cast<float>(1 + corner * 5 % 8);
      grid.values[grid.place(at_x + x, at_y + y, at_z + z)] = static_cast<float>(2 + corner * 3 % 8);
    }
    all.push_back(grid);
  }
  return all;
}

void expect_equal(const io::PointArray& one, const io::PointArray& other) {
  EXPECT_EQ(one.name, other.name);
  EXPECT_EQ(one.components, other.components);
  EXPECT_TRUE(one.values == other.values) << one.name;
}

void expect_equal(const std::vector<io::PointArray>& some, const std::vector<io::PointArray>& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t i = 0; i < some.size(); ++i) expect_equal(some[i], others[i]);
}

void expect_equal(const io::Dataset::Positions& some, const io::Dataset::Positions& others) {
  ASSERT_EQ(some.index(), others.index());
  std::visit(
      [&](const auto& points) {
        const auto& expected = std::get<std::decay_t<decltype(points)>>(others);
        ASSERT_EQ(points.extent(0), expected.extent(0));
        for (std::size_t i = 0; i < points.extent(0); ++i) {
          for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(points(i, axis), expected(i, axis));
        }
      },
      some);
}

void expect_equal(const outputs::Outcome& found, const outputs::Outcome& expected) {
  ASSERT_EQ(found.index(), expected.index());
  if (const auto* const points = std::get_if<io::PointSet>(&found)) {
    const auto& other = std::get<io::PointSet>(expected);
    expect_equal(points->points, other.points);
    expect_equal(points->arrays, other.arrays);
  } else if (const auto* const surface = std::get_if<io::Surface>(&found)) {
    const auto& other = std::get<io::Surface>(expected);
    expect_equal(surface->points, other.points);
    expect_equal(surface->point_arrays, other.point_arrays);
    expect_equal(surface->cell_arrays, other.cell_arrays);
    EXPECT_EQ(surface->lines.begin, other.lines.begin);
    EXPECT_EQ(surface->lines.points, other.lines.points);
    EXPECT_EQ(surface->polygons.begin, other.polygons.begin);
    EXPECT_EQ(surface->polygons.points, other.polygons.points);
  } else if (const auto* const diagram = std::get_if<std::vector<outputs::DiagramPoint>>(&found)) {
    const auto& other = std::get<std::vector<outputs::DiagramPoint>>(expected);
    ASSERT_EQ(diagram->size(), other.size());
    const auto all_of = [](const outputs::DiagramPoint& p) {
      return std::make_tuple(p.type, p.is_finite, p.begin, p.end, p.birth, p.death, p.begin_type, p.end_type);
    };
    for (std::size_t i = 0; i < other.size(); ++i) EXPECT_EQ(all_of((*diagram)[i]), all_of(other[i])) << i;
  } else if (const auto* const arrays = std::get_if<std::vector<io::PointArray>>(&found)) {
    expect_equal(*arrays, std::get<std::vector<io::PointArray>>(expected));
  } else {
    EXPECT_EQ(std::get<Id>(found), std::get<Id>(expected));
  }
}

std::map<std::string, outputs::Outcome> run(const outputs::Analysis& analysis, const Written& written, const Mesh& mesh,
                                            const outputs::Settings& settings, Way way) {
  const io::PointArray& field = written.dataset.arrays.front();
  const auto& values = std::get<std::vector<float>>(field.values);
  const VertexOrder order(mesh, values.data(), values.size());
  const auto next = [&](const char*, double, double) {
    ComputeOptions options;
    options.structure.way = way;
    options.threads = 2;
    return options;
  };
  return analysis.run({written.dataset, field, order, next}, settings);
}

/// The defaults; all that a mesh of that dimension can be asked for; and each word of each choice.
std::vector<outputs::Settings> settings_of(const outputs::Analysis& analysis, int dimension) {
  using Kind = outputs::AnalysisOption::Kind;
  std::vector<outputs::Settings> all(2);
  for (const auto& option : analysis.options) {
    if (option.kind == Kind::flag && (dimension == 3 || option.name != "separatrices2"))
      all[1].flags[option.name] = true;
    if (option.kind == Kind::threshold) all[1].thresholds[option.name] = {20, true};
    for (const std::string& word : option.choices) {
      all.emplace_back();
      all.back().choices[option.name] = word;
    }
  }
  return all;
}

}  // namespace

TEST(Grids, number_vertices_and_cells_as_written_out_in_the_order_of_places) {
  for (const GridCase& one : cases()) {
    SCOPED_TRACE(one.name);
    const Written written = write_out(one);
    const Grid grid(one.points, inside(one));
    ASSERT_EQ(static_cast<std::size_t>(grid.cells()), written.cells.size());
    if (grid.cells() == 0) continue;
    const Mesh mesh(grid, 5);
    ASSERT_EQ(static_cast<std::size_t>(mesh.vertices()),
              std::get<std::vector<float>>(written.dataset.arrays.front().values).size());
    EXPECT_EQ(mesh.dimension(), one.is_plane() ? 2 : 3);
    const CellReader cell = mesh.cell_reader();
    const EncodedMesh<HostMemory>& encoded = mesh.encoded();
    for (Id t = 0; t < mesh.cells(); ++t) {
      const std::vector<Id>& expected = written.cells[t];
      const Quad quad{expected[0], expected[1], expected[2], expected.back()};
      ASSERT_TRUE(cell(t) == quad) << t;
      ASSERT_TRUE(encoded.cell(t) == quad) << t;
    }
    std::vector<Id> first(mesh.segments() + 1, mesh.cells());
    for (Id t = mesh.cells(); t-- > 0;) first[mesh.segment_of(0, written.cells[t][0])] = t;
    for (Id s = mesh.segments(); s-- > 0;) first[s] = std::min(first[s], first[s + 1]);
    for (Id s = 0; s <= mesh.segments(); ++s) ASSERT_EQ(mesh.interval_begin(mesh.dimension())(s), first[s]) << s;
  }
}

TEST(Grids, have_the_relations_of_what_is_written_out) {
  for (const GridCase& one : cases()) {
    SCOPED_TRACE(one.name);
    const Written written = write_out(one);
    if (written.cells.empty()) continue;
    const Mesh expected = mesh_of(written, 8), mesh(Grid(one.points, inside(one)), 11);
    for (const Relation relation : members_of(relations_of_dimension(mesh.dimension()))) {
      SCOPED_TRACE(name_of(relation));
      const auto rows = relation_of(mesh, relation, Ids::input), others = relation_of(expected, relation, Ids::input);
      EXPECT_EQ(to_vector(rows.offsets), to_vector(others.offsets));
      EXPECT_EQ(to_vector(rows.entries), to_vector(others.entries));
    }
  }
}

TEST(Grids, number_edges_and_triangles_in_the_order_of_all) {
  for (const GridCase& one : cases()) {
    SCOPED_TRACE(one.name);
    if (write_out(one).cells.empty()) continue;
    const Mesh mesh(Grid(one.points, inside(one)), 11);
    NamedSimplices named;
    const auto edges = relation_of(mesh, Relation::EV, Ids::input),
               triangles = relation_of(mesh, Relation::FV, Ids::input);
    for (Offset e = 0; e + 1 < Offset(edges.offsets.extent(0)); ++e)
      named.edges.push_back({edges.row(e)[e % 2], edges.row(e)[1 - e % 2]});
    for (Offset f = 0; mesh.dimension() == 3 && f + 1 < Offset(triangles.offsets.extent(0)); ++f)
      named.triangles.push_back(
          {triangles.row(f)[f % 3], triangles.row(f)[(f + 1) % 3], triangles.row(f)[(f + 2) % 3]});
    const SimplexNumbers numbers = number_simplices(mesh, named);
    for (std::size_t e = 0; e < named.edges.size(); ++e) ASSERT_EQ(numbers.edges[e], GlobalId(e));
    for (std::size_t f = 0; f < named.triangles.size(); ++f) ASSERT_EQ(numbers.triangles[f], GlobalId(f));
    const auto on_surface = surface_vertices(mesh);
    for (Id v = 0; v < mesh.vertices(); ++v) ASSERT_EQ(numbers.on_surface(v), on_surface(v)) << v;
    const auto refusal = [&](const NamedSimplices& wrong) {
      return message_of([&] { number_simplices(mesh, wrong); });
    };
    EXPECT_EQ(refusal({{{1, 1}}, {}}), "no simplex of the mesh has just the input vertices 1 1");
    EXPECT_EQ(refusal({{{0, mesh.vertices()}}, {}}), "no vertex " + std::to_string(mesh.vertices()) +
                                                         " to number a simplex of: there are " +
                                                         std::to_string(mesh.vertices()));
    NamedSimplices last_is_wrong{std::vector<std::array<Id, 2>>(40, named.edges.front()), {}};
    last_is_wrong.edges.push_back({named.edges.front()[0], -1});
    EXPECT_EQ(refusal(last_is_wrong),
              "no vertex -1 to number a simplex of: there are " + std::to_string(mesh.vertices()));
    if (mesh.dimension() == 3)
      EXPECT_EQ(refusal({{}, {{2, 0, 2}}}), "no simplex of the mesh has just the input vertices 0 2 2");
  }
}

TEST(Grids, have_the_links_of_what_is_written_out_in_all_ways) {
  for (const GridCase& one : cases()) {
    SCOPED_TRACE(one.name);
    const Written written = write_out(one);
    if (written.cells.empty()) continue;
    const Mesh mesh(Grid(one.points, inside(one)), 64);
    // In the order of places, as the grid is: with given segments GALE's ids are the input's.
    const std::vector<std::int64_t> labels(mesh.vertices(), 0);
    const Segmentation segmentation =
        given_segmentation(Array<const std::int64_t, HostMemory>(labels.data(), labels.size()));
    const Mesh expected = mesh.dimension() == 3
                              ? Mesh(Tetrahedra<Id, HostMemory>(written.dataset.tetrahedra), segmentation)
                              : Mesh(Triangles<Id, HostMemory>(written.dataset.triangles), segmentation);
    const RelationSet stars = star_relations_of(mesh.dimension());
    const auto rows_of = [&](const Mesh& of, Way way) {
      StructureOptions options;
      options.way = way;
      std::vector<std::vector<Id>> all(3 * of.vertices());
      make_structure(of, stars, options)->for_each_segment(stars, {}, [&](int, const SegmentRows& rows) {
        for (const Id v : rows.interval(Relation::VV)) {
          const Row neighbours = rows[Relation::VV][v], cells = rows[vertex_cells(of.dimension())][v];
          const LinkRow link = rows.links()[v];
          all[3 * v].assign(neighbours.begin(), neighbours.end());
          all[3 * v + 1].assign(cells.begin(), cells.end());
          for (Id t = 0; t < link.size(); ++t) {
            for (int k = 0; k < of.dimension(); ++k) all[3 * v + 2].push_back(link(t, k));
          }
        }
      });
      return all;
    };
    const auto all = rows_of(expected, Way::inline_);
    for (const Way way : {Way::inline_, Way::helpers, Way::leaders}) EXPECT_EQ(rows_of(mesh, way), all) << name_of(way);
  }
}

TEST(Grids, give_the_results_of_what_is_written_out) {
  for (const GridCase& one : cases()) {
    SCOPED_TRACE(one.name);
    const Written written = write_out(one);
    if (written.cells.empty()) continue;
    const Mesh expected = mesh_of(written, 8), mesh(Grid(one.points, inside(one)), 10);
    for (const outputs::Analysis& analysis : outputs::analyses()) {
      SCOPED_TRACE(analysis.name);
      for (const outputs::Settings& settings : settings_of(analysis, mesh.dimension())) {
        const auto others = run(analysis, written, expected, settings, Way::inline_);
        const bool by_default = settings.flags.empty() && settings.choices.empty();
        for (const Way way : by_default ? std::vector{Way::gale, Way::leaders} : std::vector{Way::gale}) {
          const auto found = run(analysis, written, mesh, settings, way);
          ASSERT_EQ(found.size(), others.size());
          for (const auto& [name, outcome] : others) {
            SCOPED_TRACE(name);
            expect_equal(found.at(name), outcome);
          }
        }
      }
    }
  }
}

/// By bits where all cubes are there, by rows elsewhere; as kernels do it, and as it is done with any mesh's rows.
TEST(Grids, have_the_gradient_that_rows_give) {
  for (const GridCase& one : cases()) {
    SCOPED_TRACE(one.name);
    const Grid grid(one.points, inside(one));
    if (grid.cells() == 0) continue;
    const Mesh mesh(grid, 10);
    const Written written = write_out(one);
    const auto& field = std::get<std::vector<float>>(written.dataset.arrays.front().values);
    const VertexOrder order(mesh, field.data(), field.size());
    StructureOptions rows;
    rows.way = Way::inline_;
    const auto structure = make_structure(mesh, discrete_gradient_relations_of(mesh.dimension()), rows);
    const DiscreteGradient expected = find_discrete_gradient(*structure, order);
    const auto pairs_of = [&](const DiscreteGradient& gradient) {
      std::map<std::pair<Id, Id>, Id> pairs;
      for (Id v = 0; v < mesh.vertices(); ++v)
        gradient.for_each_edge_pair(v, [&](Id low, Id third) { pairs[{v, low}] = third; });
      return pairs;
    };
    for (const DiscreteGradient& found :
         {find_discrete_gradient(order), find_discrete_gradient(WorkerSpace(), order, DeviceSweepOptions())}) {
      EXPECT_EQ(to_vector(found.vertex_successors()), to_vector(expected.vertex_successors()));
      EXPECT_EQ(to_vector(found.cell_successors()), to_vector(expected.cell_successors()));
      EXPECT_EQ(pairs_of(found), pairs_of(expected));
      EXPECT_EQ(found.critical().vertices, expected.critical().vertices);
      EXPECT_EQ(found.critical().edges, expected.critical().edges);
      EXPECT_EQ(found.critical().triangles, expected.critical().triangles);
      EXPECT_EQ(found.critical().cells, expected.critical().cells);
      EXPECT_EQ(found.critical().star, expected.critical().star);
    }
  }
}

TEST(Grids, refuse_what_has_no_cells) {
  EXPECT_EQ(message_of([] { Grid({1, 5, 5}); }), "a grid of 1 x 5 x 5 points has no cells");
  EXPECT_EQ(message_of([] { Grid({2, 2, 0}); }), "a grid of 2 x 2 x 0 points has no cells");
  EXPECT_EQ(message_of([] {
              Grid({2000, 2000, 2000});
            }),
            "a grid of 2000 x 2000 x 2000 points has more vertices or cells than the 2147483647 that 32-bit ids can "
            "number");
  const Array<std::uint64_t, HostMemory> nothing("inside", 9);
  EXPECT_EQ(message_of([&] { Mesh(Grid({3, 3, 3}, nothing)); }), "the mesh has no tetrahedra");
  EXPECT_EQ(message_of([&] { Grid({3, 3, 4}, nothing); }), "the points of a grid have 9 words of bits, not 12");
  nothing(4) = 8;
  EXPECT_EQ(message_of([&] { Grid({3, 3, 3}, nothing); }), "row 4 of a grid has bits behind its 3 points");
  EXPECT_EQ(message_of([] { Mesh(Grid({2, 2, 2}), 0); }), "segments of at most 0 vertices hold none");
}

}  // namespace gale::test
