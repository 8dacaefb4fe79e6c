#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/persistence/columns_on_ranks.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

namespace {

/// An edge of a column, by its place among the critical ones of the rank that has it. A column that comes back to a
/// rank may bring an edge again: an even number of times is none.
struct ColumnEdge {
  Id column, edge;
};

/// An edge that another rank lets fall, by global ids, and the place of its column, in 64 bits to be packed without
/// gaps.
struct SentEdge {
  GlobalId high, low, column;
};

/// A column and the 1-saddle that it has met, by places on a rank.
struct Met {
  Id triangle, edge;
};

/// Sends entries to the first rank, and notes there how much it was. Collective.
template <class T>
EntriesByRank<T> noted_to_first(const Ranks& ranks, const char* label, const std::vector<T>& entries) {
  auto received = to_first(ranks, label, entries);
  ranks.note_gathered(received.count() * static_cast<std::int64_t>(sizeof(T)));
  return received;
}

/// Lets columns fall to their ends on all ranks, each on any of their threads.
class FallOnRanks {
 public:
  FallOnRanks(const DiscreteGradient& gradient, const CriticalPlaces& places, const SaddleColumns& columns)
      : gradient_(gradient),
        mesh_(gradient.mesh()),
        ranks_(mesh_.exchange().ranks()),
        places_(places),
        columns_(columns),
        threads_(host_threads()) {}

  /// The critical edges of the columns that have stopped, of all that have met one of these edges, and so on: on the
  /// first rank. This rank's are numbered from these two on, in the order of the edges that they have met. Collective.
  EntriesByRank<ColumnEdge> operator()(Id first_stopped, Id first_met) {
    std::vector<Falling> falling;
    together(ranks_, [&] {
      number_.assign(columns_.saddles(), no_id);
      columns_.for_each_met([&](Id edge, const Column&) { number_[edge] = first_met++; });
      for (const Column& column : columns_.stopped()) falling.push_back({first_stopped++, &column.rim, {}});
    });
    in_rounds<SentEdge>(ranks_, "GALE::falling_edges", [&](const auto& received) {
      take(received, falling);
      fall_all(std::exchange(falling, {}));
      return sent_exits();
    });
    auto all = noted_to_first(ranks_, "GALE::column_edges", fallen_);
    fallen_.clear();
    return all;
  }

 private:
  /// One thread's part.
  struct Fall {
    explicit Fall(const EdgeChain& empty) : chain(empty) {}

    EdgeChain chain;
    std::vector<ColumnEdge> fallen;
    std::vector<SentEdge> exits;
  };

  /// What is to fall of a column: all of its rim, or a part.
  struct Falling {
    Id column;
    const std::vector<LowerEdge>* rim;
    std::vector<LowerEdge> part;  ///< where there is no rim

    const std::vector<LowerEdge>& edges() const { return rim != nullptr ? *rim : part; }
  };

  /// Lets some columns fall, and those whose edges they meet, each of these from when it is met.
  void fall_all(std::vector<Falling> columns) {
    if (columns.empty()) return;
    const EdgeChain empty(gradient_);  // brings the gradient to the host, on all threads
    std::vector<std::unique_ptr<Fall>> falls(threads_);
    in_turns_with_more(threads_, std::move(columns), [&](int thread, const Falling& falling, auto& more) {
      if (!falls[thread]) falls[thread] = std::make_unique<Fall>(empty);
      fall_to_end(falling, *falls[thread], more);
    });
    append_taken(falls, &Fall::fallen, fallen_);
    append_taken(falls, &Fall::exits, exits_);
  }

  /// Appends what all threads have of something.
  template <class T>
  static void append_taken(const std::vector<std::unique_ptr<Fall>>& falls, std::vector<T> Fall::*member,
                           std::vector<T>& all) {
    for (const auto& fall : falls) {
      if (!fall) continue;
      const auto& some = (*fall).*member;
      all.insert(all.end(), some.begin(), some.end());
    }
  }

  /// Lets what there is of a column fall, and adds others that it meets to what falls; where threads wait for such,
  /// half of a wide column, too: it is a sum.
  void fall_to_end(const Falling& falling, Fall& here, SharedItems<Falling>& more) {
    constexpr int stars_at_once = 64;
    constexpr std::size_t wide = 64;
    const OtherIds input = mesh_.vertices_in_input();
    const Id column = falling.column;
    const auto on_critical = [&](Id high, Id low) {
      const Id edge = places_.of_edge(high, low);
      here.fallen.push_back({column, edge});
      const Id other = atomic_read(&number_[edge]) == no_id ? no_id : atomic_exchange(&number_[edge], no_id);
      if (other != no_id) more({other, &columns_.owner(edge)->rim, {}});
    };
    const auto elsewhere = [&](Id high, Id low) {
      here.exits.push_back({mesh_.vertex_id(input[high]), mesh_.vertex_id(input[low]), column});
    };
    here.chain.add(falling.edges());
    while (here.chain.fall_from(stars_at_once, on_critical, elsewhere)) {
      if (here.chain.size() >= wide && more.are_short()) more({column, nullptr, here.chain.split()});
    }
  }

  /// Takes edges of columns that come here to what is to fall.
  void take(const EntriesByRank<SentEdge>& received, std::vector<Falling>& falling) const {
    const OtherIds internal = mesh_.vertices_of_input();
    const auto here = [&](GlobalId vertex) { return internal[mesh_.vertex_of(vertex)]; };
    std::vector<SentEdge> edges(received.entries.data(), received.entries.data() + received.count());
    std::stable_sort(edges.begin(), edges.end(),
                     [](const SentEdge& a, const SentEdge& b) { return a.column < b.column; });
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (i == 0 || edges[i].column != edges[i - 1].column)
        falling.push_back({static_cast<Id>(edges[i].column), nullptr, {}});
      falling.back().part.push_back({here(edges[i].high), here(edges[i].low)});
    }
  }

