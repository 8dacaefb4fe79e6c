#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/cell_order.hpp>

namespace gale::ttk {

namespace {

using Ids = Array<Id, HostMemory>;

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

/// Numbers simplices. each(visit): calls visit(simplex, vertices) for each simplex (GALE's id) with its vertices (of
/// the input), by several threads. first(simplex): its first cell.
template <class Each, class First, class Take>
void number(CellOrder& order, Id count, const Cells& cells, const Each& each, const First& first, const Take& take) {
  order.met = FirstMet(cells.count());
  const auto place_of = [&](const auto& vertices, Id cell) {
    return place_of_corners[cells.corners_of(cell, vertices)];
  };
  each([&](Id simplex, const auto& vertices) {
    const Id cell = first(simplex);
    order.met.meet(cell, place_of(vertices, cell));
  });
  order.met.count(count);
  each([&](Id simplex, const auto& vertices) {
    const Id cell = first(simplex);
    take(simplex, order.met.number(cell, place_of(vertices, cell)));
  });
}

/// found(part, cell) for each of the parts that parts(corners) are of a cell. In the order of GALE's tetrahedra, which
/// lie near each other in GALE's tables.
template <class Parts, class Found>
void find_parts(const Mesh& mesh, const Cells& cells, const Parts& parts, const Found& found) {
  const Id *const input = mesh.cell_input().data(), *const vertex_internal = mesh.vertex_internal().data();
  parallel_for("GALE::ttk_first_cells", HostExecutionSpace(), mesh.cells(), [&](Offset t) {
    for (const Id part : parts(SortedCorners(cells, input[t], vertex_internal))) found(part, input[t]);
  });
}

}  // namespace

CellOrder order_of_edges(const Mesh& mesh, const Cells& cells) {
  const auto simplices = mesh.simplices(tables_of_edges);
  const auto count = static_cast<Id>(simplices.edge_high.extent(0));
  const Id* const input = mesh.vertex_input().data();
  CellOrder order;
  const auto first = allocate<Ids>("GALE::ttk_number", count);  // numbers take the cells' place
  fill("GALE::ttk_clear_first", HostExecutionSpace(), first, mesh.cells());
  find_parts(
      mesh, cells, [&](const SortedCorners& corners) { return corners.edges(simplices); },
      [&](Id edge, Id cell) { update(&first(edge), [&](Id there) { return cell < there ? cell : there; }); });
  const auto each = [&](const auto& visit) {
    parallel_for("GALE::ttk_number_edges", HostExecutionSpace(), mesh.vertices(), [&](Offset a) {
      for (Id edge = simplices.edge_begin(a); edge < simplices.edge_begin(a + 1); ++edge) {
        visit(edge, std::array<Id, 2>{input[a], input[simplices.edge_high(edge)]});
      }
    });
  };
  number(
      order, count, cells, each, [&](Id edge) { return first(edge); },
      [&](Id edge, Id number) { first(edge) = number; });
  order.number = PackedIds(first, 0, count - 1);
  return order;
}

TriangleOrder order_of_triangles(const Mesh& mesh, const Cells& cells) {
  const auto simplices = mesh.simplices(tables_of_triangles);
  const auto count = static_cast<Id>(simplices.triangle_apex.extent(0));
  const Id* const input = mesh.vertex_input().data();
  const HostExecutionSpace host;
  const auto stars = allocate<Array<Star, HostMemory>>("GALE::ttk_stars", count);
  fill("GALE::ttk_clear_stars", host, stars, star_of(no_id, no_id));
  find_parts(
      mesh, cells, [&](const SortedCorners& corners) { return corners.triangles(simplices); },
      [&](Id triangle, Id cell) { update(&stars(triangle), [&](Star star) { return with_cell(star, cell); }); });
  TriangleOrder order;
  order.any_crowded = reduce_sum("GALE::ttk_crowded_triangles", host, count,
                                 [&](Offset i) { return second_of(stars(i)) == TriangleOrder::crowded ? 1 : 0; }) != 0;
  const auto numbers = allocate<Ids>("GALE::ttk_number", count);
  const auto second = allocate<Ids>("GALE::ttk_second_cells", count);
  const auto each = [&](const auto& visit) {
    parallel_for("GALE::ttk_number_triangles", host, mesh.vertices(), [&](Offset a) {
      for (Id edge = simplices.edge_begin(a); edge < simplices.edge_begin(a + 1); ++edge) {
        const Id b = input[simplices.edge_high(edge)];
        for (Id i = simplices.triangle_begin(edge); i < simplices.triangle_begin(edge + 1); ++i) {
          visit(i, std::array<Id, 3>{input[a], b, input[simplices.triangle_apex(i)]});
        }
      }
    });
  };
  number(
      order, count, cells, each, [&](Id triangle) { return first_of(stars(triangle)); },
      [&](Id triangle, Id number) {
        numbers(triangle) = number;
        second(number) = second_of(stars(triangle));
      });
  order.number = PackedIds(numbers, 0, count - 1);
  order.second = PackedIds(second, TriangleOrder::crowded, cells.count() - 1);
  return order;
}

}  // namespace gale::ttk
