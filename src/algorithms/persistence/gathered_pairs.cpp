#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/gathered_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/persistence/columns_on_ranks.hpp>
#include <gale/algorithms/persistence/ends_on_ranks.hpp>
#include <gale/algorithms/persistence/simplices_of_all.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>
#include <gale/mesh/exchange/global_index.hpp>

namespace gale {

namespace detail {

namespace {

class PairsOnRanks {
 public:
  PairsOnRanks(const DiscreteGradient& gradient, int threads, std::size_t most_bytes)
      : gradient_(gradient),
        critical_(gradient.critical()),
        mesh_(gradient.mesh()),
        ranks_(mesh_.exchange().ranks()),
        is_first_(ranks_.rank() == 0),
        threads_(threads),
        most_bytes_(most_bytes) {
    together(ranks_, [&] {
      gradient.store().bring_pairs_to_host();
      places_.emplace(critical_);
    });
  }

  GatheredPairs find() {
    gather();
    std::optional<PairsOfExtrema> pairs;
    GatheredPairs found{mesh_, {}, {}};
    together(ranks_, [&] {
      found.mesh = name_highest(found.highest);
      if (!is_first_) return;
      ExtremumEnds ends;
      ends.of_edges = ends_in(ends_of_edges_, all_[1], all_[0]);
      ends.of_facets = ends_in(ends_of_facets_, all_[mesh_.dimension() - 1], all_[mesh_.dimension()]);
      pairs.emplace(filtration_, ends, mesh_.dimension());
    });
    std::vector<Id> uppers;
    if (mesh_.dimension() == 3) {
      const std::vector<Id> own_columns = share_columns(pairs ? pairs->columns() : std::vector<Id>());
      std::unique_ptr<SaddleColumns> columns;
      together(ranks_,
               [&] { columns = std::make_unique<SaddleColumns>(gradient_, *places_, own_, own_columns, threads_); });
      uppers = finish_on_ranks(gradient_, *places_, *columns, own_,
                               {all_[1].value().place, all_[2].value().place, filtration_});
    }
    together(ranks_, [&] {
      if (is_first_) found.pairs = pairs->with_saddles(uppers);
    });
    return found;
  }

 private:
  using All = std::optional<SimplicesOfAll>;

  /// Brings the critical simplices of all ranks to the first, with the ends of saddles, and its highest vertex from
  /// each.
  void gather() {
    std::array<std::vector<SentSimplex>, 4> own;
    std::vector<SentSimplex> highest;
    Outcome sorted;  // of which the others hear when they have followed paths
    EndsOfSaddles ends;
    const auto sort_own = [&] {
      own_ = filtration_of(gradient_, threads_);
      own = simplices_to_send(gradient_, own_);
    };
    meanwhile([&] { sorted = tried(sort_own); }, [&] { ends = ends_on_ranks(gradient_, *places_); });
    std::vector<std::int64_t> bytes(ranks_.size(), 0);
    together(ranks_, [&] {
      if (sorted.was_stopped) throw Stopped();
      if (sorted.has_failed) throw Error(sorted.failure);
      highest = highest_to_send(gradient_);  // by a kernel: not beside others
      for (const auto& some : own) bytes[0] += static_cast<std::int64_t>(some.size() * sizeof(SentSimplex));
      bytes[0] += static_cast<std::int64_t>((ends.of_edges.size() + ends.of_facets.size()) * sizeof(SentEnds));
    });
    require_room(ranks_, "critical simplices", bytes, most_bytes_);
    std::array<EntriesByRank<SentSimplex>, 4> received;
    std::tie(received[0], received[1], received[2], received[3], highest_, ends_of_edges_, ends_of_facets_) =
        lists_to_first(ranks_, "GALE::critical_of_all", own[0], own[1], own[2], own[3], highest, ends.of_edges,
                       ends.of_facets);
    together(ranks_, [&] {
      for (int d = 0; d <= mesh_.dimension(); ++d) {
        const SimplicesOfAll& all = all_[d].emplace(std::move(received[d]));
        std::vector<Id>& by_rank = filtration_.by_rank[d];
        std::vector<Id>& rank = filtration_.rank[d];
        by_rank = unwritten<Id>(all.from_rank.size());
        rank = unwritten<Id>(all.from_rank.size());
        parallel_for("GALE::filtration_of_all", HostExecutionSpace(), by_rank.size(), [&](Offset i) {
          by_rank[i] = all.place.entries(all.from_rank[i]);
          rank[by_rank[i]] = static_cast<Id>(i);
        });
      }
    });
  }