  /// What others have to follow, by rank.
  EntriesByRank<SentEdge> sent_exits() {
    const std::vector<SentEdge> exits = std::exchange(exits_, {});
    return entries_by_rank<SentEdge>(
        ranks_.size(), "GALE::sent_edges", static_cast<Offset>(exits.size()),
        [&](Id i) { return mesh_.exchange().owner(mesh_.vertex_of(exits[i].high)); }, [&](Id i) { return exits[i]; });
  }

  const DiscreteGradient& gradient_;
  const Mesh mesh_;
  const Ranks& ranks_;
  const CriticalPlaces& places_;
  const SaddleColumns& columns_;
  const int threads_;
  std::vector<Id> number_;  ///< of the column that has met each critical edge, until it falls
  std::vector<ColumnEdge> fallen_;
  std::vector<SentEdge> exits_;  ///< that others have to follow
};

/// Columns on the first rank: those that stopped, by rank, then those that have met a 1-saddle on their ranks. It knows
/// the edges of the former, and of all of the latter that these come to.
class ColumnsOfAll {
 public:
  ColumnsOfAll(const GatheredSaddles& all, const EntriesByRank<Id>& stopped, const EntriesByRank<Met>& met,
               const EntriesByRank<ColumnEdge>& fallen)
      : filtration_(all.filtration),
        stopped_(static_cast<Id>(stopped.count())),
        columns_(stopped.count() + met.count()),
        owner_(filtration_.by_rank[1].size(), no_id) {
    const auto edge = [&](int rank, Id place) {
      return filtration_.rank[1][all.edges.entries(all.edges.begin[rank] + place)];
    };
    const auto triangle = [&](int rank, Id place) {
      return filtration_.rank[2][all.triangles.entries(all.triangles.begin[rank] + place)];
    };
    Id column = 0;
    for_each_received(stopped, [&](int rank, Id place) { columns_[column++].rank = triangle(rank, place); });
    for_each_received(met, [&](int rank, const Met& one) {
      columns_[column].rank = triangle(rank, one.triangle);
      owner_[edge(rank, one.edge)] = column++;
    });
    for_each_received(
        fallen, [&](int rank, const ColumnEdge& one) { columns_[one.column].edges.push_back(edge(rank, one.edge)); });
  }

  /// Goes on with the columns that stopped. Returns for each 1-saddle, by place, the 2-saddle that it is paired with.
  std::vector<Id> finish() {
    for (Id column = 0; column < stopped_; ++column) reduce(column);
    std::vector<Id> uppers(owner_.size(), no_id);
    for (std::size_t i = 0; i < owner_.size(); ++i) {
      if (owner_[i] != no_id) uppers[filtration_.by_rank[1][i]] = filtration_.by_rank[2][columns_[owner_[i]].rank];
    }
    return uppers;
  }

 private:
  struct OneColumn {
    Id rank = 0;            ///< of the 2-saddle, in the filtration
    std::vector<Id> edges;  ///< ranks of critical edges in the filtration; an even number of times is none
  };

  void put(Id edge) {
    heap_.push_back(edge);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// Sets `highest` to the highest edge of the column at hand; false if nothing is left of it.
  bool find_highest(Id& highest) {
    while (!heap_.empty()) {
      highest = heap_.front();
      bool is_odd = false;
      while (!heap_.empty() && heap_.front() == highest) {
        std::pop_heap(heap_.begin(), heap_.end());
        heap_.pop_back();
        is_odd = !is_odd;
      }
      if (!is_odd) continue;
      put(highest);
      return true;
    }
    return false;
  }

  void reduce(Id column) {
    heap_ = columns_[column].edges;
    std::make_heap(heap_.begin(), heap_.end());
    for (Id highest = 0; find_highest(highest);) {
      stop_if_asked();
      const Id other = owner_[highest];
      if (other == no_id || columns_[other].rank > columns_[column].rank) {
        columns_[column].edges = heap_;
        owner_[highest] = column;
        if (other == no_id) return;
        column = other;
      }
      for (const Id edge : columns_[other].edges) put(edge);
    }
  }

  const Filtration& filtration_;
  const Id stopped_;  ///< how many there are of these
  std::vector<OneColumn> columns_;
  std::vector<Id> owner_;  ///< the column that has met each 1-saddle, by its rank in the filtration; no_id: none has
  std::vector<Id> heap_;
};

}  // namespace

std::vector<Id> finish_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                const SaddleColumns& columns, const Filtration& own, const GatheredSaddles& all) {
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  std::vector<Id> stopped;
  std::vector<Met> met;
  together(ranks, [&] {
    for (const Column& column : columns.stopped()) stopped.push_back(own.by_rank[2][column.rank]);
    columns.for_each_met([&](Id edge, const Column& column) { met.push_back({own.by_rank[2][column.rank], edge}); });
  });
  const auto count = [](const auto& some) { return static_cast<std::int64_t>(some.size()); };
  const Id first_stopped = static_cast<Id>(ranks.sum_before(count(stopped)));
  const Id first_met = static_cast<Id>(ranks.sum(count(stopped)) + ranks.sum_before(count(met)));
  const auto all_stopped = noted_to_first(ranks, "GALE::stopped_columns", stopped);
  const auto all_met = noted_to_first(ranks, "GALE::met_saddles", met);
  const auto fallen = FallOnRanks(gradient, places, columns)(first_stopped, first_met);
  std::vector<Id> uppers;
  together(ranks, [&] {
    if (ranks.rank() == 0) uppers = ColumnsOfAll(all, all_stopped, all_met, fallen).finish();
  });
  return uppers;
}

}  // namespace gale::detail
