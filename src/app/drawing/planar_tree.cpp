#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>

#include <gale/app/drawing/planar_tree.hpp>
#include <gale/base/ordered.hpp>

namespace gale::app {

namespace {

/// A leaf and all from there to where it hangs on another branch.
struct Branch {
  Id arc;    ///< by which it is known: one of the arcs that it was merged of
  bool up;   ///< whether its leaf is its upper end
  Id leaf;   ///< a node
  Id end;    ///< the other end
  Id hangs;  ///< an arc of what it hangs on; no_id for what is left in the end
};

/// Prunes leaf after leaf. Arcs that meet in a regular node become one.
class Pruning {
 public:
  Pruning(const MergeTree& tree, const std::vector<double>& heights)
      : heights_(heights), merged_(tree.arcs.size()), alive_(tree.arcs.size(), true) {
    for (auto& at : arcs_at_) at.resize(heights.size());
    std::iota(merged_.begin(), merged_.end(), Id(0));
    for (const MergeArc& arc : tree.arcs) {
      const auto id = static_cast<Id>(ends_.size());
      ends_.push_back({arc.lower, arc.upper});
      arcs_at_[0][arc.upper].push_back(id);
      arcs_at_[1][arc.lower].push_back(id);
    }
    for (Id arc = 0; arc < static_cast<Id>(ends_.size()); ++arc) push(arc);
    while (!queue_.empty()) {
      const Leaf leaf = queue_.top();
      queue_.pop();
      prune(leaf);
    }
    for (Id arc = 0; arc < static_cast<Id>(ends_.size()); ++arc) {
      if (alive_[arc]) branches.push_back({arc, true, ends_[arc][1], ends_[arc][0], no_id});
    }
    std::stable_sort(branches.begin(), branches.end(), [&](const Branch& a, const Branch& b) {
      return a.hangs != no_id ? b.hangs == no_id : b.hangs == no_id && length(a.arc) < length(b.arc);
    });
  }

  /// The arc by which the branch of an arc is known.
  Id known_by(Id arc) { return root_of(merged_, arc); }

  std::vector<Branch> branches;  ///< in the order in which they were pruned, then the longest way of each component

 private:
  /// How long an arc with a leaf was, the arc, and whether the leaf is its upper end.
  using Leaf = std::tuple<double, Id, bool>;

  double length(Id arc) const { return heights_[ends_[arc][1]] - heights_[ends_[arc][0]]; }

  void push(Id arc) {
    for (const bool up : {false, true}) {
      const Id leaf = ends_[arc][up];
      if (arcs_at_[0][leaf].size() + arcs_at_[1][leaf].size() == 1) queue_.emplace(length(arc), arc, up);
    }
  }

  /// Prunes it if it still is one, and leaves an arc that goes its way: else the leaf is the last thing there.
  void prune(const Leaf& found) {
    const auto [was, arc, up] = found;
    if (!alive_[arc] || length(arc) != was) return;
    const Id leaf = ends_[arc][up], saddle = ends_[arc][!up];
    auto& beside = arcs_at_[up][saddle];
    if (beside.size() < 2) return;
    alive_[arc] = false;
    beside.erase(std::find(beside.begin(), beside.end(), arc));
    branches.push_back({arc, up, leaf, saddle, beside.front()});
    const auto &lower = arcs_at_[0][saddle], &upper = arcs_at_[1][saddle];
    if (lower.size() == 1 && upper.size() == 1) {
      merge(lower.front(), upper.front());
    } else if (lower.size() + upper.size() == 1) {
      push(beside.front());
    }
  }

  void merge(Id arc, Id upper) {
    const Id end = ends_[upper][1];
    merged_[upper] = arc;
    alive_[upper] = false;
    ends_[arc][1] = end;
    auto& there = arcs_at_[0][end];
    *std::find(there.begin(), there.end(), upper) = arc;
    push(arc);
  }

  const std::vector<double>& heights_;
  std::vector<std::array<Id, 2>> ends_;                                 ///< of each arc: lower, upper
  std::array<std::vector<std::vector<Id>>, 2> arcs_at_;                 ///< of each node: from below, from above
  std::vector<Id> merged_;                                              ///< of each arc one that it was merged into
  std::vector<bool> alive_;                                             ///< of each arc
  std::priority_queue<Leaf, std::vector<Leaf>, std::greater<>> queue_;  ///< the shortest first
};

/// Gives branches columns, and cuts them into arcs.
class TreeLayout {
 public:
  TreeLayout(const MergeTree& tree, const std::vector<double>& heights, Id most)
      : heights_(heights), pruning_(tree, heights), branches_(pruning_.branches) {
    const auto count = static_cast<Id>(branches_.size());
    first_ = std::max(Id(0), count - most);
    find_parents(tree);
    place_columns();
    made_.branches = count;
    made_.shown = count - first_;
    cut_into_arcs();
    for (Id arc = 0; arc < static_cast<Id>(tree.arcs.size()); ++arc)
      made_.arc_of.push_back(arc_at(branch_of_[pruning_.known_by(arc)], tree.arcs[arc].lower));
  }

  PlanarTree take() { return std::move(made_); }

 private:
  bool is_shown(Id branch) const { return branch >= first_; }

