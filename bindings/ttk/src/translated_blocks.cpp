#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

Structure& Connectivity::structure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!structure_) structure_ = make_structure(mesh_, wanted_, options_.structure);
  return *structure_;
}

void Connectivity::load(Reader& reader, Relation relation, Id id) const {
  if (!wanted_.has(relation)) throw Error("rows of " + name_of(relation) + " were not preconditioned");
  Reading& reading = reader.readings[static_cast<int>(relation)];
  reader.leave(reading);
  const Id segment = mesh_.segment_of(row_dimension(relation), id);
  reading.slot = &store_->hold(relation, segment, [&] { return make_block(reader, relation, segment); });
  reading.rows = reading.slot->rows();
  reading.held = {reading.rows.first, reading.rows.first + reading.rows.count};
}

/// Computes the rows of a segment's simplices and puts them into TTK's ids and order.
Block Connectivity::make_block(Reader& reader, Relation relation, Id segment) const {
  if (!reader.consumer) reader.consumer = structure().consumer();
  const auto& begin = mesh_.interval_begin(row_dimension(relation));
  const Id first = begin(segment), rows = begin(segment + 1) - first;
  auto& entries = reader.entries;
  entries.resize(rows + 1);  // the rows' offsets
  for (Id i = 0; i < rows; ++i) {
    entries[i] = static_cast<Id>(entries.size()) - rows - 1;
    if (relation == Relation::VV) {
      append_neighbours(reader, first + i);
    } else {
      append_row(reader, relation, first + i);
    }
  }
  entries[rows] = static_cast<Id>(entries.size()) - rows - 1;

  Block block;
  block.words.reset(new Id[entries.size()]);
  std::copy(entries.begin(), entries.end(), block.words.get());
  block.rows = {first, rows, block.words.get(), block.words.get() + rows + 1};
  block.bytes = entries.size() * sizeof(Id);
  return block;
}

/// GALE's id -> TTK's.
const Id* Connectivity::numbers_of(int dimension) const {
  return dimension == 0   ? vertex_input_
         : dimension == 1 ? edges_.number.data()
         : dimension == 2 ? triangles_.number.data()
                          : mesh_.tetrahedron_input().data();
}

/// All but VV: ascending.
void Connectivity::append_row(Reader& reader, Relation relation, Id simplex) const {
  const Id* const numbers = numbers_of(entry_dimension(relation));
  auto& entries = reader.entries;
  const auto begin = entries.size();
  for (const Id entry : reader.consumer->row(relation, simplex)) entries.push_back(numbers[entry]);
  std::sort(entries.begin() + static_cast<std::ptrdiff_t>(begin), entries.end());
}

/// In the order of the edges to them, which is that in which one meets them in the star: in its cells, ascending, and
/// in each cell as the caller has its corners.
void Connectivity::append_neighbours(Reader& reader, Id vertex) const {
  const Row neighbours = reader.consumer->row(Relation::VV, vertex);
  const Row cells = reader.consumer->row(Relation::VT, vertex);
  const LinkRow link = reader.consumer->link(vertex);
  const Id* const tetrahedron_input = numbers_of(3);
  auto& star = reader.star;
  star.clear();
  for (Id i = 0; i < cells.size(); ++i) star.emplace_back(tetrahedron_input[cells[i]], i);
  std::sort(star.begin(), star.end());
  reader.seen.assign(neighbours.size(), 0);
  for (const auto& [cell, i] : star) {
    Id met[3];
    int count = 0;
    for (int corner = 0; corner < 3; ++corner) {
      const Id place = link(i, corner);
      if (reader.seen[place] != 0) continue;
      reader.seen[place] = 1;
      met[count++] = vertex_input_[neighbours[place]];
    }
    for (int corner = 0; corner < 4 && count > 0; ++corner) {
      const Id here = cells_.vertex(cell, corner);
      if (std::find(met, met + count, here) != met + count) reader.entries.push_back(here);
    }
  }
}

}  // namespace gale::ttk
