#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/excerpt/vertex_names.hpp>
#include <gale/algorithms/excerpt/wider_simplices.hpp>

namespace gale::detail {

/// Keys that compare the vertices of WiderSimplices. Takes 8 bytes for each of the part's vertices where values have
/// more than 32 bits, else for others alone. Refers to the simplices.
class WiderKeys {
 public:
  explicit WiderKeys(const WiderSimplices& simplices);

  const WiderSimplices& simplices() const { return simplices_; }
  const std::vector<std::uint64_t>& ranks() const { return ranks_; }
  const std::vector<std::uint64_t>& others() const { return others_; }

 private:
  void rank_vertices();

  const WiderSimplices& simplices_;
  std::vector<std::uint64_t> ranks_;   ///< places of all in the order, where the part's keys say too little
  std::vector<std::uint64_t> others_;  ///< else keys of others' vertices
};

/// Names and keys of the vertices of WiderSimplices in a memory. Refers to what lies there already.
template <class Memory>
class WiderKeysIn {
 public:
  explicit WiderKeysIn(const WiderKeys& keys)
      : own_before_(in_memory<Memory>(keys.simplices().own_before())),
        ranks_(in_memory<Memory>(keys.ranks())),
        others_(in_memory<Memory>(keys.others())) {
    const WiderSimplices& simplices = keys.simplices();
    names_ = simplices.names();
    names_.input = simplices.mesh().template vertices_in_input<Memory>();
    names_.own_before = own_before_.data();
    if (ranks_.extent(0) != 0) {
      keys_ = {ranks_.data(), simplices.vertices()};
    } else {
      keys_ = {simplices.order().template keys_in<Memory>().data(), simplices.own_vertices(), others_.data(), names_};
    }
  }

  /// Names of vertices, which compare as input ids do.
  const VertexNames& names() const { return names_; }
  const NamedKeys& keys() const { return keys_; }

 private:
  Array<const Id, Memory> own_before_;
  Array<const std::uint64_t, Memory> ranks_, others_;
  VertexNames names_;
  NamedKeys keys_{};
};

}  // namespace gale::detail
