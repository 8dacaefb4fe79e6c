#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
#include <gale/mesh/encode/cells.hpp>

namespace gale::detail {

namespace {

/// Vertices in a group, as a power of two: a core's own cache holds the cells of which they are the lowest.
constexpr int group_bits = 8;

/// Sorts the cells of one group of lowest vertices after the other. For one thread.
template <int corners>
class GroupSorter {
 public:
  explicit GroupSorter(const SortedCells<HostMemory>& sorted)
      : quads_(sorted.of_lowest.entries.data()),
        input_(sorted.input.data()),
        begin_(sorted.of_lowest.offsets.data()),
        vertices_(static_cast<Id>(sorted.of_lowest.offsets.extent(0)) - 1) {}

  /// Sorts those of a group, which are at [begin, end) in any order, and says where each vertex's begin. Returns
  /// whether they are good.
  bool sort(Id group, Id begin, Id end) {
    const Id first = group << group_bits, last = std::min(vertices_ - first, 1 << group_bits) + first;
    std::fill(next_.begin(), next_.end(), 0);
    for (Id t = begin; t < end; ++t) ++next_[quads_[t].a - first];
    for (Id v = first, at = 0; v < last; ++v) {
      begin_[v] = begin + at;
      at += std::exchange(next_[v - first], at);
    }
    if (keys_.size() < static_cast<std::size_t>(end - begin)) keys_.resize(end - begin);
    for (Id t = begin; t < end; ++t) {
      const Quad quad = quads_[t];
      insert(key_of(quad, input_[t]), begin_[quad.a] - begin, next_[quad.a - first]++);
    }
    for (Id v = first; v < last; ++v) write(v, begin, begin_[v] - begin, next_[v - first]);
    return are_good<corners>(quads_, begin, end);
  }

 private:
  /// The other three vertices of a cell, and where it stood in the input.
  __extension__ typedef unsigned __int128 Key;

  /// Tetrahedra of a vertex that are sorted by insertion.
  static constexpr Id few = 32;

  static Key key_of(const Quad& quad, Id input) {
    return Key(pair_key(quad.b, quad.c)) << 64 | pair_key(quad.d, input);
  }

  void insert(Key key, Id first, Id at) {
    for (; at > first && at - first < few && key < keys_[at - 1]; --at) keys_[at] = keys_[at - 1];
    keys_[at] = key;
  }

  void write(Id vertex, Id begin, Id first, Id last) {
    if (last - first > few) std::sort(keys_.begin() + first, keys_.begin() + last);
    for (Id i = first; i < last; ++i) {
      const auto high = static_cast<std::uint64_t>(keys_[i] >> 64), low = static_cast<std::uint64_t>(keys_[i]);
      quads_[begin + i] = {vertex, pair_first(high), pair_second(high), pair_first(low)};
      input_[begin + i] = pair_second(low);
    }
  }

  Quad* quads_;
  Id *input_, *begin_;
  Id vertices_;
  std::array<Id, 1 << group_bits> next_;
  std::vector<Key> keys_;
};

/// Where each part of the input writes its first tetrahedron of each group, and where groups begin.
struct GroupPlaces {
  std::vector<std::vector<Id>> of_parts;
  std::vector<Id> begin;
  bool are_all = true;  ///< whether all vertices of all cells are there
};

template <int corners, class Index>
GroupPlaces places_of_groups(const Renumbered<corners, Index>& input, Offset count, Offset groups) {
  GroupPlaces places;
  char some_bad = 0;
  places.of_parts = of_parts("GALE::count_cells", count, [&, input](Offset first, Offset last) {
    std::vector<Id> mine(groups, 0);
    bool bad = false;
    for_range(first, last, [&](Offset t) {
      const Id lowest = input.lowest(t);
      bad |= lowest < 0;
      ++mine[std::max(lowest, 0) >> group_bits];
    });
    if (bad) atomic_write(&some_bad, char(1));
    return mine;
  });
  places.are_all = some_bad == 0;
  places.begin = begins_of_parts<Id>(places.of_parts, groups);
  return places;
}

/// Deals the cells to their groups.
template <int corners, class Index>
void deal(const Renumbered<corners, Index>& input, Offset count, GroupPlaces& places,
          const SortedCells<HostMemory>& sorted) {
  Quad* const quads = sorted.of_lowest.entries.data();
  Id* const from = sorted.input.data();
  const int parts = static_cast<int>(places.of_parts.size());
  for_parts("GALE::deal_cells", count, parts, [&, input, quads, from](int part, Offset first, Offset last) {
    Id* const next = places.of_parts[part].data();
    for_range(first, last, [&](Offset t) {
      const Quad quad = input[t];
      const Id to = next[quad.a >> group_bits]++;
      quads[to] = quad;
      from[to] = static_cast<Id>(t);
    });
  });
}

/// Writes cells that are in order already as they are given, and where each vertex's begin. Returns whether they were;
/// where they weren't, two parts may have said where a vertex's begin, so that is written atomically.
template <int corners, class Index>
bool write_in_order(const Renumbered<corners, Index>& input, Offset count, const SortedCells<HostMemory>& sorted) {
  const auto quads = sorted.of_lowest.entries;
  const auto begin = sorted.of_lowest.offsets;
  const Id vertices = static_cast<Id>(begin.extent(0)) - 1;
  const auto is_before = [](const Quad& one, const Quad& other) {
    return std::tie(one.a, one.b, one.c, one.d) <= std::tie(other.a, other.b, other.c, other.d);
  };
  char is_broken = 0;
  for_parts("GALE::cells_in_order", count, threads_for(count), [&, input](int, Offset first, Offset last) {
    Quad before{0, 0, 0, 0};
    Id reached = 0;
    const auto stop = [&] { atomic_write(&is_broken, char(1)); };
    if (first > 0) {
      if (input.lowest(first - 1) < 0) return stop();
      before = input[first - 1];
      reached = before.a + 1;
    }
    for (Offset t = first; t < last && atomic_read(&is_broken) == 0; ++t) {
      stop_if_asked_at(t);
      if (input.lowest(t) < 0) return stop();
      const Quad quad = input[t];
      if (!is_before(before, quad)) return stop();
      for (; reached <= quad.a; ++reached) atomic_write(&begin(reached), static_cast<Id>(t));
      quads(t) = before = quad;
      sorted.input(t) = static_cast<Id>(t);
    }
  });
  if (is_broken != 0) return false;
  for (Id v = count == 0 ? 0 : quads(count - 1).a + 1; v < vertices; ++v) begin(v) = static_cast<Id>(count);
  return true;
}

}  // namespace

/// T_ex, in two steps: each part of the sorted cells counts and then places its own, by segment and after those of
/// the parts before, so that rows ascend. One segment alone has none.
class ExternalRows {
 public:
  ExternalRows(const SortedCells<HostMemory>& sorted, const Borrowed<Id, HostMemory>& vertex_begin, int parts)
      : segments_(static_cast<Id>(vertex_begin.extent(0)) - 1),
        blocks_(segments_of_blocks(HostExecutionSpace(), vertex_begin, sorted.of_lowest.rows())),
        external_{sorted.of_lowest.entries.data(), {blocks_.data(), vertex_begin.data()}},
        next_(parts) {}

