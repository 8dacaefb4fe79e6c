#include <type_traits>

#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/cell_order.hpp>

namespace gale::ttk {

namespace {

using Ids = Array<Id, HostMemory>;

/// The cells of a facet as far as they are known, in one word: the least, and the other, as in CellOrder.
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
  if (second != no_id) return star_of(least, CellOrder::crowded);
  return star_of(least, cell < first ? first : cell);
}

/// Keep the least cell alone, for other simplices.
constexpr Id first_of(Id least) { return least; }
constexpr Id with_cell(Id least, Id cell) { return cell < least ? cell : least; }

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

/// Numbers simplices. `none`: a star without cells. parts(corners): those of a cell, in GALE's ids. each(visit): calls
/// visit(simplex, vertices) for each with its vertices (of the input), by several threads.
template <class Word, class Parts, class Each>
CellOrder number(const Mesh& mesh, const Cells& cells, Id count, Word none, const Parts& parts, const Each& each) {
  const HostExecutionSpace host;
  const Id *const input = mesh.cell_input().data(), *const vertex_internal = mesh.vertex_internal().data();
  const auto stars = allocate<Array<Word, HostMemory>>("GALE::ttk_stars", count);
  fill("GALE::ttk_clear_stars", host, stars, none);
  parallel_for("GALE::ttk_first_cells", host, mesh.cells(), [&](Offset t) {  // GALE's lie near each other in its tables
    for (const Id part : parts(SortedCorners(cells, input[t], vertex_internal))) {
      if (part != no_id) update(&stars(part), [&](Word star) { return with_cell(star, input[t]); });
    }
  });
  CellOrder order;
  order.met = FirstMet(cells.count());
  const auto place_of = [&](const auto& vertices, Id cell) {
    return place_of_corners[cells.corners_of(cell, vertices)];
  };
  each([&](Id simplex, const auto& vertices) {
    const Id cell = first_of(stars(simplex));
    order.met.meet(cell, place_of(vertices, cell));
  });
  order.met.count(count);
  const auto number_of = [&](Id simplex, const auto& vertices) {
    const Id cell = first_of(stars(simplex));
    return order.met.number(cell, place_of(vertices, cell));
  };
  if constexpr (std::is_same_v<Word, Star>) {
    order.any_crowded = reduce_sum("GALE::ttk_crowded", host, count,
                                   [&](Offset i) { return second_of(stars(i)) == CellOrder::crowded ? 1 : 0; }) != 0;
    const auto numbers = allocate<Ids>("GALE::ttk_number", count);
    const auto second = allocate<Ids>("GALE::ttk_second_cells", count);
    each([&](Id simplex, const auto& vertices) {
      numbers(simplex) = number_of(simplex, vertices);
      second(numbers(simplex)) = second_of(stars(simplex));
    });
    order.number = PackedIds(numbers, 0, count - 1);
    order.second = PackedIds(second, CellOrder::crowded, cells.count() - 1);
  } else {  // numbers take the cells' place
    each([&](Id simplex, const auto& vertices) { stars(simplex) = number_of(simplex, vertices); });
    order.number = PackedIds(stars, 0, count - 1);
  }
  return order;
}

}  // namespace

CellOrder order_of(int dimension, const Mesh& mesh, const Cells& cells) {
  const auto simplices = mesh.simplices(dimension == 1 ? tables_of_edges : tables_of_triangles);
  const Id* const input = mesh.vertex_input().data();
  const auto each_edge = [&](const auto& visit) {
    parallel_for("GALE::ttk_number_edges", HostExecutionSpace(), mesh.vertices(), [&](Offset a) {
      for (Id edge = simplices.edge_begin(a); edge < simplices.edge_begin(a + 1); ++edge) {
        visit(edge, std::array<Id, 2>{input[a], input[simplices.edge_high(edge)]});
      }
    });
  };
  const Star no_cells = star_of(no_id, no_id);
  if (dimension == 2) {
    return number(
        mesh, cells, static_cast<Id>(simplices.triangle_apex.extent(0)), no_cells,
        [&](const SortedCorners& corners) { return corners.triangles(simplices); },
        [&](const auto& visit) {
          each_edge([&](Id edge, const auto& ends) {
            for (Id i = simplices.triangle_begin(edge); i < simplices.triangle_begin(edge + 1); ++i) {
              visit(i, std::array<Id, 3>{ends[0], ends[1], input[simplices.triangle_apex(i)]});
            }
          });
        });
  }
  const auto parts = [&](const SortedCorners& corners) { return corners.edges(simplices); };
  const auto count = static_cast<Id>(simplices.edge_high.extent(0));
  return mesh.dimension() == 2 ? number(mesh, cells, count, no_cells, parts, each_edge)
                               : number(mesh, cells, count, mesh.cells(), parts, each_edge);
}

}  // namespace gale::ttk
