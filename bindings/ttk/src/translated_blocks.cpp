#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/ttk/connectivity.hpp>

#include "star_rows.hpp"

namespace gale::ttk {

Structure& Connectivity::structure(int source) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& [wanted, structure] = sources_[source];
  if (!structure) structure = make_structure(*mesh_, wanted, options_.structure);
  return *structure;
}

void Connectivity::refuse(Relation relation) const {
  throw Error("rows of " + name_of(in_mesh(relation)) + " were not preconditioned");
}

/// Has the block be `now` that has a simplex.
void Connectivity::load(Reader& reader, Relation relation, Id id, Id lowest) const {
  if (!wanted_rows_.has(relation)) refuse(relation);
  auto& [now, next] = reader.readings[static_cast<int>(relation)];
  if (next.has(id)) {
    std::swap(now, next);
    reader.leave(next);
    return;
  }
  reader.leave(now);
  const Id segment = segments_.of(vertex_input_[lowest]);  // to which a simplex is internal
  now = HeldBlock(store_->hold(relation, segment, [&] { return make_block(reader, relation, segment); }));
}

/// Groups cells by segments, unless that was done: modules that need edges, too, never come here before.
std::shared_ptr<StarRows> Connectivity::new_stars() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  segments_.group(cells_);
  return std::make_shared<StarRows>(segments_, cells_);
}

/// Computes the rows of a segment's simplices and puts them into TTK's ids and order.
Block Connectivity::make_block(Reader& reader, Relation relation, Id segment) const {
  blocks_made_.fetch_add(1, std::memory_order_relaxed);
  if (finds_in_cells(relation)) {
    if (!reader.stars) reader.stars = new_stars();
    reader.stars->find(segment);
    return relation == Relation::VV ? reader.stars->neighbours() : reader.stars->stars();
  }
  const int source = source_of(relation);
  if (!reader.consumers[source]) reader.consumers[source] = structure(source).consumer();
  Consumer& consumer = *reader.consumers[source];
  const auto& begin = mesh_->interval_begin(row_dimension(relation));
  const Interval rows{begin(segment), begin(segment + 1)};
  reader.builder.begin(rows.first, rows.size());
  const auto add = [&](const auto& numbers) {
    for (const Id i : rows) {
      reader.builder.add_sorted(consumer.row(in_mesh(relation), i), numbers);
      reader.builder.end_row();
    }
  };
  switch (entry_dimension(relation)) {
    case 0:  // VV, in another order
      for (const Id i : rows) {
        reader.star.sort(consumer.row(in_mesh(Relation::VT), i), mesh_->cell_input().data(), cells_);
        reader.star.add_neighbours(reader.builder, consumer.row(Relation::VV, i), consumer.link(i), cells_,
                                   vertex_input_);
        reader.builder.end_row();
      }
      break;
    case 1:
      add(edges_.number);
      break;
    case 2:
      add(triangles_.number);
      break;
    default:
      add(mesh_->cell_input().data());
  }
  return reader.builder.take();
}

}  // namespace gale::ttk
