#include <gale/base/atomic.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/parallel.hpp>
#include <gale/relations/faces.hpp>
#include <gale/ttk/cell_order.hpp>

namespace gale::ttk {

namespace {

using Ids = Array<Id, HostMemory>;
using Bytes = Array<std::uint8_t, HostMemory>;

void lower_to(Id* at, Id value) {
  for (Id there = atomic_read(at); value < there;) {
    const Id was = atomic_compare_exchange(at, there, value);
    if (was == there) return;
    there = was;
  }
}

/// Numbers simplices whose first cells are known; the numbers take their place. corners(simplex, cell): which corners
/// of that cell it has, as bits.
template <class Corners>
CellOrder number(const Ids& first_cell, Id cells, const Corners& corners) {
  const HostSpace host;
  const auto count = static_cast<Offset>(first_cell.extent(0));
  const auto met = allocate<Bytes>("GALE::ttk_first_met", cells);
  parallel_for("GALE::ttk_clear_met", host, cells, [&](Offset c) { met(c) = 0; });
  const auto bit_of = [&](Offset i) { return 1u << place_of_corners[corners(static_cast<Id>(i), first_cell(i))]; };
  parallel_for("GALE::ttk_meet", host, count, [&](Offset i) {
    __atomic_fetch_or(&met(first_cell(i)), static_cast<std::uint8_t>(bit_of(i)), __ATOMIC_RELAXED);
  });
  const auto begin = allocate<Ids>("GALE::ttk_met_before", cells + 1);
  exclusive_scan("GALE::ttk_count_met", host, cells, begin,
                 [&](Offset c) { return count_bits(std::uint32_t(met(c))); });
  CellOrder order{first_cell, allocate<Ids>("GALE::ttk_internal", count)};
  parallel_for("GALE::ttk_number", host, count, [&](Offset i) {
    const Id cell = first_cell(i);
    order.number(i) = begin(cell) + count_bits(std::uint32_t(met(cell)) & (bit_of(i) - 1));
    order.internal(order.number(i)) = static_cast<Id>(i);
  });
  return order;
}

/// For each part of a tetrahedron by a relation, TE or TF, the least input cell that has it; each(part) is called for
/// every one of them.
template <Relation relation, class Each>
Ids first_cells(const Mesh& mesh, const Simplices<HostMemory>& simplices, Id parts, const Each& each) {
  const HostSpace host;
  const auto first = allocate<Ids>("GALE::ttk_number", parts);
  parallel_for("GALE::ttk_clear_first", host, parts, [&](Offset i) { first(i) = mesh.tetrahedra(); });
  const Id* const input = mesh.tetrahedron_input().data();
  parallel_for("GALE::ttk_first_cells", host, mesh.tetrahedra(), [&](Offset t) {
    for (const Id part : face_row<relation>(simplices, static_cast<Id>(t))) {
      lower_to(&first(part), input[t]);
      each(part);
    }
  });
  return first;
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
  const auto first =
      first_cells<Relation::TE>(mesh, simplices, static_cast<Id>(simplices.edge_low.extent(0)), [](Id) {});
  return number(first, mesh.tetrahedra(), corners_by<Relation::EV>(mesh, simplices, cells));
}

CellOrder order_of_triangles(const Mesh& mesh, const Cells& cells, Bytes& tetrahedra) {
  const auto simplices = mesh.simplices({Enumeration::triangles, false, true});
  const auto count = static_cast<Id>(simplices.triangle_edge.extent(0));
  const HostSpace host;
  const auto found = allocate<Bytes>("GALE::ttk_tetrahedra_found", count);
  parallel_for("GALE::ttk_clear_found", host, count, [&](Offset i) { found(i) = 0; });
  const auto first = first_cells<Relation::TF>(mesh, simplices, count, [&](Id triangle) {
    for (std::uint8_t was = atomic_read(&found(triangle)); was < 3;) {
      const std::uint8_t there = atomic_compare_exchange(&found(triangle), was, static_cast<std::uint8_t>(was + 1));
      if (there == was) return;
      was = there;
    }
  });
  const CellOrder order = number(first, mesh.tetrahedra(), corners_by<Relation::FV>(mesh, simplices, cells));
  tetrahedra = allocate<Bytes>("GALE::ttk_tetrahedra_of_triangles", count);
  parallel_for("GALE::ttk_number_found", host, count, [&](Offset i) { tetrahedra(i) = found(order.internal(i)); });
  return order;
}

}  // namespace gale::ttk
