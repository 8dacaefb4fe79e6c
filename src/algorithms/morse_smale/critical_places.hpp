#pragma once

#include <cstdint>

#include <gale/algorithms/critical_simplices.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

/// The place of each critical simplex among those of its dimension; no_id for a simplex that isn't critical.
class CriticalPlaces {
 public:
  explicit CriticalPlaces(const CriticalSimplices& critical)
      : vertices_(critical.vertices.size()), edges_(critical.edges.size()), cells_(critical.cells.size()) {
    for (const Id vertex : critical.vertices) add(vertices_, vertex);
    for (const auto& [high, low] : critical.edges) add(edges_, pair_key(high, low));
    for (const Id cell : critical.cells) add(cells_, cell);
  }

  Id of_vertex(Id vertex) const { return find(vertices_, vertex); }
  Id of_edge(Id high, Id low) const { return find(edges_, pair_key(high, low)); }
  Id of_cell(Id cell) const { return find(cells_, cell); }

 private:
  static void add(HashTable<Id>& places, std::uint64_t key) {
    const Id place = static_cast<Id>(places.size());
    stop_if_asked_at(place);
    places.insert(key).first = place;
  }

  static Id find(const HashTable<Id>& places, std::uint64_t key) {
    const Id* const place = places.find(key);
    return place == nullptr ? no_id : *place;
  }

  HashTable<Id> vertices_, edges_, cells_;
};

}  // namespace gale::detail
