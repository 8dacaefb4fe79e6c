#pragma once

#include <array>
#include <memory>

#include <gale/mesh/intervals.hpp>
#include <gale/runtime/consumer.hpp>
#include <gale/ttk/star_rows.hpp>
#include <gale/ttk/translation.hpp>

namespace gale::ttk {

/// Where a thread reads one relation.
struct Reading {
  Id simplex = no_id;  ///< TTK's id of what was asked for last, and its row
  Row row;
  Interval held;  ///< the simplices (GALE's ids) of the block that the thread holds, and their rows
  Rows rows;
  BlockStore::Slot* slot = nullptr;
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
    for (Reading& reading : readings) leave(reading);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void leave(Reading& reading) {
    if (reading.slot != nullptr) store.release(*reading.slot);
    reading = Reading();
  }

  BlockStore& store;
  std::unique_ptr<Consumer> consumers[2];  ///< by source, made when the thread first makes a block of it
  std::array<Reading, relation_count> readings;
  Found<2> edge, star_of_triangle;
  Found<3> triangle, triangle_edges;
  Found<6> cell_edges;
  Found<4> cell_triangles;
  Found<5> cell_neighbours;  ///< the last says how many

  std::unique_ptr<StarRows> stars;  ///< likewise
  BlockBuilder builder;
  StarOrder star;
};

}  // namespace gale::ttk
