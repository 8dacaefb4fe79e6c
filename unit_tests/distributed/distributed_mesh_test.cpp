#include <algorithm>
#include <map>
#include <set>

#include <gale/io/synthetic.hpp>

#include "distributed/every_partition.hpp"
#include "support/arrays.hpp"

namespace gale::test {

class DistributedMeshOf : public EveryPartition {};

TEST_P(DistributedMeshOf, every_partition_has_each_vertex_owned_once) {
  const std::vector<bool> mine = owned();
  for (Id v = 0; v < input().vertices(); ++v) EXPECT_EQ(ranks_.sum(mine[v] ? 1 : 0), 1) << "vertex " << v;
  EXPECT_EQ(mesh_.all_vertices(), input().vertices());
  EXPECT_EQ(mesh_.all_cells(), static_cast<GlobalId>(input().tetrahedra.size()));
}

TEST_P(DistributedMeshOf, every_partition_holds_the_stars_of_owned_vertices_and_no_more) {
  const std::vector<bool> mine = owned();
  std::set<Id> cells, vertices;
  for (Id v = 0; v < input().vertices(); ++v) {
    if (mine[v]) vertices.insert(v);
  }
  for (Id t = 0; t < static_cast<Id>(input().tetrahedra.size()); ++t) {
    const auto& quad = input().tetrahedra[t];
    if (std::none_of(quad.begin(), quad.end(), [&](Id v) { return mine[v]; })) continue;
    cells.insert(t);
    vertices.insert(quad.begin(), quad.end());
  }
  const Mesh& local = mesh_;
  EXPECT_EQ(local.vertices(), static_cast<Id>(vertices.size()));
  ASSERT_EQ(local.cells(), static_cast<Id>(cells.size()));
  std::set<Id> found_vertices, found_cells;
  for (Id v = 0; v < local.vertices(); ++v) found_vertices.insert(input_vertex(v));
  for (Id t = 0; t < local.cells(); ++t) {
    const Id there = input_cell(t);
    found_cells.insert(there);
    std::set<Id> corners;
    for (int corner = 0; corner < 4; ++corner) corners.insert(input_vertex(local.encoded().cells(t, corner)));
    EXPECT_EQ(corners, std::set<Id>(input().tetrahedra[there].begin(), input().tetrahedra[there].end()));
  }
  EXPECT_EQ(found_vertices, vertices);
  EXPECT_EQ(found_cells, cells);
}

TEST_P(DistributedMeshOf, every_partition_numbers_by_global_ids_and_owned_vertices_first) {
  const auto& ids = mesh_.vertex_ids();
  EXPECT_TRUE(std::is_sorted(ids.data(), ids.data() + ids.extent(0)));
  const auto& cells = mesh_.cell_ids();
  EXPECT_TRUE(std::is_sorted(cells.data(), cells.data() + cells.extent(0)));
  const Mesh& local = mesh_;
  for (Id v = 0; v < local.vertices(); ++v) {
    EXPECT_EQ(mesh_.owners()(local.vertex_input()(v)) == ranks_.rank(), local.owned_vertices().has(v));
    EXPECT_EQ(local.owned_segments().has(local.segment_of(0, v)), local.owned_vertices().has(v));
  }
}

TEST_P(DistributedMeshOf, every_partition_knows_owners_and_points) {
  std::vector<int> owner(input().vertices());
  const std::vector<bool> mine = owned();
  for (Id v = 0; v < input().vertices(); ++v) owner[v] = static_cast<int>(ranks_.sum(mine[v] ? ranks_.rank() : 0));
  for (std::size_t i = 0; i < mesh_.vertex_ids().extent(0); ++i) {
    const Id v = vertex_named(mesh_.vertex_ids()(i));
    EXPECT_EQ(mesh_.owners()(i), owner[v]);
    EXPECT_EQ(mesh_.exchange().owner(static_cast<Id>(i)), owner[v]);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(mesh_.points()(i, axis), input().points[v][axis]);
  }
}

TEST_P(DistributedMeshOf, every_partition_knows_who_owns_any_vertex) {
  std::vector<GlobalId> names;
  for (Id v = input().vertices(); v-- > 0;) names.push_back(vertex_name(v));
  names.push_back(vertex_name(0) - 1);
  const std::vector<bool> mine = owned();
  const auto owners = mesh_.exchange().owners_of(view_of(names));
  for (std::size_t i = 0; i + 1 < names.size(); ++i)
    EXPECT_EQ(owners(i) == ranks_.rank(), mine[vertex_named(names[i])]) << names[i];
  EXPECT_EQ(owners(names.size() - 1), -1);
}

INSTANTIATE_TEST_SUITE_P(Tests, DistributedMeshOf, every_mesh_and_partition(), mesh_and_partition);

TEST(DistributedMesh, leaves_vertices_with_the_lowest_rank_that_hands_them_over) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("one_tetrahedron");
  const GivenPart part = part_of(input, "shared", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "shared");
  EXPECT_EQ(mesh.owned_vertices().size(), ranks.rank() == 0 ? 4 : 0);
  EXPECT_EQ(mesh.vertices(), ranks.rank() == 0 ? 4 : 0);
}

