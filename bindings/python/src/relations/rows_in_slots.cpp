#include "rows_in_slots.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "entries.hpp"

namespace gale::python {

namespace {

/// Sizes of some rows from all over the mesh, ascending.
std::vector<Id> sizes_of_some_rows(Structure& structure, Relation relation, Id rows) {
  constexpr Offset places = 16, at_each = 64;
  const auto consumer = structure.consumer();
  std::vector<Id> sizes;
  for (Offset place = 0; place < places; ++place) {
    const Offset first = rows * place / places, end = std::min(first + at_each, rows * (place + 1) / places);
    for (Offset row = first; row < end; ++row) sizes.push_back(consumer->row(relation, static_cast<Id>(row)).size());
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// The best size of slots for rows of such sizes, which ascend. An entry that waits elsewhere costs as much as three
/// that a slot has room for: it is written, read and written again.
Id best_slot_size(const std::vector<Id>& sizes) {
  constexpr std::int64_t waiting = 3;
  const auto rows = static_cast<std::int64_t>(sizes.size());
  Id best = 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max(), longer = 0;
  for (std::int64_t i = rows - 1; i >= 0; --i) {
    const std::int64_t cost = sizes[i] * rows + waiting * longer;
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
  std::int64_t* sizes;  ///< of the rows

  Id* operator[](Id number) const { return ids + static_cast<std::int64_t>(number) * size; }
};

/// What one consumer does with its rows.
class alignas(64) RowWriter {
 public:
  RowWriter(const Slots& slots, const Numbers& numbers) : slots_(slots), numbers_(numbers) {}

  /// Writes a segment's rows, step by step: no step waits for the branches and cache misses of another one.
  void write(const Rows& rows) {
    const auto begin = [&](Id i) { return rows.offsets[i] - rows.offsets[0]; };
    const Id count = begin(rows.count);
    if (translated_.size() < static_cast<std::size_t>(count)) translated_.resize(count);
    Id* const numbers = translated_.data();
    const Id* const ids = rows.ids + rows.offsets[0];
    written_ += count;
    for (Id i = 0; i < rows.count; ++i) prefetch(numbers_.rows[rows.first + i], begin(i + 1) - begin(i));
    for (Id i = 0; i < count; ++i) numbers[i] = numbers_.entries[ids[i]];
    for (Id i = 0; i < rows.count; ++i) sort_numbers(numbers + begin(i), begin(i + 1) - begin(i));
    for (Id i = 0; i < rows.count; ++i)
      place(numbers_.rows[rows.first + i], numbers + begin(i), begin(i + 1) - begin(i));
  }

  /// How many entries.
  std::int64_t written() const { return written_; }

  /// Puts rows that no slot holds where they begin in the end.
  void put_longer(const std::int64_t* begin, Id* to) const {
    const Id* from = longer_entries_.data();
    for (const Id number : longer_) {
      const std::int64_t count = begin[number + 1] - begin[number];
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
  const Numbers numbers_;
  std::vector<Id> translated_;  ///< the entries of a segment
  std::int64_t written_ = 0;
  std::vector<Id> longer_, longer_entries_;
};

/// Makes of the rows' sizes where they begin, and moves the rows there from their slots, in the same memory; leaves
/// gaps for longer ones. Rows that move down go first to last, neighbours that move up last to first: none is written
/// over before it has moved.
void move_together(const Slots& slots, std::int64_t* begin, Id rows) {
  std::int64_t end = 0;  // of the rows so far
  const auto begin_row = [&](Id row) {
    const std::int64_t size = std::exchange(begin[row], end);
    end += size;
  };
  const auto moves_up = [&](Id row) { return end > static_cast<std::int64_t>(row) * slots.size; };
  const auto held = [&](std::int64_t count) { return count <= slots.size ? count : 0; };
  for (Id row = 0; row < rows;) {
    detail::stop_if_asked_at(row);
    if (!moves_up(row)) {
      begin_row(row);
      const Id* const from = slots[row];
      Id* const to = slots.ids + begin[row];
      const std::int64_t count = held(end - begin[row]);
      if (to != from) {
        for (std::int64_t i = 0; i < count; ++i) to[i] = from[i];
      }
      ++row;
      continue;
    }
    const Id first = row;
    for (; row < rows && moves_up(row); ++row) {
      detail::stop_if_asked_at(row);
      begin_row(row);
    }
    std::int64_t up_end = end;
    for (Id up = row - 1; up >= first; --up) {
      detail::stop_if_asked_at(up);
      const Id* const from = slots[up];
      for (std::int64_t i = held(up_end - begin[up]) - 1; i >= 0; --i) slots.ids[begin[up] + i] = from[i];
      up_end = begin[up];
    }
  }
  begin[rows] = end;
}

}  // namespace

WholeRelation rows_in_slots(Structure& structure, Relation relation, const Numbers& numbers,
                            const SweepOptions& options) {
  const auto known = [&](int dimension) { return known_simplices(structure.mesh(), dimension); };
  WholeRelation all = {known(row_dimension(relation)), known(entry_dimension(relation)), nullptr, nullptr};
  all.begin = new_begins(all.rows + std::size_t(1), options.threads);
  Slots slots;
  slots.size = best_slot_size(sizes_of_some_rows(structure, relation, all.rows));
  const std::int64_t in_slots = static_cast<std::int64_t>(all.rows) * slots.size;
  Entries entries(in_slots, options.threads);
  slots.ids = entries.ids();
  slots.sizes = all.begin.get();
  std::vector<RowWriter> writers(options.threads, RowWriter(slots, numbers));
  structure.for_each_segment(relation, options, [&](int consumer, const SegmentRows& rows) {
    if (rows.interval(relation).size() > 0) writers[consumer].write(rows[relation]);
  });

  std::int64_t count = 0;
  for (const RowWriter& writer : writers) count += writer.written();
  if (count > in_slots) entries.resize(count);
  slots.ids = entries.ids();
  move_together(slots, all.begin.get(), all.rows);
  for (const RowWriter& writer : writers) writer.put_longer(all.begin.get(), entries.ids());
  if (count < in_slots) entries.resize(count);
  all.entries = entries.release();
  return all;
}

}  // namespace gale::python
