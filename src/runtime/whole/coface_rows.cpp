#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/sweep.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale::detail {

namespace {

/// Consecutive simplices, and how many of them each face has. Where parts lie together in space, each has some faces
/// only, and the memory of counts before and behind these is never touched. All have `size` faces.
template <int size>
class FacePart {
 public:
  FacePart(const EvenRows<HostMemory>& faces, Id face_count, Offset first, Offset last)
      : faces_(faces),
        first_(first),
        last_(last),
        counts_(static_cast<Id*>(std::calloc(std::max(face_count, 1), sizeof(Id)))) {
    if (!counts_) throw std::bad_alloc();
  }

  void count() {
    Id* const counts = counts_.get();
    Id least = least_, most = most_;  // as members they might be among the counts, and stay in memory
    const Id* row = faces_.row(first_);
    for_range(first_, last_, [&](Offset) {
      least = std::min(least, row[0]);
      most = std::max(most, row[size - 1]);
      for (int k = 0; k < size; ++k) ++counts[row[k]];
      row += size;
    });
    least_ = least;
    most_ = most;
  }

  /// Returns how many simplices a face has here, and remembers instead how many are before them in its row.
  Id begin_behind(Id before, Id face) {
    if (face < least_ || face > most_) return 0;
    return std::exchange(counts_.get()[face], before);
  }

  /// Writes them; begin[face] is where the face's row begins. Where one goes is fetched some simplices before.
  void place(const Offset* begin, Id* entries) {
    constexpr Offset ahead = 16;
    Id* const next = counts_.get();
    const Id* row = faces_.row(first_);
    for_range(first_, last_, [&](Offset i) {
      if (last_ - i > ahead) {
        const Id* const later = row + size * ahead;
        for (int k = 0; k < size; ++k) __builtin_prefetch(entries + begin[later[k]] + next[later[k]], 1);
      }
      for (int k = 0; k < size; ++k) entries[begin[row[k]] + next[row[k]]++] = static_cast<Id>(i);
      row += size;
    });
  }

 private:
  struct FreeIds {
    void operator()(Id* ids) const { std::free(ids); }
  };

  const EvenRows<HostMemory>& faces_;
  Offset first_, last_;
  std::unique_ptr<Id, FreeIds> counts_;
  Id least_ = std::numeric_limits<Id>::max(), most_ = no_id;  ///< faces that are counted
};

/// As many as threads, but so few that the counts take no more than twice the memory of the entries, also where each
/// part has all faces.
template <int size>
std::vector<FacePart<size>> parts_of(const EvenRows<HostMemory>& faces, Id face_count, int threads) {
  const Offset entries = faces.entries.extent(0), rows = faces.rows();
  const int count = static_cast<int>(std::clamp<Offset>(2 * entries / std::max(face_count, 1), 1, threads));
  std::vector<FacePart<size>> parts;
  for (int i = 0; i < count; ++i)
    parts.emplace_back(faces, face_count, part_begin(rows, count, i), part_begin(rows, count, i + 1));
  return parts;
}

/// Rows of which there are size(row) entries each, without the entries. Asks for each size once.
template <class Size>
Csr<Id, HostMemory> rows_with(Offset rows, int threads, const Size& size) {
  const auto begin = array_to_write<Offset>("GALE::relation_offsets", rows + std::size_t(1), threads);
  parallel_for("GALE::row_size", HostExecutionSpace(), rows, [&](Offset row) { begin(row) = size(row); });
  const Offset count = exclusive_scan("GALE::row_begin", HostExecutionSpace(), rows, begin,
                                      [counts = begin.data()](Offset row) { return counts[row]; });
  return {begin, array_to_write<Id>("GALE::relation_entries", count, threads)};
}

template <int size>
Csr<const Id, HostMemory> transposed(const EvenRows<HostMemory>& faces, Id face_count, int threads) {
  std::vector<FacePart<size>> parts = parts_of<size>(faces, face_count, threads);
  const int part_count = static_cast<int>(parts.size());
  on_threads(part_count, [&](int i) { parts[i].count(); });
  const auto all = rows_with(face_count, threads, [&](Offset face) {
    Id sum = 0;
    for (FacePart<size>& part : parts) sum += part.begin_behind(sum, static_cast<Id>(face));
    return sum;
  });
  on_threads(part_count, [&](int i) { parts[i].place(all.offsets.data(), all.entries.data()); });
  return all;
}

/// Ascending ids.
struct Ascending {
  const Id *begin, *end;

