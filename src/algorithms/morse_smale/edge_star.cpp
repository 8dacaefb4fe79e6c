#include <algorithm>

#include <gale/algorithms/morse_smale/edge_star.hpp>

namespace gale::detail {

EdgeStar::EdgeStar(const Mesh& mesh)
    : mesh_(mesh), encoded_(mesh.encoded()), tetrahedron_input_(mesh.tetrahedron_input().data()) {}

void EdgeStar::find(Id high, Id low, const Row& tetrahedra) {
  wedges_.clear();
  for (const Id t : tetrahedra) {
    Wedge wedge{tetrahedron_input_[t], t, {no_id, no_id}, false};
    int sides = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const Id vertex = encoded_.tetrahedra(t, corner);
      if (vertex == high || vertex == low) continue;
      if (sides == 2) break;  // `low` isn't among them
      wedge.sides[sides++] = vertex;
    }
    const bool has_low =
        std::find(&encoded_.tetrahedra(t, 0), &encoded_.tetrahedra(t, 0) + 4, low) != &encoded_.tetrahedra(t, 0) + 4;
    if (has_low) wedges_.push_back(wedge);
  }
  std::sort(wedges_.begin(), wedges_.end(), [](const Wedge& a, const Wedge& b) { return a.input < b.input; });
  find_thirds();
  go_around();
}

void EdgeStar::find_thirds() {
  thirds_.clear();
  for (const Wedge& wedge : wedges_) thirds_.insert(thirds_.end(), wedge.sides, wedge.sides + 2);
  std::sort(thirds_.begin(), thirds_.end());
  thirds_.erase(std::unique(thirds_.begin(), thirds_.end()), thirds_.end());
}

/// From wedge to wedge over the sides that they share; from a new first one when there is no further.
void EdgeStar::go_around() {
  around_.clear();
  while (around_.size() < wedges_.size()) {
    int at = first();
    Wedge& begin = wedges_[at];
    begin.taken = true;
    around_.push_back(begin.tetrahedron);
    const int one = next(begin.sides[0]), other = next(begin.sides[1]);
    const bool over_first = other < 0 || (one >= 0 && one <= other);
    for (Id side = begin.sides[over_first ? 0 : 1]; (at = next(side)) >= 0;) {
      Wedge& wedge = wedges_[at];
      wedge.taken = true;
      around_.push_back(wedge.tetrahedron);
      side = wedge.sides[0] == side ? wedge.sides[1] : wedge.sides[0];
    }
  }
}

/// Has it a side of its own?
bool EdgeStar::is_end(const Wedge& wedge) const {
  return std::any_of(wedge.sides, wedge.sides + 2, [&](Id side) {
    return std::count_if(wedges_.begin(), wedges_.end(),
                         [&](const Wedge& other) { return other.sides[0] == side || other.sides[1] == side; }) == 1;
  });
}

/// The first end that isn't taken; else the first wedge.
int EdgeStar::first() const {
  int best = -1;
  for (int i = 0; i < static_cast<int>(wedges_.size()); ++i) {
    if (wedges_[i].taken) continue;
    if (is_end(wedges_[i])) return i;
    if (best < 0) best = i;
  }
  return best;
}

/// The first wedge beyond a side that isn't taken; -1 if there is none.
int EdgeStar::next(Id side) const {
  for (int i = 0; i < static_cast<int>(wedges_.size()); ++i) {
    if (!wedges_[i].taken && (wedges_[i].sides[0] == side || wedges_[i].sides[1] == side)) return i;
  }
  return -1;
}

}  // namespace gale::detail
