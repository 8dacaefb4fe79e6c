#pragma once

#include <vector>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// The tetrahedra and triangles of an edge. One serves one thread, and keeps its memory.
class EdgeStar {
 public:
  explicit EdgeStar(const Mesh& mesh);

  /// Of the edge between `low` and the vertex whose VT row this is.
  void find(Id high, Id low, const Row& tetrahedra);

  /// The third vertices of its triangles.
  const std::vector<Id>& thirds() const { return thirds_; }

  /// Its tetrahedra in their order around it. From an end if there is one, else from that of the lowest input id; of
  /// the two ends and of the two ways that of the lower input id. Where a triangle has three and more tetrahedra, some
  /// order that depends on the input alone.
  const std::vector<Id>& around() const { return around_; }

 private:
  /// A tetrahedron and its two vertices beside the edge's.
  struct Wedge {
    Id input, tetrahedron;
    Id sides[2];
    bool taken;
  };

  void find_thirds();
  void go_around();
  bool is_end(const Wedge& wedge) const;
  int first() const;
  int next(Id side) const;

  Mesh mesh_;
  EncodedMesh<HostMemory> encoded_;
  const Id* tetrahedron_input_;
  std::vector<Wedge> wedges_;
  std::vector<Id> thirds_, around_;
};

}  // namespace gale::detail
