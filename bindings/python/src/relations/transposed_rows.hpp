#pragma once

#include "face_rows.hpp"

namespace gale::python {

/// The relation the other way round: for each face the simplices that have it. Each thread counts and places those of a
/// part of the simplices, so that they ascend. Beside the result it takes 4 bytes for each face from the least to the
/// greatest of a part; there are so few parts that this is no more than twice the entries' memory.
WholeRelation transposed_rows(const FaceRows& faces, int threads);

}  // namespace gale::python
