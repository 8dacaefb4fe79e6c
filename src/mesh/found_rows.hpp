#pragma once

#include <utility>
#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/mesh/few_distinct.hpp>
#include <gale/mesh/last_seen.hpp>

namespace gale::detail {

/// The distinct candidates of rows, written down as the host's threads count them, so that they needn't be found again
/// to be written where they belong.
class FoundRows {
 public:
  FoundRows() : parts_(threads_for(Offset(1) << 40)) {}

  /// count[r]: how many row r has, or FewDistinct::too_many; then there is nothing to write.
  template <class Candidates>
  void count(const Candidates& candidates, const Array<Id, HostMemory>& count) {
    for_parts("GALE::count_distinct", count.extent(0), size(), [&](int part, Offset begin, Offset end) {
      constexpr Offset usual = 8;
      std::vector<Id> found;  // the ends of those in parts_ share cache lines
      found.reserve(usual * (end - begin));
      LastSeen seen;
      for (Offset row = begin; row < end; ++row) {
        stop_if_asked_at(row);
        FewDistinct few;
        candidates(static_cast<Id>(row), [&](Id id) {
          if (seen.is_new(row, id)) few.insert(id);
        });
        count(row) = few.size();
        for (Id i = 0; i < few.size(); ++i) found.push_back(few[i]);
      }
      parts_[part] = std::move(found);
    });
  }

  /// Writes all rows' values and, for each, its row. `begin` has where rows begin.
  void write(const Array<Id, HostMemory>& begin, const Array<Id, HostMemory>& values,
             const Array<Id, HostMemory>& row_of) {
    for_parts("GALE::write_distinct", begin.extent(0) - 1, size(), [&](int part, Offset first, Offset last) {
      const Id* from = parts_[part].data();
      for (Offset row = first; row < last; ++row) {
        stop_if_asked_at(row);
        for (Id at = begin(row); at < begin(row + 1); ++at) {
          values(at) = *from++;
          row_of(at) = static_cast<Id>(row);
        }
      }
    });
  }

 private:
  int size() const { return static_cast<int>(parts_.size()); }

  std::vector<std::vector<Id>> parts_;  ///< of the rows, equally many each
};

}  // namespace gale::detail
