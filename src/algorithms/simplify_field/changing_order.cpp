#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include <gale/algorithms/simplify_field/changing_order.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

namespace {

/// Turns lengths into where rows begin, and puts the parts of all threads one after the other.
void join(std::vector<std::vector<Id>>& parts, std::vector<Offset>& begin, std::vector<Id>& all) {
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  all.clear();
  all.reserve(begin.back());
  for (auto& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    part = {};
  }
}

}  // namespace

ChangingOrder::ChangingOrder(Structure& structure, const VertexOrder& order, const SweepOptions& options)
    : structure_(structure), threads_(options.threads), place_(order.mesh().vertices(), no_id) {
  const Id count = order.mesh().vertices();
  const HostExecutionSpace space;
  const auto keys = allocate<Array<std::uint64_t, HostMemory>>("GALE::sorted_keys", count);
  Kokkos::deep_copy(keys, order.keys_in<HostMemory>());
  by_rank_ = iota("GALE::vertices_by_rank", space, count);
  stable_sort_by_key(space, keys, by_rank_);
  rank_ = keys;
  parallel_for("GALE::ranks", space, count, [&](Offset i) { rank_(by_rank_[i]) = static_cast<std::uint64_t>(i); });
  value_of_.resize(count);
  std::iota(value_of_.begin(), value_of_.end(), Id(0));
  graph_ = extremum_graph(structure, rank_.data(), options);
}

void ChangingOrder::fill(Side side, std::vector<FilledBranch> branches, ChangingRoom& room) {
  gather_rows(branches);
  in_turns(threads_, static_cast<std::int64_t>(branches.size()),
           [&](int, std::int64_t i) { flood(side, branches[i], static_cast<Id>(i)); });
  reorder(side, branches, room);
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
  // Each thread has its own rows and links first.
  std::vector<std::vector<Id>> parts(threads_), links(threads_);
  for (auto* const begin : {&row_begin_, &link_begin_}) begin->assign(count + 1, 0);
  shapes_.resize(count);
  for_parts("GALE::rows_of_changed", count, threads_, [&](int part, Offset begin, Offset end) {
    const auto consumer = structure_.consumer();
    for (Offset i = begin; i < end; ++i) {
      stop_if_asked_at(i);
      const Row row = consumer->row(Relation::VV, changed_[i]);
      parts[part].insert(parts[part].end(), row.begin(), row.end());
      row_begin_[i + 1] = row.size();
      shapes_[i] = consumer->link(changed_[i]);
      const std::size_t bytes = std::size_t(shapes_[i].others) * shapes_[i].count * shapes_[i].width;
      link_begin_[i + 1] = static_cast<Offset>((bytes + sizeof(Id) - 1) / sizeof(Id));
      auto& words = links[part];
      words.resize(words.size() + link_begin_[i + 1]);
      if (bytes > 0) std::memcpy(words.data() + words.size() - link_begin_[i + 1], shapes_[i].places, bytes);
    }
  });
  join(parts, row_begin_, rows_);
  join(links, link_begin_, links_);
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

void ChangingOrder::reorder(Side side, const std::vector<FilledBranch>& branches, ChangingRoom& room) {
  const auto& new_place = room.places;
  const HostExecutionSpace space;
  const auto count = static_cast<Id>(by_rank_.extent(0));
  const auto turned = [&](Offset rank) { return side == below ? rank : count - 1 - rank; };
  const auto place_before = [&](Id vertex) { return turned(static_cast<Offset>(rank_(vertex))); };
  parallel_for("GALE::clear_places", space, count, [&](Offset i) { new_place(i) = 1; });
  std::vector<std::pair<Id, Id>> of_saddles;  // of each saddle, by its place among what changes, its branches
  for (std::size_t number = 0; number < branches.size(); ++number) {
    const auto& [saddle, vertices] = branches[number];
    of_saddles.emplace_back(place_[saddle], static_cast<Id>(number));
    for (const Id vertex : vertices) {
      new_place(place_before(vertex)) = 0;
      value_of_[vertex] = value_of_[saddle];
    }
  }
  for (const auto& [saddle, vertices] : branches) new_place(place_before(saddle)) += static_cast<Id>(vertices.size());
  std::sort(of_saddles.begin(), of_saddles.end());
  exclusive_scan("GALE::new_places", space, count, new_place, [&](Offset i) { return new_place(i); });
  std::swap(by_rank_, room.vertices_before);
  parallel_for("GALE::new_ranks", space, count, [&](Offset i) {
    const Id vertex = room.vertices_before(turned(i)), together = new_place(i + 1) - new_place(i);
    if (together == 0) return;
    Id place = new_place(i);
    const auto put = [&](Id one) {
      const auto rank = turned(place++);
      by_rank_(rank) = one;
      rank_(one) = static_cast<std::uint64_t>(rank);
    };
    put(vertex);
    if (together == 1) return;
    for (auto at = std::lower_bound(of_saddles.begin(), of_saddles.end(), std::make_pair(place_[vertex], Id(0)));
         at != of_saddles.end() && at->first == place_[vertex]; ++at) {
      for (const Id filled : branches[at->second].vertices) put(filled);
    }
  });
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
              for (Offset i = begin; i < end; ++i) {
                stop_if_asked_at(i);
                const Row neighbours{rows_.data() + row_begin_[i], static_cast<Id>(row_begin_[i + 1] - row_begin_[i])};
                LinkRow link = shapes_[i];
                link.places = links_.data() + link_begin_[i];
                const auto next = finders[part].visit(changed_[i], neighbours, link);
                for (const Side side : {below, above}) graph_[side].next(changed_[i]) = next[side];
              }
            });
  add_found(finders, graph_);
}

}  // namespace gale::detail