  void find_parents(const MergeTree& tree) {
    branch_of_.resize(tree.arcs.size(), no_id);
    parent_.resize(branches_.size(), no_id);
    children_.resize(branches_.size());
    splits_.resize(branches_.size());
    for (std::size_t i = 0; i < branches_.size(); ++i) branch_of_[branches_[i].arc] = static_cast<Id>(i);
    for (auto i = static_cast<Id>(branches_.size()) - 1; i >= 0; --i) {
      const Branch& branch = branches_[i];
      if (branch.hangs == no_id) continue;
      Id parent = branch_of_[pruning_.known_by(branch.hangs)];
      // Several may hang on one node: all on the branch that goes through it.
      while (parent_[parent] != no_id && branches_[parent].end == branch.end) parent = parent_[parent];
      parent_[i] = parent;
      if (!is_shown(i)) continue;
      children_[parent].push_back(i);
      if (branch.end != branches_[parent].end && branch.end != branches_[parent].leaf)
        splits_[parent].push_back(branch.end);
    }
    for (auto& splits : splits_) {
      std::sort(splits.begin(), splits.end());
      splits.erase(std::unique(splits.begin(), splits.end()), splits.end());
    }
  }

  void place_columns() {
    int kinds[2] = {0, 0};
    for (std::size_t i = first_; i < branches_.size(); ++i) {
      if (branches_[i].hangs != no_id) ++kinds[branches_[i].up];
    }
    alternates_ = kinds[0] == 0 || kinds[1] == 0;
    column_.resize(branches_.size());
    for (auto i = static_cast<Id>(branches_.size()) - 1; is_shown(i); --i) {
      if (branches_[i].hangs == no_id) place(i);
    }
  }

  /// What hangs on a branch comes beside it from the nearest to the farthest in the order in which no line from there
  /// to the branch crosses one that is nearer.
  void place(Id branch) {
    auto& children = children_[branch];
    const auto key = [&](Id child) {
      const Branch& one = branches_[child];
      return std::tuple(one.up, one.up ? -one.end : one.end, child);
    };
    std::sort(children.begin(), children.end(), [&](Id a, Id b) { return key(a) < key(b); });
    std::vector<Id> sides[2];
    for (std::size_t i = 0; i < children.size(); ++i)
      sides[alternates_ ? i % 2 : branches_[children[i]].up].push_back(children[i]);
    for (auto child = sides[0].rbegin(); child != sides[0].rend(); ++child) place(*child);
    column_[branch] = columns_++;
    for (const Id child : sides[1]) place(child);
  }

  double x_of(Id branch) const { return (column_[branch] + 0.5) / columns_; }

  PlanarTree::Place at(Id branch, Id node) const { return {x_of(branch), heights_[node]}; }

  void cut_into_arcs() {
    std::vector<PlanarTree::Node> nodes;
    first_arc_.resize(branches_.size());
    for (std::size_t i = first_; i < branches_.size(); ++i) {
      const auto id = static_cast<Id>(i);
      const Branch& branch = branches_[i];
      const Id hangs_on = branch.hangs == no_id ? id : parent_[i];
      nodes.push_back({branch.leaf, at(id, branch.leaf)});
      nodes.push_back({branch.end, at(hangs_on, branch.end)});
      first_arc_[i] = static_cast<Id>(made_.arcs.size());
      std::vector<Id> stops = splits_[i];
      stops.insert(stops.begin(), branch.up ? branch.end : branch.leaf);
      stops.push_back(branch.up ? branch.leaf : branch.end);
      for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        std::vector<PlanarTree::Place> path = {at(id, stops[k]), at(id, stops[k + 1])};
        if (branch.up && k == 0 && hangs_on != id) path.insert(path.begin(), at(hangs_on, branch.end));
        if (!branch.up && k + 2 == stops.size()) path.push_back(at(hangs_on, branch.end));
        made_.arcs.push_back(std::move(path));
      }
    }
    std::stable_sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
    for (const auto& node : nodes) {
      if (made_.nodes.empty() || made_.nodes.back().node != node.node) made_.nodes.push_back(node);
    }
  }

  /// The arc that is drawn for what begins on a branch at a node.
  Id arc_at(Id branch, Id node) const {
    bool up = true;
    while (!is_shown(branch)) {
      node = branches_[branch].end;
      up = branches_[branch].up;
      branch = parent_[branch];
      if (branch == no_id) return no_id;
    }
    const auto& splits = splits_[branch];
    const auto place = up ? std::upper_bound(splits.begin(), splits.end(), node)
                          : std::lower_bound(splits.begin(), splits.end(), node);
    return first_arc_[branch] + static_cast<Id>(place - splits.begin());
  }

  const std::vector<double>& heights_;
  Pruning pruning_;
  const std::vector<Branch>& branches_;
  Id first_ = 0;                           ///< that is shown
  std::vector<Id> branch_of_;              ///< of arcs by which branches are known
  std::vector<Id> parent_;                 ///< of each branch what it hangs on
  std::vector<std::vector<Id>> children_;  ///< of each branch the shown ones that hang on it
  std::vector<std::vector<Id>> splits_;    ///< of each branch the nodes where these do, ascending
  std::vector<Id> first_arc_;              ///< of each that is shown
  std::vector<int> column_;
  int columns_ = 0;
  bool alternates_ = false;  ///< whether what hangs on a branch goes left and right in turns
  PlanarTree made_;
};

}  // namespace

PlanarTree planar_tree(const MergeTree& tree, const std::vector<double>& heights, Id most) {
  return TreeLayout(tree, heights, most).take();
}

}  // namespace gale::app
