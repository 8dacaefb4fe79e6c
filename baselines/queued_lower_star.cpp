#include <algorithm>

#include <gale/baselines/queued_lower_star.hpp>

namespace gale::detail {

namespace {

/// Makes room for `count` values. What they are doesn't matter.
template <class T>
void make_room(std::vector<T>& values, std::size_t count) {
  if (values.size() < count) values.resize(count);
}

}  // namespace

void QueuedLowerStar::begin(Id edges, Id triangles, Id tetrahedra) {
  triangles_.begin(edges, triangles);
  edge_cell_.resize(edges);
  make_room(inner_, std::size_t(tetrahedra) + 1);
  make_room(outer_, std::size_t(tetrahedra) + 1);
  inner_count_ = outer_count_ = 0;
}

void QueuedLowerStar::end_triangles() { triangles_.number(); }

void QueuedLowerStar::end() {
  find_sides();
  number_cells();
  place_tetrahedra();
  connect();
  ready_.begin(cell_count_);
  deferred_.begin(cell_count_);
}

inline void QueuedLowerStar::add_side(Id triangle, Id tetrahedron) {
  sides_[side_count_] = {tetrahedron, sides_of_[triangle].sides};
  sides_of_[triangle].sides = side_count_++;
}

void QueuedLowerStar::find_sides() {
  make_room(sides_of_, triangles_.size());
  for (Id i = 0; i < triangles_.size(); ++i) sides_of_[i] = {0, 0, -1};
  make_room(sides_, 3 * std::size_t(inner_count_) + outer_count_);
  side_count_ = 0;
  for (int i = 0; i < outer_count_; ++i) add_side(triangles_(outer_[i].a, outer_[i].b), outer_[i].id);
  for (int i = 0; i < inner_count_; ++i) {
    Tetrahedron& t = inner_[i];
    t.triangles[0] = triangles_(t.a, t.b);
    t.triangles[1] = triangles_(t.a, t.c);
    t.triangles[2] = triangles_(t.b, t.c);
    ++sides_of_[t.triangles[0]].tetrahedra;
    for (const Id triangle : t.triangles) add_side(triangle, t.id);
  }
}

/// Numbers each edge a, then each triangle (a, b), and leaves room behind it for its tetrahedra (a, b, c).
void QueuedLowerStar::number_cells() {
  make_room(cells_, edge_cell_.size() + triangles_.size() + inner_count_);
  cell_count_ = 0;
  for (Id a = 0; a < static_cast<Id>(edge_cell_.size()); ++a) {
    edge_cell_[a] = cell_count_;
    cells_[cell_count_++] = {{a, -1, -1}, -1, 0, 0, -1};
    for (Id i = triangles_.first(a); i < triangles_.first(a + 1); ++i) {
      sides_of_[i].cell = cell_count_;
      cells_[cell_count_] = {{a, triangles_.low(i), -1}, i, 0, 0, -1};
      cell_count_ += 1 + sides_of_[i].tetrahedra;
    }
  }
}

void QueuedLowerStar::place_tetrahedra() {
  make_room(tetrahedron_cell_, inner_count_);
  for (int i = 0; i < inner_count_; ++i) {
    const Tetrahedron& t = inner_[i];
    Triangle& below = sides_of_[t.triangles[0]];
    const int cell = tetrahedron_cell_[i] = below.cell + below.tetrahedra--;
    cells_[cell] = {{t.a, t.b, t.c}, i, 0, 0, -1};
  }
  for (int i = 0; i < inner_count_; ++i) {
    const int first = tetrahedron_cell_[i];
    if (cells_[first - 1].corners[2] >= 0) continue;  // not the first of its triangle's
    int end = first + 1;
    while (end < cell_count_ && cells_[end].corners[2] >= 0) ++end;
    if (end - first == 1) continue;
    std::sort(&cells_[first], &cells_[first] + (end - first),
              [](const Cell& one, const Cell& other) { return one.corners[2] < other.corners[2]; });
  }
}

inline void QueuedLowerStar::add_facet(int cell, int facet) {
  ++cells_[cell].open;
  cells_[cell].left ^= facet;
  cofacets_[cofacet_count_] = {cell, cells_[facet].cofacets};
  cells_[facet].cofacets = cofacet_count_++;
}

void QueuedLowerStar::connect() {
  make_room(cofacets_, 2 * std::size_t(triangles_.size()) + 3 * std::size_t(inner_count_));
  cofacet_count_ = 0;
  for (Id i = 0; i < triangles_.size(); ++i) {
    const int cell = sides_of_[i].cell;
    add_facet(cell, edge_cell_[cells_[cell].corners[0]]);
    add_facet(cell, edge_cell_[cells_[cell].corners[1]]);
  }
  for (int i = 0; i < inner_count_; ++i) {
    const int cell = tetrahedron_cell_[i];
    for (const Id triangle : inner_[cells_[cell].place].triangles) add_facet(cell, sides_of_[triangle].cell);
  }
}

Id QueuedLowerStar::across(int triangle, Id tetrahedron, const OtherIds& numbers) const {
  Id best = no_id;
  for_each_tetrahedron(triangle, [&](Id other) {
    if (other != tetrahedron && (best == no_id || numbers[other] < numbers[best])) best = other;
  });
  return best;
}

}  // namespace gale::detail
