#include <algorithm>
#include <string>
#include <utility>

#include <gale/algorithms/merge_tree/computed_graph.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/simplify_field.hpp>
#include <gale/algorithms/simplify_field/field_on_ranks.hpp>
#include <gale/algorithms/simplify_field/removed_branches.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale {

namespace detail {

namespace {

/// Removes minima and maxima in turns.
template <class Space>
class FieldSimplifier {
 public:
  FieldSimplifier(ChangingOrder<Space>& order, const ChooseExtrema& staying)
      : order_(order), staying_(staying), room_(static_cast<Id>(order.value_of().extent(0))) {}

  void run() {
    // A part that hangs on the rest by one vertex is turned around without end.
    constexpr int most_in_vain = 16;
    Id least = 0;
    int in_vain = 0, clean = 0;
    for (Side side = below; clean < 2 && in_vain < most_in_vain; side = opposite(side)) {
      RemovedBranches removed = removed_branches(order_, side, staying_, room_);
      extrema[side] = removed.extrema;
      unwanted[side] = removed.unwanted;
      clean = removed.unwanted == 0 ? clean + 1 : 0;
      if (removed.unwanted > 0 && (least == 0 || removed.unwanted < least)) {
        least = removed.unwanted;
        in_vain = 0;
      } else {
        ++in_vain;
      }
      if (removed.unwanted > 0) order_.fill(side, std::move(removed.branches), room_);
    }
    if (clean == 2) return;
    for (const Side side : {below, above}) {
      const RemovedBranches left = removed_branches(order_, side, staying_, room_);
      extrema[side] = left.extrema;
      unwanted[side] = left.unwanted;
    }
  }

  Id extrema[2] = {0, 0}, unwanted[2] = {0, 0};

 private:
  ChangingOrder<Space>& order_;
  const ChooseExtrema& staying_;
  ChangingRoom<MemoryOf<Space>> room_;
};

/// The places of vertices by their input ids.
template <class Space>
void write_ranks(const Space& space, const Mesh& mesh, const std::uint64_t* keys, std::vector<Id>& to) {
  using Memory = MemoryOf<Space>;
  reserve(to, mesh.vertices());
  to.resize(mesh.vertices());
  Array<Id, Memory> rank;
  if constexpr (is_device<Space>) {
    rank = allocate<Array<Id, Memory>>("GALE::simplified_ranks", mesh.vertices());
  } else {
    rank = Array<Id, Memory>(to.data(), to.size());
  }
  const OtherIds input = mesh.vertices_in_input<Memory>();
  parallel_for(
      "GALE::simplified_ranks", space, mesh.vertices(),
      KOKKOS_LAMBDA(Offset v) { rank(input[static_cast<Id>(v)]) = static_cast<Id>(keys[v]); });
  space.fence();
  if constexpr (is_device<Space>) copy_from_device(to.data(), rank.data(), to.size() * sizeof(Id));
}

/// `choose(order)` says which extrema of the changing order stay. `structure()` has the rows of what changes.
template <class Space, class Choose>
SimplifiedField simplified_in(const Space& space, const VertexOrder& order, ExtremumGraph<MemoryOf<Space>> graph,
                              std::function<Structure&()> structure, int threads, const Choose& choose) {
  const Mesh& mesh = order.mesh();
  ChangingOrder<Space> changing(space, order, std::move(graph), ChangedStars(mesh, std::move(structure)), threads);
  const ChooseExtrema staying = choose(changing);
  SimplifiedField field;
  {
    FieldSimplifier<Space> simplifier(changing, staying);
    simplifier.run();
    field.minima = simplifier.extrema[below];
    field.maxima = simplifier.extrema[above];
    field.kept_below = simplifier.unwanted[below] + simplifier.unwanted[above];
  }
  write_ranks(space, mesh, changing.keys(), field.rank);
  reserve(field.value_of, mesh.vertices());
  field.value_of.resize(mesh.vertices());
  const OtherIds input = mesh.vertices_in_input();
  parallel_for("GALE::simplified_field", HostExecutionSpace(), mesh.vertices(),
               [&](Offset v) { field.value_of[input[v]] = input[changing.value_of()(v)]; });
  return field;
}

/// The field simplified where there is room.
template <class Choose>
SimplifiedField simplified(const VertexOrder& order, const ComputeOptions& options, Computed* computed,
                           const Choose& choose) {
  Computing computing(order.mesh(), options, computed);
  return with_extremum_graph(computing, order, options, [&](const auto& space, auto graph, const auto& structure) {
    return simplified_in(space, order, std::move(graph), structure, options.threads, choose);
  });
}

/// Says by which of its extrema a field is known, and that these are the given ones.
class GivenExtrema {
 public:
  GivenExtrema(const VertexOrder& order, const StayingExtrema& staying) : mesh_(order.mesh()) {
    for (const Side side : {below, above}) {
      stays_[side].resize(mesh_.vertices(), false);
      for (const Id vertex : side == below ? staying.minima : staying.maxima) {
        if (vertex < 0 || vertex >= mesh_.vertices())
          throw Error("vertex " + std::to_string(vertex) + ", which is to stay, is none of the mesh's " +
                      std::to_string(mesh_.vertices()));
        stays_[side][mesh_.vertices_of_input()[vertex]] = true;
      }
    }
  }

