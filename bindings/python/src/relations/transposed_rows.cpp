#include "transposed_rows.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>

#include "entries.hpp"
#include "row_begins.hpp"

namespace gale::python {

namespace {

/// Consecutive simplices, and how many of them each face has. Where parts lie together in space, each has some faces
/// only, and the memory of counts before and behind these is never touched. All have `size` faces.
template <int size>
class Part {
 public:
  Part(const FaceRows& faces, Offset first, Offset last)
      : faces_(faces),
        first_(first),
        last_(last),
        counts_(static_cast<Id*>(std::calloc(std::max(faces.columns, 1), sizeof(Id)))) {
    if (!counts_) throw std::bad_alloc();
  }

  void count() {
    Id* const counts = counts_.get();
    Id least = least_, most = most_;  // as members they might be among the counts, and stay in memory
    const Id* row = faces_.row(first_);
    for (Offset i = first_; i < last_;) {
      for (const Offset end = detail::piece_end(i, last_); i < end; ++i, row += size) {
        least = std::min(least, row[0]);
        most = std::max(most, row[size - 1]);
        for (int k = 0; k < size; ++k) ++counts[row[k]];
      }
    }
    least_ = least;
    most_ = most;
  }

  /// Returns how many simplices a face has here, and remembers instead how many are before them in its row.
  Id begin_behind(Id before, Id face) {
    if (face < least_ || face > most_) return 0;
    return std::exchange(counts_.get()[face], before);
  }

  /// Writes them; begin[face] is where the face's row begins. Where one goes is fetched some simplices before.
  void place(const std::int64_t* begin, Id* entries) {
    constexpr Offset ahead = 16;
    Id* const next = counts_.get();
    const Id* row = faces_.row(first_);
    for (Offset i = first_; i < last_;) {
      for (const Offset end = detail::piece_end(i, last_); i < end; ++i, row += size) {
        if (last_ - i > ahead) {
          const Id* const later = row + size * ahead;
          for (int k = 0; k < size; ++k) __builtin_prefetch(entries + begin[later[k]] + next[later[k]], 1);
        }
        for (int k = 0; k < size; ++k) entries[begin[row[k]] + next[row[k]]++] = static_cast<Id>(i);
      }
    }
  }

 private:
  struct Free {
    void operator()(Id* ids) const { std::free(ids); }
  };

  const FaceRows& faces_;
  Offset first_, last_;
  std::unique_ptr<Id, Free> counts_;
  Id least_ = std::numeric_limits<Id>::max(), most_ = no_id;  ///< faces that are counted
};

/// As many as threads, but so few that the counts take no more than twice the memory of the entries, also where each
/// part has all faces.
template <int size>
std::vector<Part<size>> parts_of(const FaceRows& faces, int threads) {
  const Offset entries = size * Offset(faces.rows);
  const int count = static_cast<int>(std::clamp<Offset>(2 * entries / std::max(faces.columns, 1), 1, threads));
  std::vector<Part<size>> parts;
  for (int i = 0; i < count; ++i)
    parts.emplace_back(faces, detail::part_begin(faces.rows, count, i), detail::part_begin(faces.rows, count, i + 1));
  return parts;
}

template <int size>
WholeRelation transposed(const FaceRows& faces, int threads) {
  WholeRelation all = {faces.columns, faces.rows, new_begins(faces.columns + std::size_t(1), threads), nullptr};
  std::vector<Part<size>> parts = parts_of<size>(faces, threads);
  const int part_count = static_cast<int>(parts.size());
  on_threads(part_count, [&](int i) { parts[i].count(); });
  const std::int64_t count = set_begins(all, [&](Offset face) {
    Id sum = 0;
    for (Part<size>& part : parts) sum += part.begin_behind(sum, static_cast<Id>(face));
    return sum;
  });
  Entries entries(count, threads);
  on_threads(part_count, [&](int i) { parts[i].place(all.begin.get(), entries.ids()); });
  all.entries = entries.release();
  return all;
}

}  // namespace

WholeRelation transposed_rows(const FaceRows& faces, int threads) {
  switch (faces.size) {
    case 2:
      return transposed<2>(faces, threads);
    case 3:
      return transposed<3>(faces, threads);
    case 4:
      return transposed<4>(faces, threads);
    case 6:
      return transposed<6>(faces, threads);
  }
  throw Error("faces have rows of " + std::to_string(faces.size));
}

}  // namespace gale::python
