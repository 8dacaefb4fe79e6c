#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/critical_simplices.hpp>
#include <gale/base/pair_key.hpp>

namespace gale::detail {

/// Where a critical simplex is among those of its dimension: hash tables with open addressing.
class CriticalPlaces {
 public:
  explicit CriticalPlaces(const CriticalSimplices& critical);

  Id of_vertex(Id vertex) const { return vertices_.find(vertex); }
  Id of_edge(Id high, Id low) const { return edges_.find(pair_key(high, low)); }
  Id of_tetrahedron(Id tetrahedron) const { return tetrahedra_.find(tetrahedron); }

 private:
  class Table {
   public:
    explicit Table(std::size_t count);
    void add(std::uint64_t key, Id place) { slots_[slot_of(key)] = {key, place}; }

    /// no_id if there is no such key.
    Id find(std::uint64_t key) const { return slots_[slot_of(key)].place; }

   private:
    struct Slot {
      std::uint64_t key = 0;
      Id place = no_id;
    };

    std::size_t slot_of(std::uint64_t key) const {
      const std::size_t mask = slots_.size() - 1;
      std::size_t slot = static_cast<std::size_t>(spread(key)) & mask;
      while (slots_[slot].place != no_id && slots_[slot].key != key) slot = (slot + 1) & mask;
      return slot;
    }

    std::vector<Slot> slots_;
  };

  Table vertices_, edges_, tetrahedra_;
};

}  // namespace gale::detail
