#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/gathered_gradient.hpp>
#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/persistence/columns_on_ranks.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/threads.hpp>

namespace gale {

namespace detail {

namespace {

/// A critical simplex as the first rank gets it.
struct SentSimplex {
  std::array<GlobalId, 3> name;  ///< what CriticalSimplices are sorted by: its vertices, ascending, or the cell
  std::uint64_t value;           ///< of its highest vertex, as VertexOrder::value_key
  Id rank;                       ///< in its own rank's filtration
  Id place_of_highest;           ///< of that vertex in `name`, where a cell has it behind its own number

  GlobalId highest() const { return name[place_of_highest]; }
};

/// Has a rank's simplices be written as they are sent.
class Sender {
 public:
  explicit Sender(const DiscreteGradient& gradient)
      : gradient_(gradient),
        exchange_(gradient.mesh().exchange()),
        vertex_input_(gradient.mesh().vertices_in_input()),
        cell_input_(gradient.mesh().cells_in_input()) {}

  /// A simplex with its vertices from the highest to the lowest.
  template <std::size_t N>
  SentSimplex operator()(const std::array<Id, N>& vertices, Id rank) const {
    std::array<GlobalId, N> ids;
    for (std::size_t i = 0; i < N; ++i) ids[i] = id(vertices[i]);
    const std::array<GlobalId, N> name = ascending(ids);
    SentSimplex sent{{}, gradient_.order().value_key(vertices[0]), rank, 0};
    for (std::size_t i = 0; i < N; ++i) {
      sent.name[i] = name[i];
      if (name[i] == ids[0]) sent.place_of_highest = static_cast<Id>(i);
    }
    return sent;
  }

  SentSimplex of_cell(Id cell, Id rank) const {
    const Id vertex = highest_corner(gradient_, cell);
    return {{exchange_.cell_id(cell_input_[cell]), id(vertex), 0}, gradient_.order().value_key(vertex), rank, 1};
  }

 private:
  GlobalId id(Id vertex) const { return exchange_.vertex_id(vertex_input_[vertex]); }

  const DiscreteGradient& gradient_;
  const Exchange& exchange_;
  const OtherIds vertex_input_, cell_input_;
};

/// Entries of all ranks, which ascend by `is_less` on each, in that order.
template <class T, class IsLess>
std::vector<Id> merged(const Dealt<T>& dealt, std::vector<Id> order, const IsLess& is_less) {
  merge_runs(order.begin(), dealt.begin, [&](Id a, Id b) { return is_less(dealt.entries(a), dealt.entries(b)); });
  return order;
}

/// Critical simplices of one dimension of all ranks, on the first one.
struct AllOfDimension {
  Dealt<SentSimplex> sent;
  Dealt<Id> place;            ///< of each
  std::vector<Id> from_rank;  ///< by rank in the filtration: the entry

  explicit AllOfDimension(Dealt<SentSimplex> from) : sent(std::move(from)), place{{}, sent.begin} {
    std::vector<Id> order(sent.count());
    std::iota(order.begin(), order.end(), Id(0));
    place.entries = allocate<Array<Id, HostMemory>>("GALE::places_of_all", sent.count());
    const auto by_name = merged(sent, order, [](const auto& a, const auto& b) { return a.name < b.name; });
    for (std::size_t i = 0; i < by_name.size(); ++i) place.entries(by_name[i]) = static_cast<Id>(i);
    for (std::size_t r = 0; r + 1 < sent.begin.size(); ++r) {
      for (Offset i = sent.begin[r]; i < sent.begin[r + 1]; ++i)
        order[sent.begin[r] + sent.entries(i).rank] = static_cast<Id>(i);
    }
    from_rank = merged(sent, std::move(order), [](const auto& a, const auto& b) {
      return a.value != b.value ? a.value < b.value : a.highest() < b.highest();
    });
  }
};

/// Where a path from a saddle ends: the rank that has the extremum, and its place there; outside.
struct SentEnd {
  static constexpr int outside = -1;
  int rank = outside;
  Id place = no_id;
};
using SentEnds = std::array<SentEnd, 2>;

/// Follows the paths from some simplices (GALE's ids) to their ends, each rank in its part.
class Followers {
 public:
  /// Collective. `places` has those of this rank's critical simplices.
  Followers(const PathSimplices& simplices, const CriticalPlaces& places)
      : simplices_(simplices),
        places_(places),
        ranks_(simplices.mesh().exchange().ranks()),
        successors_(simplices.successors().in<HostMemory>().data()) {}

