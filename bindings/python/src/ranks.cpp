#include "ranks.hpp"

#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#if defined(GALE_PYTHON_HAS_RANKS)

#include <mpi.h>

#include <optional>

#include <gale/distributed/distributed_mesh.hpp>
#include <gale/outputs/analyses.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/field.hpp>

#include "analyses.hpp"
#include "arrays.hpp"
#include "job.hpp"
#include "process.hpp"

namespace gale::python {

namespace {

/// What an MPI communicator of mpi4py is. Jobs compute on a thread of their own.
Communicator communicator_at(std::uintptr_t address) {
  int is_initialized = 0, level = 0;
  MPI_Initialized(&is_initialized);
  if (is_initialized != 0) MPI_Query_thread(&level);
  if (is_initialized != 0 && level < MPI_THREAD_SERIALIZED)
    throw Error("MPI was initialized for one thread alone: it takes MPI_THREAD_SERIALIZED, or more, as mpi4py has it");
  return Communicator(*reinterpret_cast<const MPI_Comm*>(address));
}

/// One rank's part of a mesh, whose arrays are read where they are.
class PyDistributedMesh : public Kept {
 public:
  PyDistributedMesh(std::uintptr_t comm, Array1 ids, Array1 points, Array1 cells, std::optional<Array1> cell_ids,
                    bool repartition, int capacity)
      : points_(points), cell_ids_(cell_ids), ranks_(communicator_at(comm)), capacity_(capacity) {
    mesh_ = Job().run([&] { return distribute(ids, points, cells, repartition); });
  }

  void end() override {
    mesh_.reset();
    ranks_.reset();
  }

  GlobalId all_vertices() const { return mesh().all_vertices(); }
  GlobalId all_cells() const { return mesh().all_cells(); }
  int dimension() const { return mesh().dimension(); }
  int capacity() const { return capacity_; }
  nb::object vertex_ids() const { return shared(mesh().vertex_ids()); }
  nb::object owners() const { return shared(mesh().owners()); }
  nb::object points() const {
    const auto owner = std::make_shared<const Points<double, HostMemory>>(mesh().points());
    return numpy_of(owner->data(), 3 * owner->extent(0), 3, owner);
  }

  /// Throws what `analyse` would for arguments that are wrong by themselves, on this rank alone: others wait for none
  /// that fails before it sends anything.
  void check(const std::string& analysis, const Array1& values, const std::string& name, const GivenOptions& given,
             int threads, const nb::object& progress, const std::optional<Array1>& order) const {
    mesh();
    outputs::analysis_named(analysis);
    field_of(values, name);
    if (order) field_of(*order, name, "the order");
    settings_of(given);
    Job(progress).sweep_options(threads);
  }

  nb::dict analyse(const std::string& analysis, Array1 values, const std::string& name, const GivenOptions& given,
                   int threads, const nb::object& progress, const std::optional<Array1>& order) const {
    Job job(progress);
    const ComputeOptions options = job.sweep_options(threads);
    const outputs::Settings settings = settings_of(given);
    if (analysis == "persistence-diagram") return diagram(job, values, name, order, settings, options);
    std::string note;
    auto found = job.run([&] {
      const ThreadLimit limit(options.threads);
      const Held held = bring(values, name, order);
      note = held.note;
      return outputs::analysis_named(analysis).run({held.dataset, held.dataset.arrays.front(), *held.order,
                                                    [&](const char*, double, double) { return options; }},
                                                   settings);
    });
    return results_of(std::move(found), note);
  }

 private:
  /// Points and field of the vertices that this rank holds, and the order of these.
  struct Held {
    io::Dataset dataset;
    std::optional<VertexOrder> order;
    std::string note;  ///< on the first rank: of an order that contradicts the field
  };

  const DistributedMesh& mesh() const {
    if (!mesh_) throw Error("gale has ended with the interpreter");
    return *mesh_;
  }

  template <class T>
  static nb::object shared(const Array<const T, HostMemory>& values) {
    const auto owner = std::make_shared<const Array<const T, HostMemory>>(values);
    return numpy_of(owner->data(), owner->extent(0), 1, owner);
  }

  DistributedMesh distribute(const Array1& ids, const Array1& points, const Array1& cells, bool repartition) const {
    PartitionOptions options;
    options.repartition = repartition;
    options.capacity = capacity_;
    std::optional<MeshPart<std::int64_t>> part;
    detail::together(*ranks_, [&] {
      require_rows(points, 3, "points");
      const bool are_triangles = cells.ndim() == 2 && cells.shape(1) == 3;
      if (!are_triangles) require_rows(cells, 4, "cells");
      if (!is<std::int64_t>(ids) || ids.ndim() != 1) throw Error("ids are not int64 of one dimension");
      if (cell_ids_ && (!is<std::int64_t>(*cell_ids_) || cell_ids_->ndim() != 1))
        throw Error("cell ids are not int64 of one dimension");
      if (!is<std::int64_t>(cells)) throw Error("cells are not int64");
      if (!is<float>(points) && !is<double>(points)) throw Error("points are neither float32 nor float64");
      with_view<const std::int64_t*>(ids, "ids", [&](const auto& id_view) {
        const auto with_points = [&](const auto& point_view) {
          const auto take = [&](const auto& cell_view) {
            if (!cell_ids_) {
              part = make_part(id_view, point_view, cell_view);
              return;
            }
            with_view<const std::int64_t*>(*cell_ids_, "cell ids", [&](const auto& cell_id_view) {
              part = make_part(id_view, point_view, cell_view, cell_id_view);
            });
          };
          are_triangles ? with_view<const std::int64_t* [3]>(cells, "cells", take)
                        : with_view<const std::int64_t* [4]>(cells, "cells", take);
        };
        is<float>(points) ? with_view<const float* [3]>(points, "points", with_points)
                          : with_view<const double* [3]>(points, "points", with_points);
      });
    });
    return DistributedMesh(*ranks_, *part, options);
  }

