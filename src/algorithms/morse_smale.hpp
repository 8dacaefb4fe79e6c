#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/separatrices.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/export.hpp>

namespace gale {

/// Which parts of a Morse-Smale complex are wanted. Parts that aren't take no time and no memory; the others don't
/// depend on them.
struct MorseSmaleParts {
  bool descending_separatrices = true;  ///< paths from 1-saddles to minima
  bool ascending_separatrices = true;   ///< paths from 2-saddles (saddles of a triangle mesh) to maxima
  bool saddle_connectors = true;        ///< paths from 1-saddles to 2-saddles; a triangle mesh has none
  bool separatrices2 = false;           ///< walls: descending ones of 2-saddles, ascending ones of 1-saddles
  bool descending_manifolds = true;     ///< which minimum each vertex falls to
  bool ascending_manifolds = true;      ///< which maximum each vertex rises to
};

/// The surfaces that the rising paths of critical edges sweep. Each consists of polygons: one for each edge that it
/// crosses, through that edge's tetrahedra, in their order around it.
struct AscendingWalls {
  /// Edges, the higher end first; the critical one, then the others by their input vertices.
  Separatrices<std::array<Id, 2>> walls;

  /// The tetrahedra of the i-th cell of `walls` are star[star_begin[i]] to star[star_begin[i + 1] - 1].
  std::vector<Offset> star_begin{0};
  std::vector<Id> star;  ///< GALE's ids, see star_begin
};

/// The gradient that a complex names its simplices in. On one rank of several it may be made when somebody first asks
/// for it, by any thread: then this takes long, and may throw gale::Error. Copies share it; what is returned lives as
/// long as one of them.
class GALE_EXPORT Excerpt {
 public:
  /// Holds one that is there.
  Excerpt(const DiscreteGradient& gradient);

  /// Has `make` make it.
  explicit Excerpt(std::function<DiscreteGradient()> make);

  /// The gradient, which is made now unless it is there.
  const DiscreteGradient& gradient() const;
  operator const DiscreteGradient&() const { return gradient(); }  ///< what gradient() says

  const Mesh& mesh() const { return gradient().mesh(); }                       ///< the gradient's mesh
  const VertexOrder& order() const { return gradient().order(); }              ///< the gradient's order
  const CriticalSimplices& critical() const { return gradient().critical(); }  ///< its critical simplices
  const detail::GradientStore& store() const { return gradient().store(); }    ///< for GALE's own algorithms

 private:
  struct Made;
  std::shared_ptr<Made> made_;
};

/// Pairs of saddles that `simplify` could not cancel, although their persistence is below the threshold.
struct KeptBelow {
  Id several_paths = 0;  ///< several paths lead from the 1-saddle to the 2-saddle
  Id no_path = 0;        ///< no path does: one of the two was cancelled with another saddle

  /// How many pairs are left.
  Id count() const { return several_paths + no_path; }
};

/// The Morse-Smale complex of a discrete gradient. On a triangle mesh critical edges are all the saddles: where it says
/// tetrahedra below these are triangles, and edges where it says critical triangles. There are no connectors, and no
/// walls. Sources, destinations and manifolds are places among the simplices
/// of `critical`; cells are in GALE's ids. What wasn't wanted is empty.
///
/// On one rank's part of a mesh it has the separatrices of this rank's saddles (saddle connectors are their
/// 2-saddles'), in GALE's ids of an `excerpt`, and the manifolds of all vertices that the rank holds: places among the
/// minima, or maxima, of all ranks, by ascending global ids.
struct GALE_EXPORT MorseSmaleComplex {
  DiscreteGradient gradient;  ///< what it is the complex of
  MorseSmaleParts parts;      ///< which were computed

  /// The critical simplices of the gradient, or those of them that `simplify` left.
  CriticalSimplices critical;

  /// From each critical edge, from both its vertices, that of lower input id first, down to a minimum: the vertices on
  /// the way, the minimum included.
  Separatrices<Id> descending{};

  /// From each critical triangle, from each of its tetrahedra, by input id, up to a maximum: the tetrahedra on the way,
  /// the maximum included. Those that leave through the mesh's surface are left out.
  Separatrices<Id> ascending{};

