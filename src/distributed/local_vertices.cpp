#include <algorithm>

#include <gale/distributed/local_vertices.hpp>

namespace gale::detail {

LocalVertices::LocalVertices(const OwnedIds& owned, const GlobalIds& ghosts)
    : interval_(owned.interval), owned_count_(owned.count()), ghosts_(ghosts) {
  if (interval_.is_empty()) {
    merge(owned.ids);
    return;
  }
  const GlobalId* const begin = ghosts.data();
  lower_ghosts_ = std::lower_bound(begin, begin + ghosts.extent(0), interval_.begin) - begin;
  index_ = GlobalIndex(ghosts);
}

/// Each goes behind those of its own kind, and behind those of the other kind that are less.
void LocalVertices::merge(const GlobalIds& owned) {
  all_ = allocate<GlobalIds>("GALE::local_vertices", count());
  const auto place = [&](const GlobalIds& kind, const GlobalIds& other) {
    const Offset kinds = kind.extent(0), others = other.extent(0);
    const auto places = allocate<Array<Id, HostMemory>>("GALE::merged_vertices", kinds);
    for_parts("GALE::merge_vertices", kinds, threads_for(kinds), [&](int, Offset first, Offset last) {
      if (first == last) return;
      Offset less = std::lower_bound(other.data(), other.data() + others, kind(first)) - other.data();
      for (Offset i = first; i < last; ++i) {
        while (less < others && other(less) < kind(i)) ++less;
        places(i) = static_cast<Id>(i + less);
        all_(i + less) = kind(i);
      }
    });
    return places;
  };
  owned_ = place(owned, ghosts_);
  ghost_ = place(ghosts_, owned);
  index_ = GlobalIndex(all_);
}

}  // namespace gale::detail
