#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include <gale/distributed/id_interval.hpp>

namespace gale::detail {

/// An interval of ids, to be compared with ids as an input has them, of `Index`: one comparison each, without a branch,
/// so that compilers do several at once.
template <class Index>
class IndexInterval {
  using Unsigned = std::make_unsigned_t<Index>;

 public:
  explicit IndexInterval(const IdInterval& ids) {
    constexpr GlobalId last = std::numeric_limits<Index>::max();
    if (ids.is_empty() || ids.begin > last) return;
    begin_ = static_cast<Unsigned>(ids.begin);
    size_ = static_cast<Unsigned>(std::min(ids.end - 1, last)) - begin_ + 1;
  }

  bool contains(Index id) const { return static_cast<Unsigned>(id) - begin_ < size_; }

  /// Whether it contains all of them.
  bool contains(const Index* ids, Offset count) const {
    if (size_ == 0) return count == 0;
    Unsigned farthest = 0;
    for (Offset i = 0; i < count; ++i) farthest = std::max(farthest, static_cast<Unsigned>(ids[i]) - begin_);
    return farthest < size_;
  }

 private:
  Unsigned begin_ = 0, size_ = 0;
};

}  // namespace gale::detail
