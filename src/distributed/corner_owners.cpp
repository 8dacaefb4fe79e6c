#include <gale/distributed/corner_owners.hpp>

namespace gale::detail {

namespace {

[[noreturn]] void refuse(const GlobalId* quad) {
  std::string vertices;
  for (int corner = 0; corner < 4; ++corner) vertices += ' ' + std::to_string(quad[corner]);
  throw Error("the tetrahedron of vertices" + vertices + " is none: they must be different, and 0 or more");
}

}  // namespace

template <class Index>
std::vector<Id> tetrahedra_beyond(const MeshPart<Index>& part, const IdInterval& own) {
  const Offset count = part.tetrahedra.extent(0);
  const int parts = threads_for(count);
  std::vector<std::vector<Id>> of_parts(parts);
  std::vector<Offset> bad(parts, count);
  for_parts("GALE::validate_part", count, parts, [&](int some, Offset first, Offset last) {
    std::vector<Id>& found = of_parts[some];
    for (Offset t = first; t < last; ++t) {
      const Index a = part.tetrahedra(t, 0), b = part.tetrahedra(t, 1), c = part.tetrahedra(t, 2),
                  d = part.tetrahedra(t, 3);
      const bool is_none = a == b || a == c || a == d || b == c || b == d || c == d || a < 0 || b < 0 || c < 0 || d < 0;
      if (is_none) {
        bad[some] = t;
        return;
      }
      if (!own.contains(a) || !own.contains(b) || !own.contains(c) || !own.contains(d))
        found.push_back(static_cast<Id>(t));
    }
  });
  for (const Offset t : bad) {
    if (t == count) continue;
    const GlobalId quad[4] = {part.tetrahedra(t, 0), part.tetrahedra(t, 1), part.tetrahedra(t, 2),
                              part.tetrahedra(t, 3)};
    refuse(quad);
  }
  std::vector<Id> all;
  for (const auto& some : of_parts) all.insert(all.end(), some.begin(), some.end());
  return all;
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
  template class CornerOwners<Index>
GALE_INSTANTIATE(std::int32_t);
GALE_INSTANTIATE(std::int64_t);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
