#include <algorithm>

#include <gale/distributed/corner_owners.hpp>
#include <gale/distributed/index_interval.hpp>

namespace gale::detail {

namespace {

/// Throws for a tetrahedron that is none.
template <class Index>
void require_tetrahedron(const Index* quad) {
  const Index a = quad[0], b = quad[1], c = quad[2], d = quad[3];
  if (a != b && a != c && a != d && b != c && b != d && c != d && a >= 0 && b >= 0 && c >= 0 && d >= 0) return;
  std::string vertices;
  for (int corner = 0; corner < 4; ++corner) vertices += ' ' + std::to_string(quad[corner]);
  throw Error("the tetrahedron of vertices" + vertices + " is none: they must be different, and 0 or more");
}

}  // namespace

template <class Index>
std::vector<Id> tetrahedra_beyond(const MeshPart<Index>& part, const IdInterval& own) {
  constexpr Offset block = 64;
  const Offset count = part.tetrahedra.extent(0);
  const Index* const corners = part.tetrahedra.data();
  const IndexInterval<Index> inner(own);
  const int parts = threads_for(count);
  std::vector<std::vector<Id>> of_parts(parts);
  for_parts("GALE::outer_tetrahedra", count, parts, [&](int some, Offset first, Offset last) {
    for (Offset begin = first; begin < last; begin += block) {
      const Offset end = std::min(begin + block, last);
      if (inner.contains(corners + 4 * begin, 4 * (end - begin))) continue;
      for (Offset t = begin; t < end; ++t) {
        if (inner.contains(corners + 4 * t, 4)) continue;
        require_tetrahedron(corners + 4 * t);
        of_parts[some].push_back(static_cast<Id>(t));
      }
    }
  });
  std::vector<Id> all;
  for (const auto& some : of_parts) all.insert(all.end(), some.begin(), some.end());
  return all;
}

template <class Index>
void require_tetrahedra(const MeshPart<Index>& part) {
  for (std::size_t t = 0; t < part.tetrahedra.extent(0); ++t) require_tetrahedron(part.tetrahedra.data() + 4 * t);
}

template <class Index>
CornerOwners<Index>::CornerOwners(const Communicator& ranks, const MeshPart<Index>& part,
                                  const VertexDirectory& directory, const IdInterval& own, const std::vector<Id>& outer)
    : rank_(ranks.rank()), part_(part), own_(own) {
  GlobalIds others;
  together(ranks, [&] {
    if (own.is_empty()) given_ = GlobalIndex(distinct_ids(part.vertex_ids).ids);
    others = missing_ids(given_, static_cast<Offset>(outer.size()), [&](Offset i, const auto& offer) {
      for (int corner = 0; corner < 4; ++corner) {
        const GlobalId vertex = part.tetrahedra(outer[i], corner);
        if (!own.contains(vertex)) offer(vertex);
      }
    });
    others_ = GlobalIndex(others);
  });
  of_given_ = directory.find(given_.ids());
  of_others_ = directory.find(others);
  together(ranks, [&] { refuse_unknown(); });
}

template <class Index>
void CornerOwners<Index>::refuse_unknown() const {
  for (Offset i = 0; i < others_.count(); ++i) {
    if (of_others_(i).giver < 0)
      throw Error("a tetrahedron has vertex " + std::to_string(others_[i]) + ", which no rank hands over");
  }
}

#define GALE_INSTANTIATE(Index)                                                              \
  template std::vector<Id> tetrahedra_beyond(const MeshPart<Index>&, const IdInterval& own); \
  template void require_tetrahedra(const MeshPart<Index>&);                                  \
  template class CornerOwners<Index>
GALE_INSTANTIATE(std::int32_t);
GALE_INSTANTIATE(std::int64_t);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