  Offset size() const { return end - begin; }
};

/// Writes all ids of two rows in ascending order; those that both have once or, unless so wanted, not at all.
/// Returns the end of what it has written. No branch but the loop's end depends on who comes first.
template <bool keep_common>
Id* merge(Ascending a, Ascending b, Id* to) {
  while (a.begin != a.end && b.begin != b.end) {
    const Id x = *a.begin, y = *b.begin;
    if (keep_common || x != y) *to++ = std::min(x, y);
    a.begin += x <= y ? 1 : 0;
    b.begin += y <= x ? 1 : 0;
  }
  while (a.begin != a.end) *to++ = *a.begin++;
  while (b.begin != b.end) *to++ = *b.begin++;
  return to;
}

/// What one consumer does with rows.
class RowJoiner {
 public:
  RowJoiner(const EvenRows<HostMemory>& faces, const Csr<const Id, HostMemory>& cofaces)
      : faces_(faces.entries.data()),
        length_(faces.length),
        begin_(cofaces.offsets.data()),
        entries_(cofaces.entries.data()) {}

  Offset size(Offset row) const {
    Offset sum = 0;
    for (int k = 0; k < length_; ++k) sum += cofaces_of(row, k).size() - 1;
    return sum;
  }

  void write(Offset row, Id* to) {
    Ascending first = cofaces_of(row, 0);
    if (length_ == 3) first = join(first, cofaces_of(row, 1));
    merge<false>(first, cofaces_of(row, length_ - 1), to);
  }

 private:
  Ascending cofaces_of(Offset row, int k) const {
    const Id face = faces_[length_ * row + k];
    return {entries_ + begin_[face], entries_ + begin_[face + 1]};
  }

  Ascending join(Ascending a, Ascending b) {
    const auto most = static_cast<std::size_t>(a.size() + b.size());
    if (joined_.size() < most) joined_.resize(most);
    return {joined_.data(), merge<true>(a, b, joined_.data())};
  }

  const Id* faces_;
  int length_;
  const Offset* begin_;
  const Id* entries_;
  std::vector<Id> joined_;
};

}  // namespace

Csr<const Id, HostMemory> transposed_rows(const EvenRows<HostMemory>& faces, Id face_count, int threads) {
  switch (faces.length) {
    case 2:
      return transposed<2>(faces, face_count, threads);
    case 3:
      return transposed<3>(faces, face_count, threads);
    case 4:
      return transposed<4>(faces, face_count, threads);
    case 6:
      return transposed<6>(faces, face_count, threads);
  }
  throw Error("faces have rows of " + std::to_string(faces.length));
}

Csr<const Id, HostMemory> joined_rows(const EvenRows<HostMemory>& faces, const Csr<const Id, HostMemory>& cofaces,
                                      const SweepOptions& options) {
  const Offset rows = faces.rows();
  std::vector<RowJoiner> joiners(options.threads, RowJoiner(faces, cofaces));
  const auto all = rows_with(rows, options.threads, [&](Offset row) { return joiners[0].size(row); });
  constexpr Offset at_once = 256;
  sweep(static_cast<Id>((rows + at_once - 1) / at_once), options, [&](int consumer, Id some) {
    const Offset end = std::min<Offset>((some + 1) * at_once, rows);
    for (Offset row = some * at_once; row < end; ++row) joiners[consumer].write(row, all.row(row).begin());
  });
  return all;
}

}  // namespace gale::detail
