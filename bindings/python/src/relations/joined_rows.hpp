#pragma once

#include "face_rows.hpp"

namespace gale::python {

/// The simplices that share a face with each: those that `cofaces` has for its two or three faces, without itself. Two
/// share one face at most.
WholeRelation joined_rows(const FaceRows& faces, const WholeRelation& cofaces, const SweepOptions& options);

}  // namespace gale::python
