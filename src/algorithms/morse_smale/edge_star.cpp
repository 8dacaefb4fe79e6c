#include <algorithm>

#include <gale/algorithms/morse_smale/edge_star.hpp>
#include <gale/base/bits.hpp>

namespace gale::detail {

namespace {

/// Up to here looking through a whole VT row for an edge is faster than to sort it.
constexpr Id short_row = 256;

}  // namespace

EdgeStar::EdgeStar(const Mesh& mesh) : mesh_(mesh), cell_(mesh.cell_reader()), cell_input_(mesh.cells_in_input()) {}

void EdgeStar::find(Id high, Id low, const Row& tetrahedra) {
  wedges_.clear();
  if (tetrahedra.size() <= short_row) {
    for (const Id t : tetrahedra) {
      const Quad corners = cell_(t);
      if (corners.a == low || corners.b == low || corners.c == low || corners.d == low) add_wedge(t);
    }
  } else {
    const VertexStar& star = star_of(high, tetrahedra);
    auto at = std::lower_bound(star.begin(), star.end(), pair_key(low, 0));
    for (; at != star.end() && pair_first(*at) == low; ++at) add_wedge(pair_second(*at));
  }
  std::sort(wedges_.begin(), wedges_.end(), [](const Wedge& a, const Wedge& b) { return a.input < b.input; });
  find_thirds(high, low);
  go_around();
}

/// That of a vertex with a long row. Kept, because walls come back to a vertex for one edge after the other.
const EdgeStar::VertexStar& EdgeStar::star_of(Id vertex, const Row& tetrahedra) {
  const auto [entry, is_new] = long_stars_.try_emplace(vertex);
  VertexStar& star = entry->second;
  if (!is_new) return star;
  star.reserve(3 * static_cast<std::size_t>(tetrahedra.size()));
  for (const Id t : tetrahedra) {
    const Quad corners = cell_(t);
    for (int corner = 0; corner < 4; ++corner) {
      const Id other = corners[corner];
      if (other != vertex) star.push_back(pair_key(other, t));
    }
  }
  std::sort(star.begin(), star.end());
  return star;
}

void EdgeStar::add_wedge(Id tetrahedron) {
  wedges_.push_back({cell_input_[tetrahedron], tetrahedron, {-1, -1}, false});
}

/// The edge's triangles, and the wedges at each of them.
void EdgeStar::find_thirds(Id high, Id low) {
  at_sides_.clear();
  for (int i = 0; i < static_cast<int>(wedges_.size()); ++i) {
    const Quad corners = cell_(wedges_[i].tetrahedron);
    for (int corner = 0; corner < 4; ++corner) {
      const Id vertex = corners[corner];
      if (vertex != high && vertex != low) at_sides_.push_back(pair_key(vertex, i));
    }
  }
  std::sort(at_sides_.begin(), at_sides_.end());
  thirds_.clear();
  side_begin_.clear();
  for (int i = 0; i < static_cast<int>(at_sides_.size()); ++i) {
    const Id third = pair_first(at_sides_[i]);
    if (thirds_.empty() || thirds_.back() != third) {
      thirds_.push_back(third);
      side_begin_.push_back(i);
    }
    auto& sides = wedges_[pair_second(at_sides_[i])].sides;
    sides[sides[0] < 0 ? 0 : 1] = static_cast<int>(thirds_.size()) - 1;
  }
  side_next_ = side_begin_;
  side_begin_.push_back(static_cast<int>(at_sides_.size()));
}

/// Goes from ends first, then round what has none.
void EdgeStar::go_around() {
  around_.clear();
  for (const bool from_ends : {true, false}) {
    for (int i = 0; i < static_cast<int>(wedges_.size()); ++i) {
      if (!wedges_[i].taken && (is_end(wedges_[i]) || !from_ends)) go_from(i);
    }
  }
}

/// Goes from wedge to wedge over the sides that they share, until there is no further.
void EdgeStar::go_from(int at) {
  take(at);
  const auto& sides = wedges_[at].sides;
  const int one = next(sides[0]), other = next(sides[1]);
  const bool over_first = other < 0 || (one >= 0 && one <= other);
  for (int side = sides[over_first ? 0 : 1]; (at = next(side)) >= 0;) {
    take(at);
    side = wedges_[at].sides[0] == side ? wedges_[at].sides[1] : wedges_[at].sides[0];
  }
}

void EdgeStar::take(int wedge) {
  wedges_[wedge].taken = true;
  around_.push_back(wedges_[wedge].tetrahedron);
}

/// Has it a side of its own?
bool EdgeStar::is_end(const Wedge& wedge) const {
  return std::any_of(wedge.sides, wedge.sides + 2,
                     [this](int side) { return side_begin_[side + 1] - side_begin_[side] == 1; });
}

/// The first wedge beyond a side that isn't taken; -1 if there is none.
int EdgeStar::next(int side) {
  int& at = side_next_[side];
  while (at < side_begin_[side + 1] && wedges_[pair_second(at_sides_[at])].taken) ++at;
  return at < side_begin_[side + 1] ? pair_second(at_sides_[at]) : -1;
}

}  // namespace gale::detail
