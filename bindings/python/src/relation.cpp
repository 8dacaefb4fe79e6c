#include <gale/base/error.hpp>
#include <gale/runtime/relation_of.hpp>

#include "job.hpp"
#include "mesh.hpp"

namespace gale::python {

namespace {

/// A relation that numpy's arrays show. These may outlive Kokkos, which lets nobody free its memory then: what is there
/// when it ends stays.
class KeptRelation : public Kept {
 public:
  explicit KeptRelation(const Csr<const Id, HostMemory>& rows) : rows_(new Csr<const Id, HostMemory>(rows)) {}

  void end() override { rows_.release(); }

  const Csr<const Id, HostMemory>& rows() const { return *rows_; }

 private:
  std::unique_ptr<const Csr<const Id, HostMemory>> rows_;
};

}  // namespace

nb::tuple PyMesh::relation(const std::string& name, int threads, const nb::object& progress) const {
  Job job(progress);
  const SweepOptions options = job.sweep_options(threads);
  const auto relation = relation_named(name);
  if (!relation) throw Error("there is no relation '" + name + "': it is two of the letters V, E, F, T");
  Id columns = 0;
  const auto kept = job.run([&] {
    const auto made = std::make_shared<KeptRelation>(relation_of(mesh(), *relation, Ids::input, options));
    columns = mesh().interval_begin(entry_dimension(*relation))(mesh().segments());
    return made;
  });
  const auto& rows = kept->rows();
  return nb::make_tuple(numpy_of(rows.offsets.data(), rows.offsets.extent(0), 1, kept),
                        numpy_of(rows.entries.data(), rows.entries.extent(0), 1, kept), columns);
}

}  // namespace gale::python
