#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/relations/faces.hpp>
#include <gale/runtime/make_structure.hpp>

#include "mesh.hpp"

namespace gale::python {

namespace {

/// Neither array is touched before it is written, by all threads.
struct AllRows {
  std::shared_ptr<std::int64_t[]> begin;
  std::shared_ptr<Id[]> entries;
  Id rows = 0, columns = 0;  ///< how many simplices have rows, and may be entries
};

/// How many simplices of a dimension the mesh has. They have been needed.
Id known_simplices(const Mesh& mesh, int dimension) {
  const Id counts[] = {mesh.vertices(), mesh.known_edges(), mesh.known_triangles(), mesh.tetrahedra()};
  return counts[dimension];
}

/// Writes the numbers of a row's entries, ascending. Most come nearly so.
void write_row(const Row& row, const Id* entry_number, Id* to) {
  constexpr Id few = 32;
  Id count = 0;
  for (const Id entry : row) {
    const Id number = entry_number[entry];
    Id at = count++;
    if (count <= few) {
      for (; at > 0 && to[at - 1] > number; --at) to[at] = to[at - 1];
    }
    to[at] = number;
  }
  if (count > few && !std::is_sorted(to, to + count)) std::sort(to, to + count);
}

/// The rows that a consumer met, in the numbers of the input, until it is known where they belong.
class MetRows {
 public:
  /// Takes those of a segment; tells their sizes by number.
  void take(const Rows& rows, const Id* row_number, const Id* entry_number, std::int64_t* sizes) {
    Id* to = room_for(static_cast<std::size_t>(rows.offsets[rows.count] - rows.offsets[0]));
    blocks_.push_back({rows.first, rows.count, to});
    for (Id simplex = rows.first; simplex < rows.first + rows.count; ++simplex) {
      const Row row = rows[simplex];
      sizes[row_number[simplex]] = row.size();
      write_row(row, entry_number, to);
      to += row.size();
    }
  }

  /// Puts them where they belong.
  void put(const Id* row_number, const std::int64_t* begin, Id* entries) const {
    for (const Block& block : blocks_) {
      const Id* from = block.entries;
      for (Id simplex = block.first; simplex < block.first + block.rows; ++simplex) {
        const Id number = row_number[simplex];
        for (std::int64_t at = begin[number]; at < begin[number + 1]; ++at) entries[at] = *from++;
      }
    }
  }

 private:
  struct Block {
    Id first, rows;  ///< GALE's ids
    const Id* entries;
  };

  /// Pieces of some MiB: blocks by themselves would make the heap grow bit by bit.
  Id* room_for(std::size_t count) {
    constexpr std::size_t usual = 1 << 20;
    if (left_ < count) {
      left_ = std::max(usual, count);
      pieces_.emplace_back(new Id[left_]);
      next_ = pieces_.back().get();
    }
    left_ -= count;
    return std::exchange(next_, next_ + count);
  }

  std::vector<Block> blocks_;
  std::vector<std::unique_ptr<Id[]>> pieces_;
  Id* next_ = nullptr;
  std::size_t left_ = 0;
};

/// All rows of faces, which are so many each: where they belong is known.
void write_faces(Structure& structure, Relation relation, const Id* row_number, const Id* entry_number,
                 const SweepOptions& options, AllRows& all) {
  const std::int64_t faces = face_count(relation);
  parallel_for("GALE::row_begin", HostSpace(), all.rows + Offset(1), [&](Offset i) { all.begin[i] = faces * i; });
  all.entries.reset(new Id[all.begin[all.rows]]);
  structure.for_each_segment(relation, options, [&](int, const SegmentRows& rows) {
    for (const Id simplex : rows.interval(relation))
      write_row(rows[relation][simplex], entry_number, all.entries.get() + faces * row_number[simplex]);
  });
}

/// All other rows.
void write_cofaces(Structure& structure, Relation relation, const Id* row_number, const Id* entry_number,
                   const SweepOptions& options, AllRows& all) {
  std::vector<MetRows> met(options.threads);
  structure.for_each_segment(relation, options, [&](int consumer, const SegmentRows& rows) {
    if (rows.interval(relation).size() > 0)
      met[consumer].take(rows[relation], row_number, entry_number, all.begin.get());
  });
  const Array<std::int64_t, HostMemory> begin(all.begin.get(), static_cast<std::size_t>(all.rows) + 1);
  const std::int64_t entries =
      exclusive_scan("GALE::row_begin", HostSpace(), all.rows, begin, [&](Offset i) { return begin(i); });
  all.entries.reset(new Id[entries]);
  in_turns(host_threads(), static_cast<std::int64_t>(met.size()),
           [&](int, std::int64_t consumer) { met[consumer].put(row_number, all.begin.get(), all.entries.get()); });
}

/// All rows by their numbers.
AllRows all_rows(Structure& structure, Relation relation, const Id* row_number, const Id* entry_number,
                 const SweepOptions& options) {
  AllRows all;
  all.rows = known_simplices(structure.mesh(), row_dimension(relation));
  all.columns = known_simplices(structure.mesh(), entry_dimension(relation));
  all.begin.reset(new std::int64_t[static_cast<std::size_t>(all.rows) + 1]);
  const bool faces = row_dimension(relation) > entry_dimension(relation);
  (faces ? write_faces : write_cofaces)(structure, relation, row_number, entry_number, options, all);
  return all;
}

}  // namespace

nb::tuple PyMesh::relation(const std::string& name, int threads, const nb::object& progress) const {
  const SweepOptions options = sweep_options(threads, progress);
  const auto relation = relation_named(name);
  if (!relation) throw Error("there is no relation '" + name + "': it is two of the letters V, E, F, T");
  AllRows rows;
  {
    const Call call;
    const ThreadLimit limit(options.threads);
    const auto structure = make_structure(mesh(), *relation);
    const auto [row_number, entry_number] = numbers(row_dimension(*relation), entry_dimension(*relation));
    rows = all_rows(*structure, *relation, row_number, entry_number, options);
  }
  const auto begins = static_cast<std::size_t>(rows.rows) + 1;
  const auto entries = static_cast<std::size_t>(rows.begin[rows.rows]);
  return nb::make_tuple(numpy_of(rows.begin.get(), begins, 1, rows.begin),
                        numpy_of(rows.entries.get(), entries, 1, rows.entries), rows.columns);
}

}  // namespace gale::python
