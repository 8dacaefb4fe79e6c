#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale::detail {

namespace {

/// Sizes of some rows from all over the mesh, ascending.
std::vector<Id> sizes_of_some_rows(Structure& structure, Relation relation, const Interval& rows) {
  constexpr Offset places = 16, at_each = 64;
  const auto consumer = structure.consumer();
  std::vector<Id> sizes;
  for (Offset place = 0; place < places; ++place) {
    const Offset first = rows.first + rows.size() * place / places;
    const Offset end = std::min(first + at_each, rows.first + rows.size() * (place + 1) / places);
    for (Offset row = first; row < end; ++row) sizes.push_back(consumer->row(relation, static_cast<Id>(row)).size());
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// The best size of slots for rows of such sizes, which ascend. An entry that waits elsewhere costs as much as three
/// that a slot has room for: it is written, read and written again.
Id best_slot_size(const std::vector<Id>& sizes) {
  constexpr Offset waiting = 3;
  const auto rows = static_cast<Offset>(sizes.size());
  Id best = 0;
  Offset least = std::numeric_limits<Offset>::max(), longer = 0;
  for (Offset i = rows - 1; i >= 0; --i) {
    const Offset cost = sizes[i] * rows + waiting * longer;
    if (cost < least) {
      best = sizes[i];
      least = cost;
    }
    longer += sizes[i];
  }
  return best;
}

/// Most numbers come nearly in order.
void sort_numbers(Id* numbers, Id count) {
  constexpr Id few = 64;
  if (count > few) {
    if (!std::is_sorted(numbers, numbers + count)) std::sort(numbers, numbers + count);
    return;
  }
  for (Id i = 1; i < count; ++i) {
    const Id number = numbers[i];
    Id at = i;
    for (; at > 0 && numbers[at - 1] > number; --at) numbers[at] = numbers[at - 1];
    numbers[at] = number;
  }
}

/// Where rows go: each has a slot of its own, by its number.
struct Slots {
  Id size;  ///< entries of each
  Id* ids;
  Offset* sizes;  ///< of the rows

  Id* operator[](Id number) const { return ids + static_cast<Offset>(number) * size; }
};

/// What one consumer does with its rows.
class alignas(64) SlotWriter {
 public:
  SlotWriter(const Slots& slots, const RelationNames& names) : slots_(slots), names_(names) {}

  /// Writes a segment's rows, step by step: no step waits for the branches and cache misses of another one.
  void write(const Rows& rows) {
    const auto begin = [&](Id i) { return rows.offsets[i] - rows.offsets[0]; };
    const Id count = begin(rows.count);
    if (translated_.size() < static_cast<std::size_t>(count)) translated_.resize(count);
    Id* const numbers = translated_.data();
    const Id* const ids = rows.ids + rows.offsets[0];
    written_ += count;
    for (Id i = 0; i < rows.count; ++i) prefetch(names_.rows[rows.first + i], begin(i + 1) - begin(i));
    for (Id i = 0; i < count; ++i) numbers[i] = names_.entries[ids[i]];
    for (Id i = 0; i < rows.count; ++i) sort_numbers(numbers + begin(i), begin(i + 1) - begin(i));
    for (Id i = 0; i < rows.count; ++i) place(names_.rows[rows.first + i], numbers + begin(i), begin(i + 1) - begin(i));
  }

  /// How many entries.
  Offset written() const { return written_; }

  /// Puts rows that no slot holds where they begin in the end.
  void put_longer(const Offset* begin, Id* to) const {
    const Id* from = longer_entries_.data();
    for (const Id number : longer_) {
      const Offset count = begin[number + 1] - begin[number];
      std::copy(from, from + count, to + begin[number]);
      from += count;
    }
  }

 private:
  void prefetch(Id number, Id count) const {
    constexpr Id line = 16;
    __builtin_prefetch(slots_.sizes + number, 1);
    const Id* const slot = slots_[number];
    for (Id i = 0; i < count; i += line) __builtin_prefetch(slot + i, 1);
  }

  void place(Id number, const Id* row, Id count) {
    slots_.sizes[number] = count;
    if (count <= slots_.size) {
      Id* const slot = slots_[number];
      for (Id i = 0; i < count; ++i) slot[i] = row[i];
    } else {
      longer_.push_back(number);
      longer_entries_.insert(longer_entries_.end(), row, row + count);
    }
  }

  const Slots slots_;
  const RelationNames names_;
  std::vector<Id> translated_;  ///< the entries of a segment
  Offset written_ = 0;
  std::vector<Id> longer_, longer_entries_;
};

/// Makes of the rows' sizes where they begin, and moves the rows there from their slots, in the same memory; leaves
/// gaps for longer ones. Rows that move down go first to last, neighbours that move up last to first: none is written
/// over before it has moved.
void move_together(const Slots& slots, Offset* begin, Id rows) {
  Offset end = 0;  // of the rows so far
  const auto begin_row = [&](Id row) {
    const Offset size = std::exchange(begin[row], end);
    end += size;
  };
  const auto moves_up = [&](Id row) { return end > static_cast<Offset>(row) * slots.size; };
  const auto held = [&](Offset count) { return count <= slots.size ? count : 0; };
  for (Id row = 0; row < rows;) {
    stop_if_asked_at(row);
    if (!moves_up(row)) {
      begin_row(row);
      const Id* const from = slots[row];
      Id* const to = slots.ids + begin[row];
      const Offset count = held(end - begin[row]);
      if (to != from) {
        for (Offset i = 0; i < count; ++i) to[i] = from[i];
      }
      ++row;
      continue;
    }
    const Id first = row;
    for (; row < rows && moves_up(row); ++row) {
      stop_if_asked_at(row);
      begin_row(row);
    }
    Offset up_end = end;
    for (Id up = row - 1; up >= first; --up) {
      stop_if_asked_at(up);
      const Id* const from = slots[up];
      for (Offset i = held(up_end - begin[up]) - 1; i >= 0; --i) slots.ids[begin[up] + i] = from[i];
      up_end = begin[up];
    }
  }
  begin[rows] = end;
}

/// How many entries there may be, by some rows' sizes: pages that nobody writes cost nothing.
Offset most_entries(const std::vector<Id>& sizes, Offset rows) {
  const Offset sum = std::accumulate(sizes.begin(), sizes.end(), Offset(0));
  return sizes.empty() ? 0 : sum * rows / static_cast<Offset>(sizes.size()) * 5 / 4;
}

}  // namespace

Csr<const Id, HostMemory> swept_rows(Structure& structure, Relation relation, const RelationNames& names,
                                     const SweepOptions& options) {
  const Mesh& mesh = structure.mesh();
  const int dimension = row_dimension(relation);
  const Id rows = count_of(mesh, dimension);
  const auto& begin_of = mesh.interval_begin(dimension);
  const Interval owned{begin_of(mesh.owned_segments().first), begin_of(mesh.owned_segments().last)};
  const auto begin = array_to_write<Offset>("GALE::relation_offsets", rows + std::size_t(1), options.threads);
  if (owned.size() < rows) fill("GALE::relation_offsets", HostExecutionSpace(), begin, 0);
  const auto sizes = sizes_of_some_rows(structure, relation, owned);
  Slots slots;
  slots.size = best_slot_size(sizes);
  const Offset in_slots = Offset(rows) * slots.size;
  auto entries =
      allocate<Array<Id, HostMemory>>("GALE::relation_entries", std::max(in_slots, most_entries(sizes, rows)));
  expect_writes(entries.data(), in_slots * sizeof(Id), options.threads);
  slots.ids = entries.data();
  slots.sizes = begin.data();
  std::vector<SlotWriter> writers(options.threads, SlotWriter(slots, names));
  structure.for_each_segment(relation, options, [&](int consumer, const SegmentRows& some) {
    if (some.interval(relation).size() > 0) writers[consumer].write(some[relation]);
  });

  Offset count = 0;
  for (const SlotWriter& writer : writers) count += writer.written();
  const Offset room = entries.extent(0);
  if (count > room) {
    const auto more = allocate<Array<Id, HostMemory>>("GALE::relation_entries", count);
    std::copy(entries.data(), entries.data() + in_slots, more.data());
    entries = more;
  }
  slots.ids = entries.data();
  move_together(slots, begin.data(), rows);
  for (const SlotWriter& writer : writers) writer.put_longer(begin.data(), entries.data());
  if (count < room) give_back(entries.data() + count, (room - count) * sizeof(Id));
  return {begin, first_of(entries, count)};
}

}  // namespace gale::detail