TEST(DistributedMesh, dealt_out_along_the_curve_has_shares_of_about_one_size) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh input = holed_grid(20);
  const GivenPart part = part_of(input, "last", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "curve");
  const double share = static_cast<double>(input.vertices()) / ranks.size();
  EXPECT_GT(mesh.owned_vertices().size(), 0.9 * share);
  EXPECT_LT(mesh.owned_vertices().size(), 1.1 * share);
}

TEST(DistributedMesh, dealt_out_along_the_curve_has_few_ghosts) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh input = holed_grid(20);
  const GivenPart part = part_of(input, "random", ranks);
  const auto ghosts = [&](const char* partition) {
    const Mesh local = distribute(ranks, part, partition);
    return ranks.sum(local.vertices() - local.owned_vertices().size());
  };
  if (ranks.size() == 1) {
    EXPECT_EQ(ghosts("random"), 0);
  } else {
    EXPECT_LT(3 * ghosts("curve"), ghosts("random"));
  }
}

TEST(DistributedMesh, of_slabs_of_a_grid_has_the_tetrahedra_of_the_grid) {
  const Communicator ranks(MPI_COMM_WORLD);
  const io::GridPart slab = io::make_grid_part(6, ranks.rank(), ranks.size());
  const io::Dataset whole = io::make_grid(6);
  std::vector<GlobalId> ids, cell_ids;
  for (std::size_t i = 0; i < slab.field.size(); ++i) ids.push_back(slab.first_vertex + GlobalId(i));
  for (std::size_t t = 0; t < slab.tetrahedra.extent(0); ++t) cell_ids.push_back(slab.first_tetrahedron + GlobalId(t));
  for (const bool with_ids : {false, true}) {
    const auto part = with_ids ? make_part(view_of(ids), slab.points, slab.tetrahedra, view_of(cell_ids))
                               : make_part(view_of(ids), slab.points, slab.tetrahedra);
    const DistributedMesh mesh(ranks, part);
    const Mesh& local = mesh;
    EXPECT_EQ(mesh.all_vertices(), 216);
    EXPECT_EQ(mesh.all_cells(), 750);
    EXPECT_EQ(ranks.sum(local.owned_vertices().size()), 216);
    EXPECT_GE(ranks.sum(local.cells()), 750);
    for (Id t = 0; t < local.cells(); ++t) {
      const GlobalId there = mesh.cell_ids()(local.cell_input()(t));
      std::set<GlobalId> corners, expected;
      for (int corner = 0; corner < 4; ++corner) {
        corners.insert(mesh.vertex_ids()(local.vertex_input()(local.encoded().cells(t, corner))));
        expected.insert(whole.tetrahedra(there, corner));
      }
      EXPECT_EQ(corners, expected);
    }
    const auto& points = std::get<io::Dataset::Points<float>>(whole.points);
    for (std::size_t i = 0; i < mesh.vertex_ids().extent(0); ++i) {
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(mesh.points()(i, axis), points(mesh.vertex_ids()(i), axis));
    }
  }
}

TEST(DistributedMesh, counts_tetrahedra_on_from_rank_to_rank) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("holed_grid_9");
  GivenPart part = part_of(input, "blocks", ranks);
  auto views = part.views();
  views.cell_ids = {};
  const DistributedMesh mesh(ranks, views, options_of("blocks"));
  std::map<std::set<Id>, GlobalId> number;
  for (std::size_t t = 0; t < input.tetrahedra.size(); ++t)
    number[std::set<Id>(input.tetrahedra[t].begin(), input.tetrahedra[t].end())] = static_cast<GlobalId>(t);
  const Mesh& local = mesh;
  for (Id t = 0; t < local.cells(); ++t) {
    std::set<Id> corners;
    for (int corner = 0; corner < 4; ++corner)
      corners.insert(vertex_named(mesh.vertex_ids()(local.vertex_input()(local.encoded().cells(t, corner)))));
    EXPECT_EQ(mesh.cell_ids()(local.cell_input()(t)), number.at(corners));
  }
}

}  // namespace gale::test
