#pragma once

#include <memory>

#include <gale/relations/faces.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// Rows of face relations from the mesh's tables, as localized structures have them.
class LookedUpFaces {
 public:
  explicit LookedUpFaces(const Simplices<HostMemory>& simplices) : simplices_(simplices) {}

  template <Relation relation>
  auto row(Id simplex) const {
    return face_row<relation>(simplices_, simplex);
  }

 private:
  Simplices<HostMemory> simplices_;
};

/// Rows of face relations from a structure that keeps all rows. One serves one thread; a row is valid until the next of
/// its relation.
class KeptFaces {
 public:
  explicit KeptFaces(Structure& structure) : consumer_(structure.consumer()) {}

  template <Relation relation>
  Row row(Id simplex) const {
    return consumer_->row(relation, simplex);
  }

 private:
  std::unique_ptr<Consumer> consumer_;
};

}  // namespace gale::detail