  /// Makes a mesh of the vertices that are the highest of critical simplices.
  Mesh name_highest(HighestVertices& highest) const {
    const SentSimplex* last = nullptr;
    for (Offset i = 0; i < highest_.count(); ++i) {
      const SentSimplex& one = highest_.entries(i);
      if (last == nullptr || std::make_pair(last->value, last->highest()) < std::make_pair(one.value, one.highest()))
        last = &one;
    }
    const GlobalIds ids = distinct_ids(highest_names(last)).ids;
    const GlobalIndex index(ids);
    highest.dimension = mesh_.dimension();
    if (last != nullptr) highest.of_all = index.find(last->highest());
    for (int d = 0; d <= mesh_.dimension(); ++d) {
      const SimplicesOfAll& all = *all_[d];
      std::vector<Id>& of_critical = highest.of_critical[d];
      of_critical.resize(all.sent.count());
      parallel_for("GALE::highest_of_critical", HostExecutionSpace(), all.sent.count(),
                   [&](Offset i) { of_critical[all.place.entries(i)] = index.find(all.sent.entries(i).highest()); });
    }
    const auto no_cells = allocate<GlobalIds>("GALE::no_cells", 0);
    return mesh_.dimension() == 3 ? excerpt_mesh<4>(ids, no_cells, CellCorners<4, Id, HostMemory>())
                                  : excerpt_mesh<3>(ids, no_cells, CellCorners<3, Id, HostMemory>());
  }

  /// The highest vertices of critical simplices, and that of `last`, if there is one; some several times.
  GlobalIds highest_names(const SentSimplex* last) const {
    Offset count = last == nullptr ? 0 : 1;
    for (int d = 0; d <= mesh_.dimension(); ++d) count += all_[d]->sent.count();
    const auto names = allocate<GlobalIds>("GALE::highest_names", count);
    Offset begin = 0;
    for (int d = 0; d <= mesh_.dimension(); ++d) {
      const EntriesByRank<SentSimplex>& sent = all_[d]->sent;
      parallel_for("GALE::highest_names", HostExecutionSpace(), sent.count(),
                   [&](Offset i) { names(begin + i) = sent.entries(i).highest(); });
      begin += sent.count();
    }
    if (last != nullptr) names(begin) = last->highest();
    return names;
  }

  /// The ends of saddles' paths by places.
  static PathEnds ends_in(const EntriesByRank<SentEnds>& sent, const All& saddles, const All& extrema) {
    PathEnds ends(sent.count(), {no_id, no_id});
    parallel_for("GALE::ends_of_all", HostExecutionSpace(), sent.count(), [&](Offset i) {
      for (int k = 0; k < 2; ++k) {
        const SentEnd& end = sent.entries(i)[k];
        if (end.rank == SentEnd::outside) continue;
        ends[saddles->place.entries(i)][k] = extrema->place.entries(extrema->place.begin[end.rank] + end.place);
      }
    });
    return ends;
  }

  /// Tells each rank which of its critical triangles are among the first rank's columns: in the order of the
  /// filtration.
  std::vector<Id> share_columns(const std::vector<Id>& columns) {
    EntriesByRank<char> marks;
    together(ranks_, [&] {
      std::vector<char> is_column(is_first_ ? filtration_.rank[2].size() : 0, 0);
      for (const Id column : columns) is_column[column] = 1;
      const auto& place = all_[2]->place;
      marks = room_by_rank<char>("GALE::columns", counts_of(place));
      parallel_for("GALE::columns", HostExecutionSpace(), place.count(),
                   [&](Offset i) { marks.entries(i) = is_column[place.entries(i)]; });
    });
    const auto received = exchange(ranks_, "GALE::own_columns", marks);
    std::vector<Id> own;
    for (const Id triangle : own_.by_rank[2]) {
      if (received.entries(triangle) != 0) own.push_back(triangle);
    }
    return own;
  }

  const DiscreteGradient& gradient_;
  const CriticalSimplices& critical_;
  const Mesh mesh_;
  const Ranks& ranks_;
  const bool is_first_;
  const int threads_;
  const std::size_t most_bytes_;
  std::optional<CriticalPlaces> places_;
  Filtration own_, filtration_;  ///< of this rank's simplices, and on the first one of those of all
  std::array<All, 4> all_;
  EntriesByRank<SentSimplex> highest_;
  EntriesByRank<SentEnds> ends_of_edges_, ends_of_facets_;
};

}  // namespace

}  // namespace detail

GatheredPairs gather_persistence_pairs(const DiscreteGradient& gradient, const SweepOptions& options,
                                       std::size_t most_bytes) {
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  const auto find = [&](const DiscreteGradient& whole) {
    return GatheredPairs{whole.mesh(), highest_vertices(whole), find_persistence_pairs(whole, options)};
  };
  if (ranks.size() == 1) return find(gradient);
  detail::together(ranks, [&] { detail::require_thread_count(options.threads); });
  const ThreadLimit limit(options.threads);
  if (ranks.sum(detail::has_forks(gradient) ? 1 : 0) == 0)
    return detail::PairsOnRanks(gradient, options.threads, most_bytes).find();
  const DiscreteGradient gathered = gather_gradient(gradient, most_bytes);
  std::optional<GatheredPairs> found;
  detail::together(ranks, [&] { found = find(gathered); });
  return *found;
}

}  // namespace gale
