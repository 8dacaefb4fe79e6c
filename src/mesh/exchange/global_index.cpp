#include <algorithm>
#include <cstdint>

#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/global_index.hpp>

namespace gale::detail {

namespace {

/// How many ids there are from `least` to `greatest`, which is 2^63 at most.
std::uint64_t span_of(GlobalId least, GlobalId greatest) {
  return static_cast<std::uint64_t>(greatest) - static_cast<std::uint64_t>(least) + 1;
}

/// The entries that differ from those before them.
DistinctIds without_repetitions(const GlobalIds& sorted, const Array<Id, HostMemory>& places) {
  const Offset count = sorted.extent(0);
  const auto is_new = [&](Offset i) { return i == 0 || sorted(i) != sorted(i - 1); };
  const auto place = allocate<Array<Offset, HostMemory>>("GALE::distinct_place", count + 1);
  const Offset distinct = exclusive_scan("GALE::count_distinct", HostExecutionSpace(), count, place, is_new);
  if (distinct == count) return {sorted, places};
  const DistinctIds found{allocate<GlobalIds>("GALE::distinct_ids", distinct),
                          allocate<Array<Id, HostMemory>>("GALE::distinct_places", distinct)};
  parallel_for("GALE::distinct_ids", HostExecutionSpace(), count, [&](Offset i) {
    if (!is_new(i)) return;
    found.ids(place(i)) = sorted(i);
    found.places(place(i)) = places(i);
  });
  return found;
}

}  // namespace

DistinctIds distinct_ids(const Array<const GlobalId, HostMemory>& ids) {
  const Offset count = ids.extent(0);
  const auto places = iota("GALE::id_places", HostExecutionSpace(), count);
  const GlobalIds sorted = tabulated<GlobalId>("GALE::sorted_ids", count, ids);
  const Offset descent = reduce_min("GALE::find_descent", HostExecutionSpace(), count - 1, count,
                                    [&](Offset i) { return sorted(i) > sorted(i + 1) ? i : count; });
  const Array<std::uint64_t, HostMemory> keys(reinterpret_cast<std::uint64_t*>(sorted.data()), count);
  if (descent < count) stable_sort_by_key(HostExecutionSpace(), keys, places);
  return without_repetitions(sorted, places);
}

void keep_distinct(std::vector<GlobalId>& ids) {
  if (ids.empty()) return;
  const auto [least, greatest] = std::minmax_element(ids.begin(), ids.end());
  const GlobalId first = *least;
  const std::uint64_t span = span_of(first, *greatest);
  constexpr std::uint64_t flags_an_id = 16;
  if (span > flags_an_id * ids.size()) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return;
  }
  std::vector<std::uint8_t> is_there(span, 0);
  for (const GlobalId id : ids) is_there[id - first] = 1;
  ids.clear();
  for (std::uint64_t i = 0; i < span; ++i) {
    if (is_there[i] != 0) ids.push_back(first + static_cast<GlobalId>(i));
  }
}

GlobalIds distinct_of(const std::string& label, std::vector<GlobalId> ids) {
  keep_distinct(ids);
  return array_of(label, ids);
}

GlobalIndex::GlobalIndex(const Array<const GlobalId, HostMemory>& ascending, Lookups lookups) : ids_(ascending) {
  const std::uint64_t count = ids_.extent(0);
  if (count == 0) return;
  constexpr std::uint64_t bytes_an_id = 16;
  const std::uint64_t span = span_of(ids_(0), ids_(count - 1)), words = (span + 63) / 64;
  first_ = static_cast<std::uint64_t>(ids_(0));
  if (lookups == Lookups::many && span <= bytes_an_id / sizeof(Id) * count) {
    places_ = allocate<Array<Id, HostMemory>>("GALE::global_places", span);
    gale::fill("GALE::global_places", HostExecutionSpace(), places_, no_id);
    parallel_for("GALE::global_places", HostExecutionSpace(), count,
                 [&](Offset i) { places_(static_cast<std::uint64_t>(ids_(i)) - first_) = static_cast<Id>(i); });
  } else if (words * sizeof(CountedWord) <= bytes_an_id * count) {
    mark_in_words(words);
  } else {
    divide(span);
  }
}

void GlobalIndex::mark_in_words(std::uint64_t words) {
  words_ = allocate<Array<CountedWord, HostMemory>>("GALE::global_index", words);
  const Offset size = words_.extent(0), count = ids_.extent(0);
  for_parts("GALE::global_index", size, threads_for(size), [&](int, Offset first, Offset last) {
    const GlobalId* const ids = ids_.data();
    const GlobalId least = ids[0];
    auto at = static_cast<Id>(std::lower_bound(ids, ids + count, least + 64 * first) - ids);
    for (Offset w = first; w < last; ++w) {
      CountedWord word{0, at};
      for (; at < count && (ids[at] - least) >> 6 == w; ++at) word.insert(static_cast<int>((ids[at] - least) & 63));
      words_(w) = word;
    }
  });
}

/// Makes as many buckets as there are ids, or up to twice as many.
void GlobalIndex::divide(std::uint64_t span) {
  const Offset count = ids_.extent(0);
  while ((span - 1) >> shift_ >= 2 * static_cast<std::uint64_t>(count)) ++shift_;
  const Offset buckets = bucket(ids_(count - 1)) + 1;
  begin_ = allocate<Array<Id, HostMemory>>("GALE::buckets_of_ids", buckets + 1);
  parallel_for("GALE::buckets_of_ids", HostExecutionSpace(), count + 1, [&](Offset i) {
    const Offset from = i == 0 ? 0 : bucket(ids_(i - 1)) + 1, to = i == count ? buckets : bucket(ids_(i));
    for (Offset b = from; b <= to; ++b) begin_(b) = static_cast<Id>(i);
  });
}

Id GlobalIndex::find_in_bucket(GlobalId id) const {
  if (ids_.extent(0) == 0 || id < ids_(0) || id > ids_(ids_.extent(0) - 1)) return no_id;
  const GlobalId* const begin = ids_.data() + begin_(bucket(id));
  const GlobalId* const end = ids_.data() + begin_(bucket(id) + 1);
  const GlobalId* const at = std::lower_bound(begin, end, id);
  return at == end || *at != id ? no_id : static_cast<Id>(at - ids_.data());
}

}  // namespace gale::detail
