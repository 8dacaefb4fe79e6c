#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>

namespace gale::baselines {

/// The right rows of a relation of a mesh, in GALE's ids, by means that share no code with the segment kernels.
class Oracle {
 public:
  virtual ~Oracle() = default;

  /// "the explicit structure"
  virtual std::string name() const = 0;

  /// How many rows there are.
  virtual Id rows() const = 0;

  /// The row of a simplex, ascending. By any thread; each has a number 0 to threads - 1.
  virtual void read(Id simplex, int thread, std::vector<Id>& row) = 0;
};

/// Another way than the one that is to be verified: the explicit structure where GALE was built with Kokkos-Kernels,
/// unless that `is_explicit` itself; else brute force.
std::unique_ptr<Oracle> make_oracle(const Mesh& mesh, Relation relation, int threads, bool is_explicit);

/// Sorted lists of all simplices, and what follows from them: slow, and simple.
std::unique_ptr<Oracle> make_brute_force(const Mesh& mesh, Relation relation);

}  // namespace gale::baselines
