#pragma once

#include <memory>

#include <gale/relations/boundary_row.hpp>
#include <gale/relations/structure.hpp>

namespace gale::detail {

/// Rows of boundary relations from the mesh' tables, as localized structures have them.
class LookedUpBoundary {
 public:
  explicit LookedUpBoundary(const Simplices<HostMemory>& simplices) : simplices_(simplices) {}

  template <Relation relation>
  auto row(Id simplex) const {
    return boundary_row<relation>(simplices_, simplex);
  }

 private:
  Simplices<HostMemory> simplices_;
};

/// Rows of boundary relations from a structure that keeps all. One serves one thread; a row is valid until the next of its relation.
class KeptBoundary {
 public:
  explicit KeptBoundary(Structure& structure) : consumer_(structure.consumer()) {}

  template <Relation relation>
  Row row(Id simplex) const {
    return consumer_->row(relation, simplex);
  }

 private:
  std::unique_ptr<Consumer> consumer_;
};

}  // namespace gale::detail
