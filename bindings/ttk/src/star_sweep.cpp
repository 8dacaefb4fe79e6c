#include <vector>

#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/links/small_link.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

namespace {

/// What one consumer works with.
struct alignas(64) Worker {
  gale::detail::LargeLink large;
  BlockBuilder neighbours, cells;
  StarOrder star;

  bool is_on_surface(Id neighbours, const LinkRow& link) {
    if (neighbours <= gale::detail::SmallLink::capacity) return gale::detail::SmallLink(neighbours, link).is_open();
    large.build(link);
    return large.is_open();
  }
};

}  // namespace

/// Finds the vertices on the surface in a sweep, which has the rows of VV and VT: as many as there is memory for are
/// kept as blocks.
Connectivity::Flags Connectivity::find_surface_in_sweep() {
  const Flags on_surface = no_flags(0);
  const SweepOptions options;
  std::vector<Worker> workers(options.threads);
  const Id* const tetrahedron_input = numbers_of(3);
  const bool keeps_cells = wanted_rows_.has(Relation::VT);
  Structure& stars = structure(source_of(Relation::VV));
  stars.for_each_segment(star_relations, options, [&](int consumer, const SegmentRows& rows) {
    Worker& worker = workers[consumer];
    const Interval vertices = rows.interval(0);
    const bool keep = store_->bytes() < store_->budget();
    worker.neighbours.begin(vertices.first, vertices.size());
    worker.cells.begin(vertices.first, vertices.size());
    for (const Id v : vertices) {
      const Row neighbours = rows[Relation::VV][v];
      const LinkRow link = rows.links()[v];
      if (keep) worker.star.sort(rows[Relation::VT][v], tetrahedron_input, cells_);
      if (worker.is_on_surface(neighbours.size(), link)) set_flag(on_surface, vertex_input_[v]);
      if (!keep) continue;
      worker.star.add_neighbours(worker.neighbours, neighbours, link, cells_, vertex_input_);
      worker.neighbours.end_row();
      for (Id i = 0; keeps_cells && i < worker.star.size(); ++i) worker.cells.add(worker.star.cell(i));
      worker.cells.end_row();
    }
    if (!keep) return;
    store_->put(Relation::VV, rows.segment(), worker.neighbours.take());
    if (keeps_cells) store_->put(Relation::VT, rows.segment(), worker.cells.take());
  });
  return on_surface;
}

}  // namespace gale::ttk
