#include "joined_rows.hpp"

#include <algorithm>
#include <vector>

#include <gale/runtime/sweep.hpp>

#include "entries.hpp"
#include "row_begins.hpp"

namespace gale::python {

namespace {

/// Ascending numbers.
struct Ascending {
  const Id *begin, *end;

  Offset size() const { return end - begin; }
};

/// Writes all numbers of two rows in ascending order; those that both have once or, unless so wanted, not at all.
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
  RowJoiner(const FaceRows& faces, const WholeRelation& cofaces) : faces_(faces), cofaces_(cofaces) {}

  Offset size(Offset row) const {
    Offset sum = 0;
    for (int k = 0; k < faces_.size; ++k) sum += cofaces_of(row, k).size() - 1;
    return sum;
  }

  void write(Offset row, Id* to) {
    Ascending first = cofaces_of(row, 0);
    if (faces_.size == 3) first = join(first, cofaces_of(row, 1));
    merge<false>(first, cofaces_of(row, faces_.size - 1), to);
  }

 private:
  Ascending cofaces_of(Offset row, int k) const {
    const Id face = faces_.row(row)[k];
    const Id* const entries = cofaces_.entries.get();
    return {entries + cofaces_.begin[face], entries + cofaces_.begin[face + 1]};
  }

  Ascending join(Ascending a, Ascending b) {
    const auto most = static_cast<std::size_t>(a.size() + b.size());
    if (joined_.size() < most) joined_.resize(most);
    return {joined_.data(), merge<true>(a, b, joined_.data())};
  }

  const FaceRows& faces_;
  const WholeRelation& cofaces_;
  std::vector<Id> joined_;
};

}  // namespace

WholeRelation joined_rows(const FaceRows& faces, const WholeRelation& cofaces, const SweepOptions& options) {
  WholeRelation all = {faces.rows, faces.rows, new_begins(faces.rows + std::size_t(1), options.threads), nullptr};
  std::vector<RowJoiner> joiners(options.threads, RowJoiner(faces, cofaces));
  const std::int64_t count = set_begins(all, [&](Offset row) { return joiners[0].size(row); });
  Entries entries(count, options.threads);
  constexpr Offset at_once = 256;
  detail::sweep(static_cast<Id>((all.rows + at_once - 1) / at_once), options, [&](int consumer, Id some) {
    const Offset end = std::min<Offset>((some + 1) * at_once, all.rows);
    for (Offset row = some * at_once; row < end; ++row) joiners[consumer].write(row, entries.ids() + all.begin[row]);
  });
  all.entries = entries.release();
  return all;
}

}  // namespace gale::python
