#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/runtime/make_structure.hpp>

#include "mesh.hpp"

namespace gale::python {

namespace {

/// The rows that one consumer met, in the numbers of the input.
struct Part {
  std::vector<Id> numbers, sizes, entries;
};

struct Rows {
  std::vector<std::int64_t> begin;
  std::vector<Id> entries;
};

std::vector<Part> sweep(Structure& structure, Relation relation, const SweepOptions& options) {
  const auto rows_of = input_numbers(structure.mesh(), row_dimension(relation));
  const auto entries_of = input_numbers(structure.mesh(), entry_dimension(relation));
  const Id* const row_number = rows_of.data();
  const Id* const entry_number = entries_of.data();
  std::vector<Part> parts(options.threads);
  structure.for_each_segment(relation, options, [&](int consumer, const SegmentRows& rows) {
    Part& part = parts[consumer];
    for (const Id simplex : rows.interval(relation)) {
      const Row row = rows[relation][simplex];
      part.numbers.push_back(row_number[simplex]);
      part.sizes.push_back(row.size());
      const auto first = static_cast<std::ptrdiff_t>(part.entries.size());
      for (const Id entry : row) part.entries.push_back(entry_number[entry]);
      std::sort(part.entries.begin() + first, part.entries.end());
    }
  });
  return parts;
}

/// The rows by their numbers.
Rows gathered(std::vector<Part> parts) {
  std::size_t rows = 0;
  for (const Part& part : parts) rows += part.numbers.size();
  Rows all;
  all.begin.resize(rows + 1);
  for (const Part& part : parts) {
    for (std::size_t i = 0; i < part.numbers.size(); ++i) all.begin[part.numbers[i] + 1] = part.sizes[i];
  }
  for (std::size_t i = 0; i < rows; ++i) all.begin[i + 1] += all.begin[i];
  all.entries.resize(static_cast<std::size_t>(all.begin[rows]));
  in_turns(host_threads(), static_cast<std::int64_t>(parts.size()), [&](int, std::int64_t p) {
    const Part part = std::move(parts[p]);
    const Id* from = part.entries.data();
    for (std::size_t i = 0; i < part.numbers.size(); from += part.sizes[i++])
      std::copy_n(from, part.sizes[i], all.entries.data() + all.begin[part.numbers[i]]);
  });
  return all;
}

}  // namespace

nb::tuple PyMesh::relation(const std::string& name, int threads, const nb::object& progress) const {
  const SweepOptions options = sweep_options(threads, progress);
  const auto relation = relation_named(name);
  if (!relation) throw Error("there is no relation '" + name + "': it is two of the letters V, E, F, T");
  Rows rows;
  {
    const Call call;
    const ThreadLimit limit(options.threads);
    const auto structure = make_structure(mesh(), *relation);
    rows = gathered(sweep(*structure, *relation, options));
  }
  return nb::make_tuple(numpy_of(std::move(rows.begin)), numpy_of(std::move(rows.entries)));
}

}  // namespace gale::python
