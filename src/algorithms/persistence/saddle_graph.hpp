#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// 1-saddles, 2-saddles, and how many paths lead from the former up to the latter: none, one, or perhaps several. When
/// two that have one path are cancelled, that path is turned around, and each other path to the 1-saddle and each from
/// the 2-saddle make a new one through it. So it counts what could be there; some that it counts aren't, since parts
/// of them lay on the path that was turned.
class SaddleGraph {
 public:
  static constexpr int one = 1, several = 2;

  /// Takes the saddles for which `lower` and `upper` are set.
  SaddleGraph(const Separatrices<TriangleVertices>& connectors, const std::vector<char>& lower,
              const std::vector<char>& upper);

  /// 2-saddles by their ids, ascending, and how many paths lead to each.
  using Above = std::vector<std::pair<Id, int>>;

  int paths(Id lower, Id upper) const;
  const Above& above(Id lower) const { return up_[lower]; }

  /// Cancels two saddles with one path between them; calls changed(lower, upper) for other two whose
  /// paths may be others now.
  void cancel(Id lower, Id upper, const std::function<void(Id, Id)>& changed);

  /// Replaces the paths from a 2-saddle by those that are known to be there.
  void replace(Id upper, const std::vector<std::pair<Id, int>>& paths);

 private:
  std::vector<Above> up_;
  std::vector<std::vector<Id>> down_;  ///< saddles below each 2-saddle, ascending
};

}  // namespace gale::detail
