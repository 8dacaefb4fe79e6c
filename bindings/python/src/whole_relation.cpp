#include "whole_relation.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>
#include <gale/relations/faces.hpp>

namespace gale::python {

namespace {

/// How many simplices of a dimension the mesh has. They have been needed.
Id known_simplices(const Mesh& mesh, int dimension) {
  const Id counts[] = {mesh.vertices(), mesh.known_edges(), mesh.known_triangles(), mesh.tetrahedra()};
  return counts[dimension];
}

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

/// Has the system give memory that will be written all over, many pages at a time on all threads: a sixth less time
/// than one by one. A hint: nothing depends on it.
void expect_writes([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes, [[maybe_unused]] int threads) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::uintptr_t piece = 1 << 16;
  const auto place = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (place + piece - 1) / piece, end = (place + bytes) / piece;
  if (end <= first) return;
  on_threads(threads, [&](int thread) {
    const auto begin_of = [&](int i) { return (first + (end - first) * i / threads) * piece; };
    const std::uintptr_t begin = begin_of(thread), length = begin_of(thread + 1) - begin;
    if (length > 0) madvise(reinterpret_cast<void*>(begin), length, MADV_POPULATE_WRITE);
  });
#endif
}

/// Entries whose memory isn't touched before they are written.
class Entries {
 public:
  explicit Entries(std::size_t count) { resize(count); }
  ~Entries() { std::free(ids_); }
  Entries(const Entries&) = delete;
  Entries& operator=(const Entries&) = delete;

  Id* ids() { return ids_; }

  /// The first ones stay as they are.
  void resize(std::size_t count) {
    void* const ids = std::realloc(ids_, std::max<std::size_t>(count, 1) * sizeof(Id));
    if (ids == nullptr) throw std::bad_alloc();
    ids_ = static_cast<Id*>(ids);
  }

  std::shared_ptr<Id> release() { return {std::exchange(ids_, nullptr), std::free}; }

 private:
  Id* ids_ = nullptr;
};

/// Where rows go: each has a slot of its own, by its number.
struct Slots {
  Id size;  ///< entries of each
  Id* ids;
  std::int64_t* sizes;  ///< of the rows; null where all are as long as slots

  Id* operator[](Id number) const { return ids + static_cast<std::int64_t>(number) * size; }
};

/// What one consumer does with its rows.
class alignas(64) RowWriter {
 public:
  RowWriter(const Slots& slots, const Id* row_number, const Id* entry_number)
      : slots_(slots), row_number_(row_number), entry_number_(entry_number) {}

  /// Writes a segment's rows, step by step: no step waits for the branches and cache misses of another one.
  void write(const Rows& rows) {
    const auto begin = [&](Id i) { return rows.offsets[i] - rows.offsets[0]; };
    const Id count = begin(rows.count);
    if (translated_.size() < static_cast<std::size_t>(count)) translated_.resize(count);
    Id* const numbers = translated_.data();
    const Id* const ids = rows.ids + rows.offsets[0];
    written_ += count;
    for (Id i = 0; i < count; ++i) numbers[i] = entry_number_[ids[i]];
    for (Id i = 0; i < rows.count; ++i) sort_numbers(numbers + begin(i), begin(i + 1) - begin(i));
    for (Id i = 0; i < rows.count; ++i) place(row_number_[rows.first + i], numbers + begin(i), begin(i + 1) - begin(i));
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
  void place(Id number, const Id* row, Id count) {
    if (slots_.sizes != nullptr) slots_.sizes[number] = count;
    if (count <= slots_.size) {
      Id* const slot = slots_[number];
      for (Id i = 0; i < count; ++i) slot[i] = row[i];
    } else {
      longer_.push_back(number);
      longer_entries_.insert(longer_entries_.end(), row, row + count);
    }
  }

  const Slots slots_;
  const Id *row_number_, *entry_number_;
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
    for (; row < rows && moves_up(row); ++row) begin_row(row);
    std::int64_t up_end = end;
    for (Id up = row - 1; up >= first; --up) {
      const Id* const from = slots[up];
      for (std::int64_t i = held(up_end - begin[up]) - 1; i >= 0; --i) slots.ids[begin[up] + i] = from[i];
      up_end = begin[up];
    }
  }
  begin[rows] = end;
}

}  // namespace

WholeRelation whole_relation(Structure& structure, Relation relation, const Id* row_number, const Id* entry_number,
                             const SweepOptions& options) {
  WholeRelation all;
  all.rows = known_simplices(structure.mesh(), row_dimension(relation));
  all.columns = known_simplices(structure.mesh(), entry_dimension(relation));
  all.begin.reset(new std::int64_t[static_cast<std::size_t>(all.rows) + 1]);

  const bool faces = row_dimension(relation) > entry_dimension(relation);
  Slots slots;
  slots.size = faces ? face_count(relation) : best_slot_size(sizes_of_some_rows(structure, relation, all.rows));
  const std::int64_t in_slots = static_cast<std::int64_t>(all.rows) * slots.size;
  Entries entries(in_slots);
  slots.ids = entries.ids();
  slots.sizes = faces ? nullptr : all.begin.get();
  expect_writes(slots.ids, in_slots * sizeof(Id), options.threads);
  expect_writes(all.begin.get(), static_cast<std::size_t>(all.rows) * sizeof(std::int64_t), options.threads);
  std::vector<RowWriter> writers(options.threads, RowWriter(slots, row_number, entry_number));
  structure.for_each_segment(relation, options, [&](int consumer, const SegmentRows& rows) {
    if (rows.interval(relation).size() > 0) writers[consumer].write(rows[relation]);
  });

  if (faces) {
    parallel_for("GALE::row_begin", HostSpace(), all.rows + Offset(1),
                 [&](Offset i) { all.begin[i] = slots.size * i; });
    all.entries = entries.release();
    return all;
  }
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
