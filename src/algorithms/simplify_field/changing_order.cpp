#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include <gale/algorithms/simplify_field/changing_order.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

ChangingOrder::ChangingOrder(Structure& structure, const VertexOrder& order, const SweepOptions& options)
    : structure_(structure), threads_(options.threads), place_(order.mesh().vertices(), no_id) {
  const Id count = order.mesh().vertices();
  const HostExecutionSpace space;
  const auto keys = allocate<Array<std::uint64_t, HostMemory>>("GALE::sorted_keys", count);
  Kokkos::deep_copy(keys, order.keys_in<HostMemory>());
  const auto sorted = iota("GALE::vertices_by_rank", space, count);
  stable_sort_by_key(space, keys, sorted);
  rank_ = keys;
  by_rank_.assign(sorted.data(), sorted.data() + count);
  parallel_for("GALE::ranks", space, count, [&](Offset i) { rank_(by_rank_[i]) = static_cast<std::uint64_t>(i); });
  value_of_.resize(count);
  std::iota(value_of_.begin(), value_of_.end(), Id(0));
  graph_ = extremum_graph(structure, rank_.data(), options);
}

void ChangingOrder::fill(Side side, std::vector<FilledBranch> branches) {
  gather_rows(branches);
  in_turns(threads_, static_cast<std::int64_t>(branches.size()),
           [&](int, std::int64_t i) { flood(side, branches[i], static_cast<Id>(i)); });
  reorder(side, branches);
  update_graph();
  for (const Id vertex : changed_) place_[vertex] = no_id;
}

void ChangingOrder::gather_rows(const std::vector<FilledBranch>& branches) {
  changed_.clear();
  for (const FilledBranch& branch : branches) {
    changed_.push_back(branch.saddle);
    changed_.insert(changed_.end(), branch.vertices.begin(), branch.vertices.end());
  }
  parallel_sort("GALE::sort_changed", changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  const auto count = static_cast<Offset>(changed_.size());
  for (Offset i = 0; i < count; ++i) place_[changed_[i]] = static_cast<Id>(i);
  branch_.assign(count, no_id);
  for (std::size_t number = 0; number < branches.size(); ++number) {
    for (const Id vertex : branches[number].vertices) branch_[place_[vertex]] = static_cast<Id>(number);
  }
  // Each thread has its own rows first.
  std::vector<std::vector<Id>> parts(threads_);
  row_begin_.assign(count + 1, 0);
  for_parts("GALE::rows_of_changed", count, threads_, [&](int part, Offset begin, Offset end) {
    const auto consumer = structure_.consumer();
    for (Offset i = begin; i < end; ++i) {
      stop_if_asked_at(i);
      const Row row = consumer->row(Relation::VV, changed_[i]);
      parts[part].insert(parts[part].end(), row.begin(), row.end());
      row_begin_[i + 1] = row.size();
    }
  });
  std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
  rows_.clear();
  rows_.reserve(row_begin_.back());
  for (auto& part : parts) {
    rows_.insert(rows_.end(), part.begin(), part.end());
    part = {};
  }
}

/// From the saddle on, what the side comes to first among all that touches what was flooded: so what rises goes on
/// rising, and few vertices become extrema of the other side.
void ChangingOrder::flood(Side side, FilledBranch& branch, Id number) {
  const SideKeys keys(rank_.data(), side);
  using Entry = std::pair<std::uint64_t, Id>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
  const auto reach = [&](Id from) {
    for (Offset i = row_begin_[place_[from]]; i < row_begin_[place_[from] + 1]; ++i) {
      const Id place = place_[rows_[i]];
      if (place == no_id || branch_[place] != number) continue;
      branch_[place] = no_id;
      next.emplace(keys[rows_[i]], rows_[i]);
    }
  };
  std::size_t flooded = 0;
  for (reach(branch.saddle); !next.empty(); ++flooded) {
    stop_if_asked_at(static_cast<std::int64_t>(flooded));
    const Id vertex = next.top().second;
    next.pop();
    branch.vertices[flooded] = vertex;
    reach(vertex);
  }
}

void ChangingOrder::reorder(Side side, const std::vector<FilledBranch>& branches) {
  const auto count = static_cast<Id>(by_rank_.size());
  std::vector<bool> moves(count, false);
  std::vector<std::pair<Id, Id>> of_saddles;  // of each saddle, by its place among what changes, its branches
  for (std::size_t number = 0; number < branches.size(); ++number) {
    of_saddles.emplace_back(place_[branches[number].saddle], static_cast<Id>(number));
    for (const Id vertex : branches[number].vertices) {
      moves[vertex] = true;
      value_of_[vertex] = value_of_[branches[number].saddle];
    }
  }
  std::sort(of_saddles.begin(), of_saddles.end());
  const std::vector<Id> before = std::exchange(by_rank_, std::vector<Id>(count));
  Id place = 0;
  const auto put = [&](Id vertex) {
    const Id rank = side == below ? place : count - 1 - place;
    by_rank_[rank] = vertex;
    rank_(vertex) = static_cast<std::uint64_t>(rank);
    ++place;
  };
  for (Id i = 0; i < count; ++i) {
    stop_if_asked_at(i);
    const Id vertex = before[side == below ? i : count - 1 - i];
    if (moves[vertex]) continue;
    put(vertex);
    if (place_[vertex] == no_id) continue;
    for (auto at = std::lower_bound(of_saddles.begin(), of_saddles.end(), std::make_pair(place_[vertex], Id(0)));
         at != of_saddles.end() && at->first == place_[vertex]; ++at)
      for (const Id filled : branches[at->second].vertices) put(filled);
  }
}

void ChangingOrder::update_graph() {
  const auto changes = [&](Id vertex) { return place_[vertex] != no_id; };
  for (auto& side : graph_) {
    side.extrema.erase(std::remove_if(side.extrema.begin(), side.extrema.end(), changes), side.extrema.end());
    side.meetings.erase(std::remove_if(side.meetings.begin(), side.meetings.end(),
                                       [&](const Meeting& meeting) { return changes(meeting.vertex); }),
                        side.meetings.end());
  }
  std::vector<ExtremumFinder> finders(threads_, ExtremumFinder(rank_.data()));
  for_parts("GALE::graph_of_changed", static_cast<Offset>(changed_.size()), threads_,
            [&](int part, Offset begin, Offset end) {
              const auto consumer = structure_.consumer();
              for (Offset i = begin; i < end; ++i) {
                stop_if_asked_at(i);
                const Row neighbours{rows_.data() + row_begin_[i], static_cast<Id>(row_begin_[i + 1] - row_begin_[i])};
                const auto next = finders[part].visit(changed_[i], neighbours, consumer->link(changed_[i]));
                for (const Side side : {below, above}) graph_[side].next(changed_[i]) = next[side];
              }
            });
  add_found(finders, graph_);
}

}  // namespace gale::detail
