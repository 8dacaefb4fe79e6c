#include <utility>

#include <gale/app/warm_up.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/make_mesh.hpp>

namespace gale::app {

namespace {

/// Points along an axis: as few as give every kind of critical simplex.
constexpr int points = 12;

void go_through(const std::function<void(const VertexOrder&)>& run) {
  prepare_copies(host_threads());
  const ThreadLimit alone(1);  // the others read
  const io::Dataset data = io::make_grid(points);
  const auto& values = std::get<std::vector<float>>(data.arrays.front().values);
  const Mesh mesh = make_mesh(std::get<io::Dataset::Points<float>>(data.points), data.tetrahedra);
  if (mesh.on_device()) run(VertexOrder(mesh, values.data(), values.size()));
}

}  // namespace

void WarmUp::begin(std::function<void(const VertexOrder&)> run) {
  if (!have_device) return;
  thread_ = detail::start_thread([run = std::move(run)] {
    try {
      go_through(run);
    } catch (...) {
      // The work meets the same, and says it.
    }
  });
}

void WarmUp::wait() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace gale::app
