#pragma once

#include <functional>
#include <map>
#include <set>
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

  /// Of saddles for which `lower` and `upper` are set.
  SaddleGraph(const Separatrices<TriangleVertices>& connectors, const std::vector<char>& lower,
              const std::vector<char>& upper);

  int paths(Id lower, Id upper) const {
    const auto at = up_[lower].find(upper);
    return at == up_[lower].end() ? 0 : at->second;
  }

  const std::map<Id, int>& above(Id lower) const { return up_[lower]; }
  const std::set<Id>& below(Id upper) const { return down_[upper]; }

  /// Cancels two saddles with one path between them; calls changed(lower, upper) for other two whose
  /// paths may be others now.
  void cancel(Id lower, Id upper, const std::function<void(Id, Id)>& changed);

  /// Replaces the paths from a 2-saddle by those that are known to be there.
  void replace(Id upper, const std::vector<std::pair<Id, int>>& paths);

 private:
  std::vector<std::map<Id, int>> up_;
  std::vector<std::set<Id>> down_;
};

}  // namespace gale::detail
