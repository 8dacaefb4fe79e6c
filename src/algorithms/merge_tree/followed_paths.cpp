#include <utility>

#include <gale/algorithms/merge_tree/followed_paths.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// Leaves of sorted meetings those of vertices where two extrema or more meet, each once.
void keep_meetings_of_several(std::vector<Meeting>& meetings) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < meetings.size();) {
    const std::size_t first = kept;
    const Id vertex = meetings[i].vertex;
    for (; i < meetings.size() && meetings[i].vertex == vertex; ++i) {
      if (kept == first || meetings[kept - 1].other != meetings[i].other) meetings[kept++] = meetings[i];
    }
    if (kept == first + 1) kept = first;
  }
  meetings.resize(kept);
}

}  // namespace

template <class Space>
FollowedPaths<MemoryOf<Space>> follow_paths(const Space& space, Side side, const ComparedVertices& compared,
                                            ExtremumGraphSide<MemoryOf<Space>> graph) {
  FollowedPaths<MemoryOf<Space>> paths{std::move(graph.extrema), std::move(graph.meetings), graph.next};
  const SidePlaces comes_before{side};
  parallel_sort("GALE::sort_extrema", paths.extrema.begin(), paths.extrema.end(), comes_before);
  const std::vector<Id> extrema = compared.at(paths.extrema);
  const auto places = in_memory<MemoryOf<Space>>(extrema);
  parallel_for("GALE::end_paths", space, places.extent(0), EndPath<MemoryOf<Space>>{places, paths.ends});
  jump(space, paths.ends);
  std::vector<Id> others;
  others.reserve(paths.meetings.size());
  for (const Meeting& meeting : paths.meetings) others.push_back(meeting.other);
  others = ends_of(space, paths.ends, others);
  for (std::size_t i = 0; i < others.size(); ++i) paths.meetings[i].other = others[i];
  parallel_sort("GALE::sort_meetings", paths.meetings.begin(), paths.meetings.end(),
                [&](const Meeting& a, const Meeting& b) {
                  return a.vertex == b.vertex ? a.other < b.other : comes_before(a.vertex, b.vertex);
                });
  keep_meetings_of_several(paths.meetings);
  return paths;
}

#define GALE_INSTANTIATE(Space)                                                                            \
  template FollowedPaths<MemoryOf<Space>> follow_paths<Space>(const Space&, Side, const ComparedVertices&, \
                                                              ExtremumGraphSide<MemoryOf<Space>>)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
