#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>

namespace gale::baselines {

/// The rows of a relation of a mesh, in GALE's ids, found without any code of the segment kernels.
class GALE_EXPORT Oracle {
 public:
  virtual ~Oracle() = default;

  /// "the explicit structure" or "brute force"
  virtual std::string name() const = 0;

  /// How many rows there are.
  virtual Id rows() const = 0;

  /// The row of a simplex, ascending. By any thread; each has a number 0 to threads - 1.
  virtual void read(Id simplex, int thread, std::vector<Id>& row) = 0;
};

/// The explicit structure where GALE was built with Kokkos-Kernels, else brute force. Brute force too where it is the
/// explicit structure that is to be verified (`is_explicit`).
GALE_EXPORT std::unique_ptr<Oracle> make_oracle(const Mesh& mesh, Relation relation, int threads, bool is_explicit);

}  // namespace gale::baselines
