#pragma once

#include <gale/relations/rows.hpp>

namespace gale {

/// A vertex and what touches it: its rows of VV and VT, and its link.
struct VertexStar {
  Id vertex = no_id;
  Row neighbours, tetrahedra;
  LinkRow link;
};

}  // namespace gale