  /// From a critical edge up to a critical triangle whose descending wall reaches it: the triangles on the way, the
  /// last included. Ordered by triangle, then edge. Where paths fork, it takes the least triangle, each written with
  /// its input vertices ascending.
  Separatrices<TriangleVertices> connectors{};

  /// For each critical triangle, the triangles that its falling paths sweep, itself first.
  Separatrices<TriangleVertices> descending_walls{};

  /// For each critical edge, the polygons that its rising paths sweep.
  AscendingWalls ascending_walls{};

  // Manifolds, by input vertex: where they were found, a device or the host, where they take 12 bytes a
  // vertex; in<HostMemory>() has them on the host, too.

  /// The place among the critical vertices of the minimum that the vertex's path falls to.
  Mirrored<Id> descending_manifold{};

  /// The place among the critical tetrahedra of the maximum that the path from the vertex's tetrahedron of lowest input
  /// id rises to; no_id if that path leaves through the surface.
  Mirrored<Id> ascending_manifold{};

  /// A number for each pair of both, dense from 0; no_id where one is missing.
  Mirrored<Id> morse_smale_manifold{};
  Id morse_smale_manifolds = 0;  ///< how many pairs there are

  KeptBelow kept_below{};  ///< what `simplify` had to leave

  /// What `critical` and the separatrices are of: `gradient`, or on one rank of several an excerpt of it, which is of a
  /// mesh of its own. That one has the cells that separatrices lead through and the vertices, these or all of the
  /// part's, whose global ids its vertex_id() and cell_id() say, the order of its vertices, and the critical simplices.
  /// Pairs alone where walls were wanted: else it is one segment, which isn't made for relations, and of a part of a
  /// grid it is made when somebody first asks for it.
  Excerpt excerpt{gradient};

  /// Whether each of `critical`, by dimension, is this rank's: the others are another rank's, and separatrices
  /// end there. Empty: all are.
  std::array<std::vector<char>, 4> is_own{};

  /// Whether a critical simplex of a dimension is this rank's.
  bool owns(int dimension, Id place) const { return is_own[dimension].empty() || is_own[dimension][place] != 0; }

  /// How many of `critical` are this rank's, by dimension.
  std::array<Id, 4> own_counts() const;
};

/// Traces the complex of a gradient: connectors and walls on options.threads threads, other separatrices on the host's,
/// manifolds in the workers' space. Of a gradient that kernels found, separatrices and, unless separatrices2 are
/// wanted, connectors are found where it is, if there is room. options.progress isn't called. The result is the same
/// whatever found the gradient, and for any number of threads.
///
/// Collective on one rank's part of several. Each follows the separatrices of its own saddles in its part, and others
/// where they leave it, in as many rounds of messages as one changes ranks; each is sent what its own reach elsewhere,
/// and finds connectors by kernels then, if these found the gradient; with walls it is sent all that they reach: throws
/// gale::Error on all ranks before that if one hasn't the memory for it. Manifolds take a number of rounds that grows
/// with the logarithm of how often a path changes ranks.
///
/// Throws gale::Error where separatrices2 are wanted of a triangle mesh.
///
/// Only separatrices2 needs a structure, which `computed` has, or is given. Time and memory grow with what is found,
/// and for manifolds with the mesh. Walls share cells: all together may have many times as many as the mesh. Throws
/// gale::Error as require_consumers and make_structure do.
GALE_EXPORT MorseSmaleComplex find_morse_smale_complex(const DiscreteGradient& gradient,
                                                       const MorseSmaleParts& parts = {},
                                                       const ComputeOptions& options = {},
                                                       Computed* computed = nullptr);

/// Traces the complex with a structure of the caller's, which only separatrices2 reads, for VT. Throws gale::Error if
/// it isn't preconditioned for that, and if it isn't one of the gradient's mesh.
GALE_EXPORT MorseSmaleComplex find_morse_smale_complex(Structure& structure, const DiscreteGradient& gradient,
                                                       const MorseSmaleParts& parts = {},
                                                       const SweepOptions& options = {});

/// What the gradient and this read, of a mesh of tetrahedra.
inline constexpr RelationSet morse_smale_relations = discrete_gradient_relations;

}  // namespace gale