  std::vector<SentEnd> operator()(const std::vector<Id>& starts) {
    std::vector<Stop> stops;
    std::vector<Id> open;
    together(ranks_, [&] {
      stops.resize(starts.size());
      follow_each_path(
          "GALE::follow_here", successors_, static_cast<Offset>(starts.size()), [&](Offset i) { return starts[i]; },
          [&](Offset i, Id last, Id next) { stops[i] = stop_at(last, next); });
      for (std::size_t i = 0; i < stops.size(); ++i) {
        if (stops[i].next >= 0) open.push_back(static_cast<Id>(i));
      }
    });
    while (ranks_.sum(static_cast<std::int64_t>(open.size())) != 0) {
      const auto answers = ask<Stop>(
          ranks_, "GALE::ends_elsewhere", static_cast<Offset>(open.size()), [&](Id i) { return stops[open[i]].rank; },
          [&](Id i) { return stops[open[i]].next; }, [&](GlobalId id) { return follow(simplices_.local(id)); });
      std::vector<Id> still;
      for (std::size_t i = 0; i < open.size(); ++i) {
        stops[open[i]] = answers(i);
        if (answers(i).next >= 0) still.push_back(open[i]);
      }
      open.swap(still);
    }
    std::vector<SentEnd> ends;
    together(ranks_, [&] {
      reserve(ends, stops.size());
      for (const Stop& stop : stops) ends.push_back({stop.rank, stop.place});
    });
    return ends;
  }

 private:
  /// Where a path ends, or which rank follows it on from where.
  struct Stop {
    int rank = SentEnd::outside;
    Id place = no_id;
    GlobalId next = -1;
  };

  Stop follow(Id at) const {
    while (successors_[at] >= 0) at = successors_[at];
    return stop_at(at, successors_[at]);
  }

  Stop stop_at(Id last, Id next) const {
    if (next == no_id)
      return {ranks_.rank(), simplices_.are_vertices() ? places_.of_vertex(last) : places_.of_cell(last), -1};
    if (next == DiscreteGradient::elsewhere) return {simplices_.owner(last), no_id, simplices_.global(last)};
    return {};
  }

