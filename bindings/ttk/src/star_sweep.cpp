#include <algorithm>
#include <memory>
#include <vector>

#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/links/small_link.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/ttk/connectivity.hpp>

#include "star_rows.hpp"

namespace gale::ttk {

namespace {

/// What one consumer works with.
struct alignas(64) SweepScratch {
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
  finds_stars_in_cells_ ? sweep_cells(on_surface, true) : sweep_structure(on_surface);
  return on_surface;
}

void Connectivity::sweep_cells(const Flags& on_surface, bool keep) const {
  constexpr Id together = 16;
  const int threads = host_threads();
  segments_.group(cells_);
  std::vector<std::unique_ptr<StarRows>> workers(threads);
  in_turns(threads, (Offset(segments_.count()) + together - 1) / together, [&](int thread, Offset turn) {
    auto& stars = workers[thread];
    if (!stars) stars = std::make_unique<StarRows>(segments_, cells_);
    const Id begin = static_cast<Id>(turn) * together, end = std::min(begin + together, segments_.count());
    for (Id segment = begin; segment < end; ++segment) {
      stars->find(segment);
      Block neighbours = stars->neighbours();
      for (const Id vertex : stars->on_surface()) set_flag(on_surface, vertex);
      if (!keep || store_->bytes() >= store_->budget()) continue;
      store_->put(Relation::VV, segment, std::move(neighbours));
      if (wanted_rows_.has(Relation::VT)) store_->put(Relation::VT, segment, stars->stars());
    }
  });
}

void Connectivity::sweep_structure(const Flags& on_surface) {
  const SweepOptions options;
  std::vector<SweepScratch> all_scratch(options.threads);
  const Id* const cell_input = mesh_->cell_input().data();
  const bool keeps_cells = wanted_rows_.has(Relation::VT);
  Structure& stars = structure(source_of(Relation::VV));
  const Relation vertex_cells = in_mesh(Relation::VT);
  stars.for_each_segment(star_relations_of(dimension()), options, [&](int consumer, const SegmentRows& rows) {
    SweepScratch& scratch = all_scratch[consumer];
    const Interval vertices = rows.interval(0);
    const bool keep = store_->bytes() < store_->budget();
    scratch.neighbours.begin(vertices.first, vertices.size());
    scratch.cells.begin(vertices.first, vertices.size());
    for (const Id v : vertices) {
      const Row neighbours = rows[Relation::VV][v];
      const LinkRow link = rows.links()[v];
      if (keep) scratch.star.sort(rows[vertex_cells][v], cell_input, cells_);
      if (scratch.is_on_surface(neighbours.size(), link)) set_flag(on_surface, vertex_input_[v]);
      if (!keep) continue;
      scratch.star.add_neighbours(scratch.neighbours, neighbours, link, cells_, vertex_input_);
      scratch.neighbours.end_row();
      for (Id i = 0; keeps_cells && i < scratch.star.size(); ++i) scratch.cells.add(scratch.star.cell(i));
      scratch.cells.end_row();
    }
    if (!keep) return;
    store_->put(Relation::VV, rows.segment(), scratch.neighbours.take());
    if (keeps_cells) store_->put(Relation::VT, rows.segment(), scratch.cells.take());
  });
}

}  // namespace gale::ttk
