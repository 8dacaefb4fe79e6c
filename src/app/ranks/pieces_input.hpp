#pragma once

#include <gale/app/ranks/shared_input.hpp>
#include <gale/io/read.hpp>

namespace gale::app {

/// Has each rank read some of the pieces of a `.pvtu`, one behind the other, as many as the others. Vertices and
/// tetrahedra are numbered as one rank numbers them: in the order of the file's global ids. Without those, tetrahedra
/// are counted, and vertices, with a notice, where they occur first: points of equal coordinates are one. Collective;
/// throws SharedError.
SharedInput read_pieces(const Ranks& ranks, const InputOptions& input, const io::PieceNames& pieces);

/// Throws SharedError if an array that orders the vertices of such a mesh isn't a permutation of 0 to n-1. It has
/// values by input id of the part. Collective.
void require_permutation(const Mesh& mesh, const io::PointArray& order);

}  // namespace gale::app
