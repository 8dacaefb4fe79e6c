#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/runtime/make_structure.hpp>

#include "mesh.hpp"

namespace gale::python {

namespace {

/// A segment's rows in the numbers of the input: first their sizes, then their entries.
struct Block {
  Id first, rows;  ///< GALE's ids
  std::unique_ptr<Id[]> words;
};

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

/// The block of what a sweep gives of a segment.
Block block_of(const Rows& rows, const Id* entry_number) {
  const Id count = rows.count, begin = rows.offsets[0];
  Block block{rows.first, count, std::unique_ptr<Id[]>(new Id[count + std::size_t(rows.offsets[count] - begin)])};
  Id* to = block.words.get() + count;
  for (Id i = 0; i < count; ++i) {
    const Row row = rows[rows.first + i];
    block.words[i] = row.size();
    Id* const first = to;
    for (const Id entry : row) *to++ = entry_number[entry];
    if (!std::is_sorted(first, to)) std::sort(first, to);
  }
  return block;
}

/// All blocks, by the consumer that met them.
std::vector<std::vector<Block>> sweep(Structure& structure, Relation relation, const Id* entry_number,
                                      const SweepOptions& options) {
  std::vector<std::vector<Block>> parts(options.threads);
  structure.for_each_segment(relation, options, [&](int consumer, const SegmentRows& rows) {
    if (rows.interval(relation).size() > 0) parts[consumer].push_back(block_of(rows[relation], entry_number));
  });
  return parts;
}

/// Calls visit(block) for each, on as many threads as there are parts.
template <class Visit>
void for_each_block(const std::vector<std::vector<Block>>& parts, const Visit& visit) {
  in_turns(host_threads(), static_cast<std::int64_t>(parts.size()), [&](int, std::int64_t p) {
    for (const Block& block : parts[p]) visit(block);
  });
}

/// The rows by their numbers.
AllRows gathered(const Mesh& mesh, Relation relation, const Id* row_number,
                 const std::vector<std::vector<Block>>& parts) {
  const Id rows = known_simplices(mesh, row_dimension(relation));
  AllRows all;
  all.begin.reset(new std::int64_t[static_cast<std::size_t>(rows) + 1]);
  const Array<std::int64_t, HostMemory> begin(all.begin.get(), static_cast<std::size_t>(rows) + 1);
  for_each_block(parts, [&](const Block& block) {
    for (Id i = 0; i < block.rows; ++i) begin(row_number[block.first + i]) = block.words[i];
  });
  const std::int64_t entries =
      exclusive_scan("GALE::row_begin", HostSpace(), rows, begin, [&](Offset i) { return begin(i); });
  all.entries.reset(new Id[entries]);
  for_each_block(parts, [&](const Block& block) {
    const Id* from = block.words.get() + block.rows;
    for (Id i = 0; i < block.rows; from += block.words[i++])
      std::copy_n(from, block.words[i], all.entries.get() + begin(row_number[block.first + i]));
  });
  all.rows = rows;
  all.columns = known_simplices(mesh, entry_dimension(relation));
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
    const auto parts = sweep(*structure, *relation, numbers(entry_dimension(*relation)), options);
    rows = gathered(mesh(), *relation, numbers(row_dimension(*relation)), parts);
  }
  const auto begins = static_cast<std::size_t>(rows.rows) + 1;
  const auto entries = static_cast<std::size_t>(rows.begin[rows.rows]);
  return nb::make_tuple(numpy_of(rows.begin.get(), begins, 1, rows.begin),
                        numpy_of(rows.entries.get(), entries, 1, rows.entries), rows.columns);
}

}  // namespace gale::python
