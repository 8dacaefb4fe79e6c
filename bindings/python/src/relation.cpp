#include <gale/base/error.hpp>
#include <gale/runtime/make_structure.hpp>

#include "mesh.hpp"
#include "whole_relation.hpp"

namespace gale::python {

nb::tuple PyMesh::relation(const std::string& name, int threads, const nb::object& progress) const {
  const SweepOptions options = sweep_options(threads, progress);
  const auto relation = relation_named(name);
  if (!relation) throw Error("there is no relation '" + name + "': it is two of the letters V, E, F, T");
  WholeRelation rows;
  {
    const Call call;
    const ThreadLimit limit(options.threads);
    const auto structure = make_structure(mesh(), *relation);
    const auto [row_number, entry_number] = numbers(row_dimension(*relation), entry_dimension(*relation));
    rows = whole_relation(*structure, *relation, row_number, entry_number, options);
  }
  const auto begins = static_cast<std::size_t>(rows.rows) + 1;
  const auto entries = static_cast<std::size_t>(rows.begin[rows.rows]);
  return nb::make_tuple(numpy_of(rows.begin.get(), begins, 1, rows.begin),
                        numpy_of(rows.entries.get(), entries, 1, rows.entries), rows.columns);
}

}  // namespace gale::python
