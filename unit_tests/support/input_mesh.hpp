#pragma once

#include <array>
#include <string>
#include <vector>

#include <gale/mesh/mesh.hpp>

namespace gale::test {

/// A mesh as users hand it over: input ids, tetrahedra and their corners in any order.
struct InputMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<Id, 4>> tetrahedra;

  Id vertices() const { return static_cast<Id>(points.size()); }
};

/// The names of the meshes that tests loop over.
const std::vector<std::string>& mesh_names();

/// One of them; made at the first call. Throws std::out_of_range for another name.
const InputMesh& mesh_named(const std::string& name);

/// A vertex (0) whose link is a triangulated disc of `degree` vertices.
InputMesh cone_over_disc(Id degree);

/// A vertex (0) whose link of `degree` vertices is a circle with `caps` cones over it: with two a sphere, with more no
/// manifold.
InputMesh cone_over_caps(Id degree, int caps);

/// A vertex (0) whose link is a strip of triangles i, i + 1, i + 2 of `degree` vertices: none of them has many
/// neighbours.
InputMesh cone_over_strip(Id degree);

/// A ring of `ring` vertices around the edges from each of the vertices `hubs` to the next, with a tetrahedron for each
/// edge of the ring and each of these. The ring has the other vertices, ascending.
InputMesh ring_around_edges(Id ring, const std::vector<Id>& hubs);

/// A Freudenthal grid of `side`^3 points, a third of whose tetrahedra are missing, all ids and corners shuffled.
InputMesh holed_grid(Id side);

/// VTK's Delaunay tetrahedralization of `count` seeded random points in the unit cube; no tetrahedra where tests are
/// built without VTK.
InputMesh delaunay_mesh(Id count);

/// Views of copies, for GALE's interfaces.
template <class Coordinate>
Points<Coordinate, HostMemory> points_of(const InputMesh& mesh);
template <class Index>
Tetrahedra<Index, HostMemory> tetrahedra_of(const InputMesh& mesh);

/// GALE's mesh, from 32-bit ids.
Mesh encode(const InputMesh& mesh, const Segmentation& segmentation);

}  // namespace gale::test
