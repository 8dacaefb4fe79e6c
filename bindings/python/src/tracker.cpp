#include "tracker.hpp"

#include <cmath>
#include <memory>

#include <gale/base/error.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/persistence.hpp>

#include "job.hpp"

namespace gale::python {

void PyTracker::add(double time, const PyMesh& mesh, Array1 field, const std::string& name,
                    const std::pair<double, bool>& threshold, int threads, const nb::object& progress) {
  if (!std::isfinite(time)) throw Error("a step's time isn't finite");
  if (!following_) throw Error("gale has ended with the interpreter");
  Job job(progress);
  const ComputeOptions options = job.sweep_options(threads);
  job.run([&] {
    const ThreadLimit limit(options.threads);
    const auto dataset = std::make_shared<const io::Dataset>(mesh.with(field_of(field, name)));
    const io::PointArray& values = dataset->arrays.front();
    const double least = outputs::threshold_of({threshold.first, threshold.second}, values);
    const DiscreteGradient gradient = find_discrete_gradient(order_of(mesh.mesh(), values), options);
    following_->tracker.add(
        time, gradient, [dataset](Id v) { return outputs::value_at(dataset->arrays.front(), v); }, least,
        options.threads);
    following_->lines.add(*dataset, values, following_->tracker.tracks());
    return true;
  });
}

nb::tuple PyTracker::found() const {
  if (!following_) throw Error("gale has ended with the interpreter");
  const Tracks& tracks = following_->tracker.tracks();
  return nb::make_tuple(numpy_of(following_->lines.lines(tracks)), numpy_of(outputs::track_table(tracks)));
}

}  // namespace gale::python
