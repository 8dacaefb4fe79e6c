#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

/// The vertices of an extremum graph that are compared, as they come in the order: places here compare as they do.
struct ComparedVertices {
  std::vector<Id> vertices;
  std::vector<std::uint64_t> keys;

  /// Puts the places in their order where lists have vertices, and meetings theirs, and returns what is at these
  /// places. `keys_of(vertices)` are the keys of some.
  template <class KeysOf>
  static ComparedVertices numbered(const std::vector<std::vector<Id>*>& others,
                                   const std::vector<std::vector<Meeting>*>& meetings, const KeysOf& keys_of) {
    std::vector<Id*> all;
    for (std::vector<Id>* const some : others) {
      for (Id& vertex : *some) all.push_back(&vertex);
    }
    for (std::vector<Meeting>* const some : meetings) {
      for (Meeting& meeting : *some) all.push_back(&meeting.vertex);
    }
    std::vector<Id> asked(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) asked[i] = *all[i];
    const std::vector<std::uint64_t> keys = keys_of(asked);
    std::vector<std::pair<std::uint64_t, Id*>> sorted(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) sorted[i] = {keys[i], all[i]};
    parallel_sort("GALE::sort_compared", sorted.begin(), sorted.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
    ComparedVertices compared;
    for (const auto& [key, vertex] : sorted) {
      if (compared.keys.empty() || compared.keys.back() != key) {
        compared.keys.push_back(key);
        compared.vertices.push_back(*vertex);
      }
      *vertex = static_cast<Id>(compared.vertices.size()) - 1;
    }
    return compared;
  }

  /// The vertices at some places.
  std::vector<Id> at(const std::vector<Id>& places) const {
    std::vector<Id> those(places.size());
    parallel_for("GALE::compared_at", HostExecutionSpace(), those.size(),
                 [&](Offset i) { those[i] = vertices[places[i]]; });
    return those;
  }

  /// The keys at some places, as a side sees them.
  std::vector<std::uint64_t> keys_at(const std::vector<Id>& places, Side side) const {
    const SideKeys of_side(keys.data(), side);
    std::vector<std::uint64_t> those(places.size());
    parallel_for("GALE::compared_keys", HostExecutionSpace(), those.size(),
                 [&](Offset i) { those[i] = of_side[places[i]]; });
    return those;
  }
};

/// Compares places as a side comes to their vertices.
struct SidePlaces {
  Side side;
  bool operator()(Id a, Id b) const { return side == below ? a < b : b < a; }
};

}  // namespace gale::detail
