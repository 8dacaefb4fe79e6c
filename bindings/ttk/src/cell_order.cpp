#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/relations/faces.hpp>
#include <gale/ttk/cell_order.hpp>

namespace gale::ttk {

namespace {

using Ids = Array<Id, HostMemory>;
using Bytes = Array<std::uint8_t, HostMemory>;

/// The cells of a triangle as far as they are known, in one word: the least, and the other, as in TriangleOrder.
using Star = std::uint64_t;
constexpr Star star_of(Id first, Id second) {
  return std::uint64_t(std::uint32_t(first)) << 32 | std::uint32_t(second);
}
constexpr Id first_of(Star star) { return static_cast<Id>(star >> 32); }
constexpr Id second_of(Star star) { return static_cast<Id>(star & 0xffffffff); }

constexpr Star with_cell(Star star, Id cell) {
  const Id first = first_of(star), second = second_of(star);
  if (first == no_id) return star_of(cell, no_id);
  const Id least = cell < first ? cell : first;
  if (second != no_id) return star_of(least, TriangleOrder::crowded);
  return star_of(least, cell < first ? first : cell);
}

/// *at = change(*at), by several threads.
template <class T, class Change>
void update(T* at, const Change& change) {
  for (T there = atomic_read(at);;) {
    const T changed = change(there);
    if (changed == there) return;
    const T was = atomic_compare_exchange(at, there, changed);
    if (was == there) return;
    there = was;
  }
}

/// Bits that are set; by hand, since processors that C++ is compiled for may have no instruction for it.
int count_of(unsigned byte) {
  byte -= byte >> 1 & 0x55;
  byte = (byte & 0x33) + (byte >> 2 & 0x33);
  return static_cast<int>((byte + (byte >> 4)) & 15);
}

/// Numbers simplices. first(simplex): its first cell; corners(simplex, cell): which corners of that cell it has, as
/// bits; take(simplex, number) learns the number.
template <class First, class Corners, class Take>
void number(CellOrder& order, Id count, Id cells, const First& first, const Corners& corners, const Take& take) {
  const HostSpace host;
  const auto fresh = order.fresh = allocate<Bytes>("GALE::ttk_first_met", cells);
  fill("GALE::ttk_clear_met", host, fresh, 0);
  const auto bit_of = [&](Id i) { return 1u << place_of_corners[corners(i, first(i))]; };
  parallel_for("GALE::ttk_meet", host, count, [&](Offset i) {
    const Id id = static_cast<Id>(i);
    __atomic_fetch_or(&fresh(first(id)), static_cast<std::uint8_t>(bit_of(id)), __ATOMIC_RELAXED);
  });
  const auto begin = allocate<Ids>("GALE::ttk_met_before", cells + 1);
  exclusive_scan("GALE::ttk_count_met", host, cells, begin, [&](Offset c) { return count_of(fresh(c)); });
  parallel_for("GALE::ttk_number", host, count, [&](Offset i) {
    const Id id = static_cast<Id>(i), cell = first(id);
    take(id, begin(cell) + count_of(fresh(cell) & (bit_of(id) - 1)));
  });
}

/// found(part, cell) for each part of each tetrahedron by a relation, TE or TF.
template <Relation relation, class Found>
void find_parts(const Mesh& mesh, const Simplices<HostMemory>& simplices, const Found& found) {
  const Id* const input = mesh.tetrahedron_input().data();
  parallel_for("GALE::ttk_first_cells", HostSpace(), mesh.tetrahedra(), [&](Offset t) {
    for (const Id part : face_row<relation>(simplices, static_cast<Id>(t))) found(part, input[t]);
  });
}

template <Relation relation>
auto corners_by(const Mesh& mesh, const Simplices<HostMemory>& simplices, const Cells& cells) {
  return [&simplices, &cells, input = mesh.vertex_input().data()](Id simplex, Id cell) {
    auto vertices = face_row<relation>(simplices, simplex);
    for (Id& vertex : vertices.ids) vertex = input[vertex];
    return cells.corners_of(cell, vertices);
  };
}

}  // namespace

CellOrder order_of_edges(const Mesh& mesh, const Cells& cells) {
  const auto simplices = mesh.simplices({Enumeration::edges, false, true});
  const auto count = static_cast<Id>(simplices.edge_low.extent(0));
  CellOrder order;
  const auto first = order.number = allocate<Ids>("GALE::ttk_number", count);  // numbers take the cells' place
  const auto cells_by_number = order.first_cells = allocate<Ids>("GALE::ttk_cells_of_edges", count);
  fill("GALE::ttk_clear_first", HostSpace(), first, mesh.tetrahedra());
  find_parts<Relation::TE>(mesh, simplices, [&](Id edge, Id cell) {
    update(&first(edge), [&](Id there) { return cell < there ? cell : there; });
  });
  number(
      order, count, mesh.tetrahedra(), [&](Id edge) { return first(edge); },
      corners_by<Relation::EV>(mesh, simplices, cells),
      [&](Id edge, Id number) {
        cells_by_number(number) = first(edge);
        first(edge) = number;
      });
  return order;
}

TriangleOrder order_of_triangles(const Mesh& mesh, const Cells& cells) {
  const auto simplices = mesh.simplices({Enumeration::triangles, false, true});
  const auto count = static_cast<Id>(simplices.triangle_edge.extent(0));
  const HostSpace host;
  const auto stars = allocate<Array<Star, HostMemory>>("GALE::ttk_stars", count);
  fill("GALE::ttk_clear_stars", host, stars, star_of(no_id, no_id));
  find_parts<Relation::TF>(mesh, simplices, [&](Id triangle, Id cell) {
    update(&stars(triangle), [&](Star star) { return with_cell(star, cell); });
  });
  TriangleOrder order;
  order.stride = 2;
  order.any_crowded = reduce_sum("GALE::ttk_crowded_triangles", host, count,
                                 [&](Offset i) { return second_of(stars(i)) == TriangleOrder::crowded ? 1 : 0; }) != 0;
  const auto numbers = order.number = allocate<Ids>("GALE::ttk_number", count);
  const auto by_number = order.first_cells = allocate<Ids>("GALE::ttk_cells_of_triangles", Offset(2) * count);
  number(
      order, count, mesh.tetrahedra(), [&](Id triangle) { return first_of(stars(triangle)); },
      corners_by<Relation::FV>(mesh, simplices, cells),
      [&](Id triangle, Id number) {
        numbers(triangle) = number;
        by_number(Offset(2) * number) = first_of(stars(triangle));
        by_number(Offset(2) * number + 1) = second_of(stars(triangle));
      });
  return order;
}

}  // namespace gale::ttk