  /// What a caller has for each vertex that it handed over. Collective.
  io::PointArray given_to_all(const Array1& values, const std::string& name, const char* what) const {
    io::PointArray given;
    detail::together(*ranks_, [&] { given = field_of(values, name, what); });
    const auto type = static_cast<std::int64_t>(given.values.index());
    if (ranks_->least(type) != -ranks_->least(-type))
      throw SharedError(std::string(what) + " has values of another type on other ranks");
    return given;
  }

  /// Collective.
  Held bring(const Array1& values, const std::string& name, const std::optional<Array1>& order) const {
    const io::PointArray given = given_to_all(values, name, "the field");
    Held held;
    if (!order) {
      held.order = order_of(mesh(), given);
    } else {
      const io::PointArray places = given_to_all(*order, name + "_Order", "the order");
      held.order = order_of(mesh(), places);
      held.note = outputs::note_of_order(mesh(), held_of(places), held_of(given));
      if (ranks_->rank() != 0) held.note.clear();
    }
    detail::together(*ranks_, [&] {
      const auto& points = mesh().points();
      held.dataset.points = detail::tabulated_rows<double, 3>("GALE::held_points", points.extent(0),
                                                              [&](Offset i, int axis) { return points(i, axis); });
    });
    held.dataset.arrays.push_back(held_of(given));
    return held;
  }

  /// An array that was handed over, at all vertices that this rank holds. Collective.
  io::PointArray held_of(const io::PointArray& given) const {
    return outputs::detail::brought(mesh().exchange().from_givers(), *ranks_, given, mesh().vertices());
  }

  /// The diagram on the first rank, with global ids; nothing of it on the others.
  nb::dict diagram(Job& job, const Array1& values, const std::string& name, const std::optional<Array1>& order,
                   const outputs::Settings& settings, const ComputeOptions& options) const {
    std::vector<GlobalId> births, deaths;
    std::string note;
    auto found = job.run([&] {
      const ThreadLimit limit(options.threads);
      const Held held = bring(values, name, order);
      note = held.note;
      const io::PointArray& field = held.dataset.arrays.front();
      const auto threshold = settings.thresholds.find("persistence");
      const double least =
          threshold == settings.thresholds.end() ? 0 : outputs::threshold_of(threshold->second, field, *ranks_);
      SweepOptions sweep;
      sweep.threads = options.threads;
      const GatheredPairs gathered = gather_persistence_pairs(find_discrete_gradient(*held.order, options), sweep);
      const outputs::AtExcerpt at(gathered.mesh, mesh(), held.dataset, field, true);
      std::vector<outputs::DiagramPoint> points;
      detail::together(*ranks_, [&] {
        points = outputs::persistence_diagram(gathered.highest, gathered.pairs, at.field(), least);
        for (const outputs::DiagramPoint& point : points) {
          births.push_back(gathered.mesh.vertex_id(point.begin));
          deaths.push_back(gathered.mesh.vertex_id(point.end));
        }
      });
      return points;
    });
    nb::dict columns = numpy_of(found);
    columns["birth_vertex"] = numpy_of(std::move(births));
    columns["death_vertex"] = numpy_of(std::move(deaths));
    nb::dict results;
    results["diagram"] = columns;
    results["note"] = text_of(note);
    return results;
  }

  const Array1 points_;  ///< which the mesh reads, and ids of cells
  const std::optional<Array1> cell_ids_;
  std::optional<Communicator> ranks_;
  const int capacity_;
  std::optional<DistributedMesh> mesh_;
};

}  // namespace

void add_ranks(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<PyDistributedMesh>(module, "DistributedMesh")
      .def(nb::init<std::uintptr_t, Array1, Array1, Array1, std::optional<Array1>, bool, int>(), "comm"_a, "ids"_a,
           "points"_a, "cells"_a, "cell_ids"_a.none(), "repartition"_a, "capacity"_a)
      .def_prop_ro("vertices", &PyDistributedMesh::all_vertices)
      .def_prop_ro("cells", &PyDistributedMesh::all_cells)
      .def_prop_ro("dimension", &PyDistributedMesh::dimension)
      .def_prop_ro("capacity", &PyDistributedMesh::capacity)
      .def_prop_ro("vertex_ids", &PyDistributedMesh::vertex_ids)
      .def_prop_ro("owners", &PyDistributedMesh::owners)
      .def("points", &PyDistributedMesh::points)
      .def("check", &PyDistributedMesh::check, "analysis"_a, "field"_a, "name"_a, "given"_a, "threads"_a,
           "progress"_a.none(), "order"_a.none())
      .def_static(
          "check_part", [](const Array1&, const Array1&, const Array1&, const std::optional<Array1>&, bool, int) {},
          "ids"_a, "points"_a, "cells"_a, "cell_ids"_a.none(), "repartition"_a, "capacity"_a)
      .def("analyse", &PyDistributedMesh::analyse, "analysis"_a, "field"_a, "name"_a, "given"_a, "threads"_a,
           "progress"_a.none(), "order"_a.none());
}

}  // namespace gale::python

#else

namespace gale::python {

void add_ranks(nanobind::module_&) {}

}  // namespace gale::python

#endif
