#pragma once

#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/vertex_names.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/morse_smale/wider_successors.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/runtime/structure.hpp>

// The parts of a Morse-Smale complex, each found by itself; MorseSmaleComplex says in which order they come.

namespace gale::detail {

class TurnedEdges;

/// Where the 1-separatrices of a gradient's critical edges, or of its critical facets of cells (triangles; on a
/// triangle mesh edges), start, each with its source's place among these.
struct PathStarts {
  std::vector<Id> simplices, sources;
};
PathStarts descending_starts(const Mesh& mesh, const CriticalSimplices& critical);
PathStarts ascending_starts(const CriticalSimplices& critical);

/// Finds the paths from some simplices along these successors, but those that leave through the surface. Their
/// destinations are place(last simplex).
Separatrices<Id> paths_along(const MoreSuccessors& successors, const PathStarts& starts,
                             const std::function<Id(Id)>& place);

/// Finds the paths from each critical edge down to minima along these successors, where they are.
Separatrices<Id> descending_separatrices(const Mesh& mesh, const Mirrored<Id>& successors,
                                         const CriticalSimplices& critical, const CriticalPlaces& places,
                                         Paths told = Paths::whole);

/// Finds the paths from each critical facet of cells up to maxima along these successors, where they are.
Separatrices<Id> ascending_separatrices(const Mirrored<Id>& successors, const CriticalSimplices& critical,
                                        const CriticalPlaces& places, Paths told = Paths::whole);

/// The descending walls of critical triangles, and the saddle connectors in them.
struct DescendingSurfaces {
  Separatrices<TriangleVertices> walls, connectors;
};

/// Finds those of `critical` on `threads` threads. With `turned` in the gradient that these edges make of it, and no
/// connector of which the critical edge is higher than the triangle. `told` says how connectors are.
DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                       const CriticalPlaces& places, bool want_walls, bool want_connectors, int threads,
                                       const TurnedEdges* turned = nullptr, Paths told = Paths::whole);

struct WallRows;
class WiderGradient;
class WiderRows;

/// Saddle connectors, the last ones' triangles where kernels found them.
struct FoundConnectors {
  Separatrices<TriangleVertices> paths;                          ///< with the triangles of the first ones
  std::vector<Array<TriangleVertices, WorkerMemory>> triangles;  ///< those that follow, one part after the other
  VertexNames names{};                                           ///< of their vertices, for kernels
  std::shared_ptr<const WiderRows> rows;                         ///< where names are, unless they are the mesh's

  /// Has paths have all triangles.
  void bring();
};

/// The saddle connectors of one rank's 2-saddles: first those of walls inside its part, then the others, when what
/// these reach elsewhere is known. Until then it keeps these walls as far as they are in the part, up to a triangle a
/// vertex; what is more is followed anew. Where kernels found the gradient they find all of them then.
class ConnectorsHere {
 public:
  /// Refers to the gradient.
  ConnectorsHere(const DiscreteGradient& gradient, int threads);
  ~ConnectorsHere();

  /// The edges, the higher end first, at which walls leave the part; where kernels find connectors, those at which they
  /// begin.
  const std::vector<std::array<Id, 2>>& exits() const { return exits_; }

  /// All connectors, once. `wider` has all that is reached from the exits; `places` are those of
  /// critical simplices there, and edge_places[i] is that of the rank's i-th critical edge.
  FoundConnectors finish(const WiderGradient& wider, const CriticalPlaces& places, const std::vector<Id>& edge_places);

 private:
  struct Found;

  void follow_here(const DiscreteGradient& gradient);

  const std::vector<TriangleVertices>& triangles_;
  const int threads_;
  const bool are_by_kernels_;
  std::unique_ptr<Found> found_;
  std::vector<std::array<Id, 2>> exits_;
};

/// Where this rank's 1-separatrices leave its part.
struct PathExits {
  PathStarts starts;
  ExitLinks links;
};

/// Finds the separatrices of this rank's saddles on several ranks, and the excerpt that these are in. What leaves a
/// part is followed on by the others, who tell what they pass. Collective.
void separatrices_on_ranks(int threads, PathExits down, PathExits up, MorseSmaleComplex& complex);

/// Finds the saddle connectors in the descending walls of critical triangles by kernels, where these find the rows of a
/// gradient: those that `descending_surfaces` finds, in its order. Walls are made together that have about
/// `most_together` edges at most, a single one with any number: 2^26 take 4 to 8 GiB, beside the connectors. Throws
/// OutOfMemory if one doesn't fit there.
FoundConnectors device_connectors(const WallRows& rows, const CriticalSimplices& critical,
                                  Offset most_together = Offset(1) << 26);

/// Finds the ascending walls of some critical edges, by their places, ascending. A wall goes on from an edge, through
/// each of the edge's triangles, to the edge that the triangle is paired with. Reads VT of `structure`.
AscendingWalls ascending_walls(Structure& structure, const DiscreteGradient& gradient, const std::vector<Id>& sources,
                               int threads);

/// Finds where paths from `exits.starts` leave the part. Collective.
void find_exits(const DiscreteGradient& gradient, PathSimplices::Kind kind, PathExits& exits);

// Manifolds are where they were found: in the workers' memory, if there is room. Of a mesh on several ranks finding
// them is collective. They are by input id, ghosts' too, and name extrema by their places among those of all ranks. On
// the way there the exits of separatrices can be found, if there are several.

Mirrored<Id> descending_manifolds(const DiscreteGradient& gradient, PathExits* exits = nullptr);
Mirrored<Id> ascending_manifolds(const DiscreteGradient& gradient, PathExits* exits = nullptr);

/// Finds a number for each pair (ascending, descending) that occurs, in lexicographic order, dense from 0; no_id where
/// the ascending one is missing. And how many pairs there are, of all ranks that the mesh lies on.
std::pair<Mirrored<Id>, Id> morse_smale_manifolds(const Mesh& mesh, const Mirrored<Id>& ascending,
                                                  const Mirrored<Id>& descending);

/// The manifolds with names[p] for each place p; no_id stays.
Mirrored<Id> renamed(const Mirrored<Id>& manifolds, const std::vector<Id>& names);

}  // namespace gale::detail