  /// Throws gale::Error for one that is none.
  template <class Memory>
  void require_extrema(const ExtremumGraph<Memory>& graph) const {
    for (const Side side : {below, above}) {
      auto others = stays_[side];
      for (const Id vertex : graph[side].extrema) others[vertex] = false;
      const auto other = std::find(others.begin(), others.end(), true);
      if (other != others.end())
        throw Error("vertex " + std::to_string(id_of(static_cast<Id>(other - others.begin()))) +
                    ", which is to stay, is no " + name_of(side) + " of the field");
    }
  }

  std::vector<bool> operator()(Side side, const MergeForest& forest) {
    std::vector<bool> stays;
    for (const Id node : forest.leaf) stays.push_back(stays_[side][forest.vertices[node]]);
    if (!std::exchange(is_checked_[side], true)) require_all_components(side, forest, stays);
    return stays;
  }

 private:
  GlobalId id_of(Id vertex) const { return mesh_.vertex_id(mesh_.vertices_in_input()[vertex]); }
  static std::string name_of(Side side) { return side == below ? "minimum" : "maximum"; }

  void require_all_components(Side side, const MergeForest& forest, const std::vector<bool>& stays) const {
    std::vector<bool> has_one(forest.size(), false);
    for (std::size_t place = 0; place < stays.size(); ++place) {
      if (stays[place]) has_one[forest.leaf[place]] = true;
    }
    for (Id node = 0; node < forest.size(); ++node) {
      if (forest.parent[node] != no_id) {
        if (has_one[node]) has_one[forest.parent[node]] = true;
      } else if (!has_one[node]) {
        throw Error("no " + name_of(side) + " is to stay in the component of vertex " +
                    std::to_string(id_of(forest.vertices[node])));
      }
    }
  }

  const Mesh mesh_;
  std::vector<bool> stays_[2];  ///< by GALE's vertex
  bool is_checked_[2] = {false, false};
};

}  // namespace

}  // namespace detail

SimplifiedField simplify_field(const VertexOrder& order, const std::function<double(Id)>& value, double threshold,
                               const ComputeOptions& options, Computed* computed) {
  detail::together(order.mesh().exchange().ranks(), [&] {
    detail::require_threshold(threshold);
    if (!value) throw Error("a field simplified by persistence needs its values");
  });
  if (order.mesh().exchange().ranks().size() > 1)
    return detail::simplified_on_ranks(order, value, threshold, options, computed);
  const OtherIds input = order.mesh().vertices_in_input();
  return detail::simplified(order, options, computed, [&](const auto& changing) {
    return [&, input](detail::Side, const detail::MergeForest& forest) {
      const auto value_at = [&](Id vertex) {
        const Id from = input[changing.value_of()(vertex)];
        return detail::known_value(value(from), from);
      };
      return detail::persistent_extrema(forest, value_at, threshold);
    };
  });
}

SimplifiedField simplify_field(const VertexOrder& order, const StayingExtrema& staying, const ComputeOptions& options,
                               Computed* computed) {
  if (order.mesh().exchange().ranks().size() > 1) return detail::simplified_on_ranks(order, staying, options, computed);
  detail::GivenExtrema given(order, staying);
  return detail::simplified(order, options, computed, [&](const auto& changing) {
    given.require_extrema(changing.graph());
    return std::ref(given);
  });
}

}  // namespace gale
