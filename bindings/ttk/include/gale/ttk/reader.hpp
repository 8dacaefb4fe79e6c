#pragma once

#include <array>
#include <memory>

#include <gale/mesh/intervals.hpp>
#include <gale/runtime/consumer.hpp>
#include <gale/ttk/translation.hpp>

namespace gale::ttk {

class StarRows;

/// A block that a thread holds: the simplices (GALE's ids) that it has, and their rows.
struct HeldBlock {
  Interval held;
  Rows rows;
  BlockStore::Slot* slot = nullptr;

  HeldBlock() = default;
  explicit HeldBlock(BlockStore::Slot& in)
      : held{in.rows().first, in.rows().first + in.rows().count}, rows(in.rows()), slot(&in) {}

  bool has(Id id) const { return held.has(id); }

  void prefetch(Id id) const {
    const Row row = rows[id];
    __builtin_prefetch(row.begin());
    __builtin_prefetch(row.begin() + 16);
  }
};

/// Where a thread reads one relation: in a block, and soon in another, if that is there by then. Modules go from vertex
/// to vertex, a few of each segment before they come to the next, and every row lies elsewhere: without a look ahead
/// they would wait for memory three times a block and once or twice a row.
struct Reading {
  HeldBlock now, next;
};

/// What was found last for a simplex.
template <std::size_t n>
struct Found {
  Id simplex = no_id;
  std::array<Id, n> ids;

  template <class Find>
  const std::array<Id, n>& of(Id wanted, const Find& find) {
    if (simplex != wanted) {
      ids = find(wanted);
      simplex = wanted;
    }
    return ids;
  }
};

/// What one thread has of its own.
struct Reader {
  explicit Reader(BlockStore& store) : store(store) {}
  ~Reader() {
    for (Reading& reading : readings) {
      leave(reading.now);
      leave(reading.next);
    }
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void leave(HeldBlock& block) {
    if (block.slot != nullptr) store.release(*block.slot);
    block = HeldBlock();
  }

  BlockStore& store;
  std::unique_ptr<Consumer> consumers[2];  ///< by source, made when the thread first makes a block of it
  std::array<Reading, relation_count> readings;
  Found<2> edge, star_of_facet;
  Found<3> triangle, triangle_edges;
  Found<6> cell_edges;
  Found<4> cell_triangles;
  Found<5> cell_neighbours;  ///< the last says how many

  std::shared_ptr<StarRows> stars;  ///< made at the first use; shared, as users don't have its header
  BlockBuilder builder;
  StarOrder star;
};

}  // namespace gale::ttk