  void begin_part(int part) { next_[part].assign(segments_, 0); }

  void count(int part, Id begin, Id end) {
    if (segments_ == 1) return;
    Offset* const next = next_[part].data();
    for (Id t = begin; t < end; ++t) external_(t, [next](Id segment) { ++next[segment]; });
  }

  /// When all parts have counted.
  Csr<Id, HostMemory> allocate_rows() {
    const auto begin = begins_of_parts<Offset>(next_, segments_);
    return {array_of("GALE::external_begin", begin), allocate<Array<Id, HostMemory>>("GALE::external", begin.back())};
  }

  void place(int part, Id begin, Id end, Id* to) {
    if (segments_ == 1) return;
    Offset* const next = next_[part].data();
    for (Id t = begin; t < end; ++t) external_(t, [=](Id segment) { to[next[segment]++] = t; });
  }

 private:
  Id segments_;
  Array<Id, HostMemory> blocks_;
  ExternalSegments external_;
  std::vector<std::vector<Offset>> next_;  ///< by part, by segment
};

template <int corners, class Index>
EncodedCells encode_by_groups(const CellCorners<corners, Index, HostMemory>& given,
                              const Array<Id, HostMemory>& vertex_internal,
                              const Borrowed<Id, HostMemory>& vertex_begin) {
  const HostExecutionSpace space;
  const Offset vertices = vertex_internal.extent(0), count = given.extent(0);
  const Offset groups = (vertices >> group_bits) + 1;
  const Renumbered<corners, Index> input(given, vertex_internal);
  const SortedCells<HostMemory> sorted{{allocate<Array<Id, HostMemory>>("GALE::cells_of_lowest", vertices + 1),
                                        allocate<Array<Quad, HostMemory>>("GALE::cells", count)},
                                       allocate<Array<Id, HostMemory>>("GALE::cell_input", count)};
  sorted.of_lowest.offsets(vertices) = static_cast<Id>(count);
  const int parts = threads_for(count);
  const bool are_sorted = write_in_order(input, count, sorted);
  std::vector<Id> begin(groups + 1, static_cast<Id>(count));
  if (are_sorted) {
    for (Offset group = 0; group < groups; ++group) begin[group] = sorted.of_lowest.offsets(group << group_bits);
  } else {
    GroupPlaces places = places_of_groups(input, count, groups);
    if (!places.are_all) refuse_cells<corners, HostExecutionSpace, Index>(space, given, {}, vertices);
    deal(input, count, places, sorted);
    begin = std::move(places.begin);
  }
  ExternalRows rows(sorted, vertex_begin, parts);
  char some_bad = 0;
  for_parts("GALE::sort_cells", groups, parts, [&](int part, Offset first, Offset last) {
    GroupSorter<corners> sorter(sorted);
    rows.begin_part(part);
    bool bad = false;
    for (Offset group = first; group < last; ++group) {
      stop_if_asked();
      bad |= are_sorted ? !are_good<corners>(sorted.of_lowest.entries.data(), begin[group], begin[group + 1])
                        : !sorter.sort(static_cast<Id>(group), begin[group], begin[group + 1]);
      rows.count(part, begin[group], begin[group + 1]);
    }
    if (bad) atomic_write(&some_bad, char(1));
  });
  if (some_bad != 0) refuse_cells<corners, HostExecutionSpace, Index>(space, given, sorted, vertices);
  const auto external = rows.allocate_rows();
  for_parts("GALE::external", groups, parts, [&](int part, Offset first, Offset last) {
    for (Offset group = first; group < last; ++group) {
      stop_if_asked();
      rows.place(part, begin[group], begin[group + 1], external.entries.data());
    }
  });
  return {sorted, external};
}

#define GALE_INSTANTIATE(corners, Index)                                                          \
  template EncodedCells encode_by_groups<corners>(const CellCorners<corners, Index, HostMemory>&, \
                                                  const Array<Id, HostMemory>&, const Borrowed<Id, HostMemory>&)
GALE_INSTANTIATE(4, std::int32_t);
GALE_INSTANTIATE(4, std::int64_t);
GALE_INSTANTIATE(3, std::int32_t);
GALE_INSTANTIATE(3, std::int64_t);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
