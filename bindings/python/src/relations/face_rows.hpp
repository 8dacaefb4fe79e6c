#pragma once

#include "whole_relation.hpp"

namespace gale::python {

/// A whole relation to faces: all rows have as many entries.
struct FaceRows {
  int size = 0;               ///< of a row
  Id rows = 0, columns = 0;   ///< how many simplices have rows, and may be faces
  std::shared_ptr<Id> faces;  ///< row i -> its faces, ascending, from faces[size * i] on

  const Id* row(Offset i) const { return faces.get() + size * i; }
};

/// Looks all of them up in the tables of the mesh's simplices, which it enumerates as far as that takes, and writes
/// them where they stay.
FaceRows face_rows(const Mesh& mesh, Relation relation, const NumbersOf& numbers_of, const SweepOptions& options);

}  // namespace gale::python
