#include <gale/base/error.hpp>

#include "../job.hpp"
#include "../mesh.hpp"
#include "whole_relation.hpp"

namespace gale::python {

nb::tuple PyMesh::relation(const std::string& name, int threads, const nb::object& progress) const {
  Job job(progress);
  const SweepOptions options = job.sweep_options(threads);
  const auto relation = relation_named(name);
  if (!relation) throw Error("there is no relation '" + name + "': it is two of the letters V, E, F, T");
  const WholeRelation rows = job.run([&] {
    const ThreadLimit limit(options.threads);
    const auto numbers_of = [this](Relation one) {
      const auto [of_rows, of_entries] = numbers(row_dimension(one), entry_dimension(one));
      return Numbers{of_rows, of_entries};
    };
    return whole_relation(mesh(), *relation, numbers_of, options);
  });
  const auto begins = static_cast<std::size_t>(rows.rows) + 1;
  const auto entries = static_cast<std::size_t>(rows.begin[rows.rows]);
  return nb::make_tuple(numpy_of(rows.begin.get(), begins, 1, rows.begin),
                        numpy_of(rows.entries.get(), entries, 1, rows.entries), rows.columns);
}

}  // namespace gale::python
