#include <algorithm>
#include <numeric>
#include <utility>

#include <gale/algorithms/merge_tree/merge_forest.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

namespace {

/// Joins extrema, from the first meeting to the last. Nodes are numbered as they are made meanwhile.
class ExtremumJoiner {
 public:
  explicit ExtremumJoiner(const std::vector<Id>& extrema)
      : older_(extrema.size()), newest_(extrema.size()), has_root_(extrema.size()) {
    std::iota(older_.begin(), older_.end(), Id(0));
    newest_ = older_;
    forest.vertices = extrema;
    forest.parent.resize(extrema.size(), no_id);
    forest.leaf = older_;
    forest.branch_end.resize(extrema.size(), no_id);
  }

  /// Joins the components of the extrema that meet in a vertex.
  void join(const Meeting* begin, const Meeting* end) {
    Id node = no_id, all = root_of(older_, begin->other);
    for (const Meeting* meeting = begin + 1; meeting != end; ++meeting) {
      const Id other = root_of(older_, meeting->other);
      if (other == all) continue;
      if (node == no_id) {
        node = add(begin->vertex);
        forest.parent[newest_[all]] = node;
      }
      forest.parent[newest_[other]] = node;
      const Id younger = std::max(all, other);
      all = std::min(all, other);
      older_[younger] = all;
      forest.branch_end[younger] = node;
    }
    if (node != no_id) newest_[all] = node;
  }

  /// Ends a component, unless that was done.
  void end_at(const Meeting& last) {
    const Id component = root_of(older_, last.other);
    if (has_root_[component]) return;
    has_root_[component] = true;
    const Id newest = newest_[component];
    if (forest.vertices[newest] == last.vertex) return;
    const Id root = add(last.vertex);
    forest.parent[newest] = root;
  }

  MergeForest forest;

 private:
  Id add(Id vertex) {
    forest.vertices.push_back(vertex);
    forest.parent.push_back(no_id);
    return forest.size() - 1;
  }

  std::vector<Id> older_;       ///< of each extremum one that it was joined to
  std::vector<Id> newest_;      ///< of the oldest in each component: the latest node
  std::vector<bool> has_root_;  ///< of the oldest in each component
};

/// Numbers nodes anew: as the side comes to them.
void sort_nodes(const SidePlaces& comes_before, MergeForest& forest) {
  std::vector<Id> sorted(forest.vertices.size()), number(sorted.size());
  std::iota(sorted.begin(), sorted.end(), Id(0));
  parallel_sort("GALE::sort_nodes", sorted.begin(), sorted.end(),
                [&](Id a, Id b) { return comes_before(forest.vertices[a], forest.vertices[b]); });
  for (std::size_t i = 0; i < sorted.size(); ++i) number[sorted[i]] = static_cast<Id>(i);
  const auto renumbered = [&](Id node) { return node == no_id ? no_id : number[node]; };
  MergeForest to = forest;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    to.vertices[i] = forest.vertices[sorted[i]];
    to.parent[i] = renumbered(forest.parent[sorted[i]]);
  }
  std::transform(forest.leaf.begin(), forest.leaf.end(), to.leaf.begin(), renumbered);
  std::transform(forest.branch_end.begin(), forest.branch_end.end(), to.branch_end.begin(), renumbered);
  forest = std::move(to);
}

}  // namespace

MergeForest merge_forest(Side side, const std::vector<Id>& extrema, const std::vector<Meeting>& meetings,
                         std::vector<Meeting> lasts) {
  const SidePlaces comes_before{side};
  ExtremumJoiner joiner(extrema);
  for (std::size_t i = 0, next = 0; i < meetings.size(); i = next) {
    stop_if_asked_at(static_cast<std::int64_t>(i));
    while (next < meetings.size() && meetings[next].vertex == meetings[i].vertex) ++next;
    joiner.join(meetings.data() + i, meetings.data() + next);
  }
  parallel_sort("GALE::sort_lasts", lasts.begin(), lasts.end(),
                [&](const Meeting& a, const Meeting& b) { return comes_before(b.vertex, a.vertex); });
  for (const Meeting& last : lasts) joiner.end_at(last);
  sort_nodes(comes_before, joiner.forest);
  return std::move(joiner.forest);
}

PrunedForest pruned(const MergeForest& forest, const std::vector<bool>& stays) {
  const Id count = forest.size();
  // Each node has so many arcs from below whose branches have something that stays; the last of these is kept. A
  // leaf that stays counts as two, as it is a node by itself.
  std::vector<Id> arcs(count, 0), last_arc(count, no_id), nearest(count), number(count, no_id);
  for (std::size_t place = 0; place < stays.size(); ++place) {
    if (stays[place]) arcs[forest.leaf[place]] = 2;
  }
  PrunedForest result;
  for (Id node = 0; node < count; ++node) {
    const Id parent = forest.parent[node];
    if (arcs[node] > 0 && parent != no_id) {
      ++arcs[parent];
      last_arc[parent] = node;
    }
    if (arcs[node] > 1 || parent == no_id) {
      number[node] = static_cast<Id>(result.nodes.size());
      nearest[node] = number[node];
      result.nodes.push_back(node);
    } else if (arcs[node] == 1) {
      nearest[node] = nearest[last_arc[node]];
    }
  }
  result.parent.resize(result.nodes.size(), no_id);
  std::vector<Id> next_kept(count, no_id);  // of each node the next one above it that is a node still
  for (Id node = count - 1; node >= 0; --node) {
    const Id parent = forest.parent[node];
    if (parent == no_id) continue;
    next_kept[node] = number[parent] != no_id ? number[parent] : next_kept[parent];
    if (number[node] != no_id) result.parent[number[node]] = next_kept[node];
    if (arcs[node] == 0) nearest[node] = nearest[parent];
  }
  result.place = std::move(nearest);
  return result;
}

std::vector<bool> persistent_extrema(const MergeForest& forest, const std::function<double(Id)>& value,
                                     double threshold) {
  std::vector<bool> stays(forest.leaf.size(), true);
  for (std::size_t place = 0; place < stays.size(); ++place) {
    const Id end = forest.branch_end[place];
    if (end == no_id) continue;
    const double one = value(forest.vertices[forest.leaf[place]]), other = value(forest.vertices[end]);
    stays[place] = !((one == other ? 0 : one < other ? other - one : one - other) < threshold);
  }
  return stays;
}

std::vector<Id> parents_among(Side side, const MergeForest& forest, const std::vector<Id>& base) {
  const Id count = static_cast<Id>(base.size());
  std::vector<Id> parents(count, no_id), first(forest.size(), no_id), last(forest.size(), no_id);
  for (Id i = 0; i < count; ++i) {
    const Id node = side == below ? i : count - 1 - i, arc = base[node];
    if (first[arc] == no_id) {
      first[arc] = node;
    } else {
      parents[last[arc]] = node;
    }
    last[arc] = node;
  }
  for (Id arc = 0; arc < forest.size(); ++arc) {
    if (forest.parent[arc] != no_id) parents[last[arc]] = first[forest.parent[arc]];
  }
  return parents;
}

}  // namespace gale::detail
