#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "distributed/given_parts.hpp"
#include "support/message_of.hpp"

// What is wrong with a part, or with all together, all ranks throw alike.

namespace gale::test {

namespace {

/// The last rank has one tetrahedron and its four vertices, as it is changed; the others have nothing.
class LastPart {
 public:
  explicit LastPart(const VertexNames& names = names_with_gaps) {
    vertex_names = names;
    if (is_last()) {
      for (Id v = 0; v < 4; ++v) part.add_vertex(mesh_named("one_tetrahedron"), v);
      part.add_cell(mesh_named("one_tetrahedron"), 0);
    }
  }

  bool is_last() const { return ranks.rank() + 1 == ranks.size(); }

  /// What all ranks say, without the name of the last.
  std::string message() const {
    const std::string message = message_of([&] { DistributedMesh(ranks, part.views(), options); });
    const std::string prefix = "rank " + std::to_string(ranks.size() - 1) + ": ";
    return message.substr(0, prefix.size()) == prefix ? message.substr(prefix.size()) : message;
  }

  const Communicator ranks{MPI_COMM_WORLD};
  GivenPart part;
  PartitionOptions options;
};

}  // namespace

TEST(WrongParts, have_ids_below_0) {
  LastPart given;
  if (given.is_last()) given.part.vertex_ids[2] = -3;
  EXPECT_EQ(given.message(), "ids are 0 or more, not -3");
  LastPart other;
  if (other.is_last()) other.part.cell_ids[0] = -7;
  EXPECT_EQ(other.message(), "ids are 0 or more, not -7");
}

TEST(WrongParts, have_ids_whose_sums_are_none) {
  constexpr GlobalId most = (GlobalId(1) << 62) - 1;
  EXPECT_EQ(LastPart({most - 3, 1}).message(), "no error");
  for (const GlobalId first : {most - 2, std::numeric_limits<GlobalId>::max() - 3}) {
    EXPECT_EQ(LastPart({first, 1}).message(),
              "ids are at most 4611686018427387903, not " + std::to_string(std::max(first, most + 1)));
  }
  using Limits = std::numeric_limits<GlobalId>;
  LastPart around;
  if (around.is_last()) around.part.vertex_ids = {Limits::max(), Limits::min(), Limits::min() + 1, Limits::min() + 2};
  EXPECT_EQ(around.message(), "ids are at most 4611686018427387903, not 9223372036854775807");
}

/// Where one rank has all, as it would number it, the same is said.
TEST(WrongParts, that_are_numbered_from_0_are_refused_alike) {
  LastPart twice({0, 1});
  if (twice.is_last()) twice.part.cells = {0, 1, 0, 3};
  EXPECT_EQ(twice.message(), "the cell of vertices 0 1 0 3 is none: they must be different, and 0 or more");
  LastPart unknown({0, 1});
  if (unknown.is_last()) unknown.part.cells = {0, 1, 77, 3};
  EXPECT_EQ(unknown.message(), "a cell has vertex 77, which no rank hands over");
  LastPart twins({0, 1});
  if (twins.is_last()) {
    twins.part.cells.insert(twins.part.cells.end(), {3, 2, 1, 0});
    twins.part.cell_ids = {12, 99};
  }
  EXPECT_EQ(twins.message(), "cells 12 and 99 have the same vertices");
}

TEST(WrongParts, have_tetrahedra_with_a_vertex_twice) {
  LastPart given;
  if (given.is_last()) given.part.cells = {5, 8, 5, 14};
  EXPECT_EQ(given.message(), "the cell of vertices 5 8 5 14 is none: they must be different, and 0 or more");
}

TEST(WrongParts, have_tetrahedra_of_vertices_that_nobody_has) {
  LastPart given;
  if (given.is_last()) given.part.cells = {5, 8, 77, 14};
  EXPECT_EQ(given.message(), "a cell has vertex 77, which no rank hands over");
  if (given.is_last()) given.part.cells = {0, 8, std::numeric_limits<GlobalId>::max(), 14};
  EXPECT_EQ(given.message(), "a cell has vertex 0, which no rank hands over");
}

TEST(WrongParts, have_points_nowhere) {
  for (const bool repartition : {false, true}) {
    for (const VertexNames& names : {names_with_gaps, names_without_gaps}) {
      LastPart given(names);
      given.options.repartition = repartition;
      if (given.is_last()) given.part.points[4] = std::numeric_limits<double>::infinity();
      EXPECT_EQ(given.message(), "point 1 has a coordinate that is not finite");
    }
  }
}

TEST(WrongParts, have_a_tetrahedron_twice) {
  LastPart given;
  if (given.is_last()) {
    given.part.cells.insert(given.part.cells.end(), {14, 11, 8, 5});
    given.part.cell_ids = {12, 12};
  }
  EXPECT_EQ(given.message(), "cell 12 is handed over twice");
  if (given.is_last()) given.part.cell_ids = {12, 99};
  EXPECT_EQ(given.message(), "cells 12 and 99 have the same vertices");
}

TEST(WrongParts, have_no_cells) {
  LastPart given;
  given.part.cells.clear();
  given.part.cell_ids.clear();
  EXPECT_EQ(given.message(), "the mesh has no cells");
}

TEST(WrongParts, have_cells_of_two_dimensions) {
  LastPart given;
  if (given.ranks.size() == 1) return;
  if (given.ranks.rank() == 0) given.part.add_cell(input_named("torus"), 0);
  EXPECT_EQ(given.message(), "cells are of one dimension on all ranks: rank 0 has triangles, rank " +
                                 std::to_string(given.ranks.size() - 1) + " tetrahedra");
}

TEST(WrongParts, have_ids_of_cells_on_some_ranks) {
  LastPart given;
  if (given.ranks.size() == 1) return;
  if (given.ranks.rank() == 0) given.part.add_cell(mesh_named("one_tetrahedron"), 0);
  auto views = given.part.views();
  if (given.ranks.rank() == 0) views.cell_ids = {};
  EXPECT_EQ(message_of([&] { DistributedMesh(given.ranks, views); }), "cells have ids on all ranks or on none: rank " +
                                                                          std::to_string(given.ranks.size() - 1) +
                                                                          " has ids of cells, rank 0 has none");
}

TEST(WrongParts, have_cells_of_two_vertices) {
  LastPart given;
  auto views = given.part.views();
  if (given.is_last()) views.cells = CellRows<GlobalId>(given.part.cells.data(), 1, 2);
  const std::string message = message_of([&] { DistributedMesh(given.ranks, views); });
  EXPECT_NE(message.find("cells have 3 vertices or 4, not 2"), std::string::npos) << message;
}

TEST(WrongParts, have_triangles_that_are_none) {
  LastPart given;
  if (given.is_last()) {
    given.part.corners = 3;
    given.part.cells = {5, 8, 5};
  }
  EXPECT_EQ(given.message(), "the cell of vertices 5 8 5 is none: they must be different, and 0 or more");
  if (given.is_last()) {
    given.part.cells = {5, 8, 11, 11, 5, 8};
    given.part.cell_ids = {12, 99};
  }
  EXPECT_EQ(given.message(), "cells 12 and 99 have the same vertices");
}

TEST(WrongParts, have_a_capacity_of_0) {
  LastPart given;
  given.options.capacity = 0;
  const std::string message = message_of([&] { DistributedMesh(given.ranks, given.part.views(), given.options); });
  EXPECT_NE(message.find("a segment's capacity must be at least 1 vertex, not 0"), std::string::npos) << message;
}

TEST(WrongParts, do_not_fit_the_ranks) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh input = holed_grid(9);
  const auto count = static_cast<Offset>(input.tetrahedra.size());
  const GivenPart part = part_of(input, "last", ranks);
  PartitionOptions options;
  options.most_local = count / 2;
  EXPECT_EQ(message_of([&] { DistributedMesh(ranks, part.views(), options); }),
            "a rank would hold " + std::to_string(count) + " cells, but at most " + std::to_string(count / 2) +
                " fit: take at least " + std::to_string(count * ranks.size() / (count / 2) + 1) + " ranks");
}

TEST(WrongParts, are_held_to_the_least_of_all_limits) {
  const Communicator ranks(MPI_COMM_WORLD);
  const GivenPart part = part_of(holed_grid(9), "random", ranks);
  PartitionOptions options;
  if (ranks.rank() + 1 == ranks.size()) options.most_local = 1;
  EXPECT_NE(message_of([&] { DistributedMesh(ranks, part.views(), options); }).find("but at most 1 fit"),
            std::string::npos);
}

}  // namespace gale::test