  const PathSimplices& simplices_;
  const CriticalPlaces& places_;
  const Ranks& ranks_;
  const Id* const successors_;
};

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
      places_.emplace(critical_);
      own_ = filtration_of(gradient, threads);
    });
  }

  GatheredPairs find() {
    const auto of_edges = edge_ends(), of_facets = facet_ends();
    gather();
    const auto edge_ends_of_all = to_first(ranks_, "GALE::ends_of_edges", of_edges);
    const auto facet_ends_of_all = to_first(ranks_, "GALE::ends_of_facets", of_facets);
    std::optional<PairsOfExtrema> pairs;
    GatheredPairs found{mesh_, {}, {}};
    together(ranks_, [&] {
      found.mesh = name_highest(found.highest);
      if (!is_first_) return;
      ExtremumEnds ends;
      ends.of_edges = ends_in(edge_ends_of_all, all_[1], all_[0]);
      ends.of_facets = ends_in(facet_ends_of_all, all_[mesh_.dimension() - 1], all_[mesh_.dimension()]);
      pairs.emplace(filtration_, ends, mesh_.dimension(), threads_);
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
  using All = std::optional<AllOfDimension>;

  std::vector<SentEnds> edge_ends() {
    std::vector<Id> starts;
    together(ranks_, [&] {
      reserve(starts, 2 * critical_.edges.size());
      for (const auto& [high, low] : critical_.edges) starts.insert(starts.end(), {high, low});
    });
    const auto simplices = PathSimplices::make(gradient_, PathSimplices::Kind::falling_vertices);
    const auto ends = Followers(*simplices, *places_)(starts);
    std::vector<SentEnds> by_edge;
    together(ranks_, [&] {
      reserve(by_edge, critical_.edges.size());
      for (std::size_t i = 0; i < ends.size(); i += 2) by_edge.push_back({ends[i], ends[i + 1]});
    });
    return by_edge;
  }

  std::vector<SentEnds> facet_ends() {
    const auto simplices = PathSimplices::make(gradient_, PathSimplices::Kind::rising_cells);
    const auto ends = Followers(*simplices, *places_)(critical_.star);
    std::vector<SentEnds> by_facet;
    together(ranks_, [&] {
      reserve(by_facet, critical_.star_begin.size());
      for (std::size_t i = 0; i + 1 < critical_.star_begin.size(); ++i) {
        const Id first = critical_.star_begin[i], count = critical_.star_begin[i + 1] - first;
        by_facet.push_back({});
        for (Id k = 0; k < count; ++k) by_facet.back()[k] = ends[first + k];
      }
    });
    return by_facet;
  }

  /// This rank's critical simplices.
  std::array<std::vector<SentSimplex>, 4> own_simplices() const {
    const Sender sender(gradient_);
    std::array<std::vector<SentSimplex>, 4> own;
    const auto add = [&](int dimension, const auto& simplices, const auto& sent_as) {
      const std::vector<Id>& rank = own_.rank[dimension];
      own[dimension] = std::vector<SentSimplex>(simplices.size());
      parallel_for("GALE::own_simplices", HostExecutionSpace(), simplices.size(),
                   [&](Offset i) { own[dimension][i] = sent_as(simplices[i], rank[i]); });
    };
    add(0, critical_.vertices, [&](Id vertex, Id rank) { return sender(std::array<Id, 1>{vertex}, rank); });
    add(1, critical_.edges, sender);
    add(2, critical_.triangles, sender);
    add(mesh_.dimension(), critical_.cells, [&](Id cell, Id rank) { return sender.of_cell(cell, rank); });
    return own;
  }

  /// Brings the critical simplices of all ranks to the first, and its highest vertex from each.
  void gather() {
    std::array<std::vector<SentSimplex>, 4> own;
    std::vector<SentSimplex> highest;
    std::vector<std::int64_t> bytes(ranks_.size(), 0);
    together(ranks_, [&] {
      own = own_simplices();
      const std::uint64_t* const keys = gradient_.order().keys();
      const Interval owned = mesh_.owned_vertices();
      if (owned.size() > 0) {
        const auto at = std::max_element(keys + owned.first, keys + owned.last) - keys;
        highest.push_back(Sender(gradient_)(std::array<Id, 1>{static_cast<Id>(at)}, 0));
      }
      for (const auto& some : own) bytes[0] += static_cast<std::int64_t>(some.size() * sizeof(SentSimplex));
      bytes[0] +=
          static_cast<std::int64_t>((critical_.edges.size() + critical_.star_begin.size() - 1) * sizeof(SentEnds));
    });
    require_room(ranks_, "critical simplices", bytes, most_bytes_);
    for (int d = 0; d <= mesh_.dimension(); ++d) {
      auto received = to_first(ranks_, "GALE::critical_of_all", own[d]);
      together(ranks_, [&] {
        all_[d].emplace(std::move(received));
        reserve(filtration_.by_rank[d], all_[d]->from_rank.size());
        for (const Id entry : all_[d]->from_rank) filtration_.by_rank[d].push_back(all_[d]->place.entries(entry));
        filtration_.rank[d].resize(filtration_.by_rank[d].size());
        for (std::size_t i = 0; i < filtration_.rank[d].size(); ++i)
          filtration_.rank[d][filtration_.by_rank[d][i]] = static_cast<Id>(i);
      });
    }
    highest_ = to_first(ranks_, "GALE::highest_of_all", highest);
  }

  /// Makes a mesh of the vertices that are the highest of critical simplices.
  Mesh name_highest(HighestVertices& highest) const {
    std::vector<GlobalId> names;
    reserve(names, std::accumulate(all_.begin(), all_.begin() + mesh_.dimension() + 1, Offset(1),
                                   [](Offset sum, const All& all) { return sum + all->sent.count(); }));
    for (int d = 0; d <= mesh_.dimension(); ++d) {
      for (Offset i = 0; i < all_[d]->sent.count(); ++i) names.push_back(all_[d]->sent.entries(i).highest());
    }
    const SentSimplex* last = nullptr;
    for (Offset i = 0; i < highest_.count(); ++i) {
      const SentSimplex& one = highest_.entries(i);
      if (last == nullptr || std::make_pair(last->value, last->highest()) < std::make_pair(one.value, one.highest()))
        last = &one;
    }
    if (last != nullptr) names.push_back(last->highest());
    keep_distinct(names);
    const auto ids = allocate<GlobalIds>("GALE::highest_ids", names.size());
    std::copy(names.begin(), names.end(), ids.data());
    const GlobalIndex index(ids);
    highest.dimension = mesh_.dimension();
    if (last != nullptr) highest.of_all = index.find(last->highest());
    for (int d = 0; d <= mesh_.dimension(); ++d) {
      highest.of_critical[d].resize(all_[d]->sent.count());
      for (Offset i = 0; i < all_[d]->sent.count(); ++i)
        highest.of_critical[d][all_[d]->place.entries(i)] = index.find(all_[d]->sent.entries(i).highest());
    }
    const auto no_cells = allocate<GlobalIds>("GALE::no_cells", 0);
    return mesh_.dimension() == 3 ? excerpt_mesh<4>(ids, no_cells, CellCorners<4, Id, HostMemory>())
                                  : excerpt_mesh<3>(ids, no_cells, CellCorners<3, Id, HostMemory>());
  }

  /// The ends of saddles' paths by places.
  static PathEnds ends_in(const Dealt<SentEnds>& sent, const All& saddles, const All& extrema) {
    PathEnds ends(sent.count(), {no_id, no_id});
    for (Offset i = 0; i < sent.count(); ++i) {
      for (int k = 0; k < 2; ++k) {
        const SentEnd& end = sent.entries(i)[k];
        if (end.rank == SentEnd::outside) continue;
        ends[saddles->place.entries(i)][k] = extrema->place.entries(extrema->place.begin[end.rank] + end.place);
      }
    }
    return ends;
  }

  /// Tells each rank which of its critical triangles are among the first rank's columns: in the order of the
  /// filtration.
  std::vector<Id> share_columns(const std::vector<Id>& columns) {
    Dealt<char> marks;
    together(ranks_, [&] {
      std::vector<char> is_column(is_first_ ? filtration_.rank[2].size() : 0, 0);
      for (const Id column : columns) is_column[column] = 1;
      const auto& place = all_[2]->place;
      marks = dealt<char>("GALE::columns", counts_of(place));
      for (Offset i = 0; i < place.count(); ++i) marks.entries(i) = is_column[place.entries(i)];
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
  Dealt<SentSimplex> highest_;
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
  const ThreadLimit limit(options.threads);
  if (ranks.sum(detail::has_forks(gradient) ? 1 : 0) == 0)
    return detail::PairsOnRanks(gradient, std::max(options.threads, 1), most_bytes).find();
  const DiscreteGradient gathered = gather_gradient(gradient, most_bytes);
  std::optional<GatheredPairs> found;
  detail::together(ranks, [&] { found = find(gathered); });
  return *found;
}

}  // namespace gale
