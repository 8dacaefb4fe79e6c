#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.hpp"
#include "support/voxel_shapes.hpp"

// How many blocks a sweep makes, whichever numbers the mesh has: modules ask in the order of these. The meshes have
// some 30 MB of rows, more than the least that is kept of them.

namespace gale::test {

namespace {

constexpr Id side = 37;

/// Vertices numbered line by line, layer by layer.
void number_vertices_by_place(InputMesh& mesh) {
  std::vector<Id> sorted(mesh.vertices()), number(sorted.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(), [&](Id a, Id b) { return mesh.points[a] < mesh.points[b]; });
  const auto points = mesh.points;
  for (Id i = 0; i < mesh.vertices(); ++i) {
    number[sorted[i]] = i;
    mesh.points[i] = points[sorted[i]];
  }
  for (auto& cell : mesh.tetrahedra) {
    for (Id& vertex : cell) vertex = number[vertex];
  }
}

/// Numbers cells by the place of their first points.
void number_cells_by_place(InputMesh& mesh) {
  const auto first = [&](const std::array<Id, 4>& cell) {
    return std::min({mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]], mesh.points[cell[3]]});
  };
  std::sort(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
            [&](const auto& a, const auto& b) { return first(a) < first(b); });
}

/// Connectivity of a mesh whose caller outlives it.
class Read {
 public:
  CallersMesh callers;
  ttk::Connectivity mesh;

  explicit Read(const InputMesh& input)
      : callers(input),
        mesh({callers.points.data(), callers.vertices(), true},
             ttk::Cells(callers.cells.data() + 1, 4, 5, callers.count()), {}) {
    for (const Relation relation : {Relation::VE, Relation::VF, Relation::VT, Relation::EF, Relation::ET}) {
      mesh.need_rows(relation);
    }
  }

  /// Blocks made by a sweep through the vertices that reads stars as discrete gradients do: of each vertex the edges,
  /// triangles and cells, and of its edges likewise.
  std::size_t sweep_vertices() const {
    const std::size_t before = mesh.blocks_made();
    for (Id vertex = 0; vertex < mesh.count(0); ++vertex) {
      for (const Id edge : read_vertex(vertex)) read_edge(edge);
    }
    return mesh.blocks_made() - before;
  }

  /// And by one through the edges that reads those of their vertices, too.
  std::size_t sweep_edges() const {
    const std::size_t before = mesh.blocks_made();
    for (Id edge = 0; edge < mesh.count(1); ++edge) {
      read_edge(edge);
      for (const Id vertex : mesh.edge(edge)) read_vertex(vertex);
    }
    return mesh.blocks_made() - before;
  }

 private:
  Row read_vertex(Id vertex) const {
    mesh.row<Relation::VF>(vertex);
    mesh.row<Relation::VT>(vertex);
    return mesh.row<Relation::VE>(vertex);
  }
  void read_edge(Id edge) const {
    mesh.row<Relation::EF>(edge);
    mesh.row<Relation::ET>(edge);
  }
};

/// Full ones.
double full_segments(const InputMesh& mesh) { return double(mesh.vertices()) / default_capacity; }

TEST(TtkNumbering, a_sweep_makes_a_block_about_once_and_drops_some_only_where_numbers_follow_places) {
  constexpr int relations = 5;
  InputMesh input = voxels(side, side, side, [](Id, Id, Id) { return true; });  // all is shuffled
  std::vector<std::size_t> bytes;
  for (const auto& change : {+[](InputMesh&) {}, number_vertices_by_place, number_cells_by_place}) {
    SCOPED_TRACE(bytes.size());
    change(input);
    const Read read(input);
    const double once = relations * 2 * full_segments(input);  // these are full by half at least
    EXPECT_LE(read.sweep_vertices(), once);
    EXPECT_LE(read.sweep_edges(), once);
    bytes.push_back(read.mesh.bytes());
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_LT(bytes[2], bytes[1] - bytes[1] / 10);
}

}  // namespace

}  // namespace gale::test
