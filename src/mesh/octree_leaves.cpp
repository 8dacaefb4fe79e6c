#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/octree_leaves.hpp>

namespace gale::detail {

namespace {

template <class Memory>
using Codes = Array<std::uint64_t, Memory>;

/// The octree cell that holds the codes of equal `code >> shift`, looked at around the sorted position `at`, which it
/// holds. It is searched no further than `capacity` positions away.
template <class Memory>
struct CellWindow {
  const Codes<Memory>& codes;
  int shift;
  Id at;
  Id capacity;

  KOKKOS_FUNCTION bool inside(Id i) const { return (codes(i) >> shift) == (codes(at) >> shift); }

  KOKKOS_FUNCTION Id begin() const {
    Id low = at > capacity ? at - capacity : 0;
    Id high = at;
    while (low < high) {
      const Id middle = low + (high - low) / 2;
      if (inside(middle)) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  }

  /// Does the cell hold more than `capacity` codes? If `first` is where it begins, as `begin()` says.
  KOKKOS_FUNCTION bool overflows(Id first) const {
    return static_cast<Offset>(first) + capacity < static_cast<Offset>(codes.extent(0)) && inside(first + capacity);
  }
};

/// Levels of the octree at which two different codes lie in the same cell.
KOKKOS_FUNCTION int common_levels(std::uint64_t a, std::uint64_t b) {
  int shift = 3 * (morton_levels - 1);
  int levels = 0;
  while (levels < morton_levels && (a >> shift) == (b >> shift)) {
    ++levels;
    shift -= 3;
  }
  return levels;
}

template <class Memory>
KOKKOS_FUNCTION Id run_begin(const Codes<Memory>& codes, Id at) {
  Id low = 0, high = at;
  while (low < high) {
    const Id middle = low + (high - low) / 2;
    if (codes(middle) == codes(at)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

/// A leaf begins where the smallest cell that holds both a code and its predecessor has more than `capacity` codes.
template <class Memory>
KOKKOS_FUNCTION bool begins_leaf(const Codes<Memory>& codes, Id at, Id capacity) {
  if (at == 0) return true;
  if (codes(at - 1) == codes(at)) {
    if (at < capacity || codes(at - capacity) != codes(at)) return false;
    return (at - run_begin(codes, at)) % capacity == 0;
  }
  const int levels = common_levels(codes(at - 1), codes(at));
  const CellWindow<Memory> cell{codes, 3 * (morton_levels - levels), at, capacity};
  return cell.overflows(cell.begin());
}

}  // namespace

template <class Space>
std::vector<Id> octree_leaves(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& codes, int capacity) {
  using Ids = Array<Id, MemoryOf<Space>>;
  const auto count = static_cast<Id>(codes.extent(0));
  const auto leaf_of = allocate<Ids>("GALE::leaf_of", count + Offset(1));
  const Id limit = capacity;
  const Id leaves = exclusive_scan(
      "GALE::octree_leaves", space, count, leaf_of,
      KOKKOS_LAMBDA(Offset i) { return begins_leaf(codes, static_cast<Id>(i), limit) ? 1 : 0; });
  const auto begin = allocate<Ids>("GALE::leaf_begin", leaves);
  parallel_for(
      "GALE::leaf_begin", space, count, KOKKOS_LAMBDA(Offset i) {
        if (leaf_of(i + 1) > leaf_of(i)) begin(leaf_of(i)) = static_cast<Id>(i);
      });
  const auto begin_on_host = on_host(begin);
  return {begin_on_host.data(), begin_on_host.data() + leaves};
}

#define GALE_INSTANTIATE(Space) \
  template std::vector<Id> octree_leaves(const Space&, const Array<std::uint64_t, MemoryOf<Space>>&, int)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

std::vector<Id> merge_leaves(const std::vector<Id>& leaves, Id count, int capacity) {
  std::vector<Id> begin;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    const Id end = leaf + 1 < leaves.size() ? leaves[leaf + 1] : count;
    if (begin.empty() || end - begin.back() > capacity) begin.push_back(leaves[leaf]);
  }
  begin.push_back(count);
  return begin;
}

}  // namespace gale::detail
