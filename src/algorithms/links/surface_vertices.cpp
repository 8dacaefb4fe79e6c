#include <memory>
#include <vector>

#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/links/small_link.hpp>
#include <gale/algorithms/surface_vertices.hpp>
#include <gale/base/parallel.hpp>
#include <gale/runtime/batches/host_worker.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale {

namespace {

/// Finds, for one thread, which vertices are on the surface.
struct SurfaceFinder {
  HostWorker worker;
  detail::LargeLink large;

  explicit SurfaceFinder(const Mesh& mesh) : worker(mesh, Relation::VV | link_form) {}

  bool is_on_surface(Id neighbours, const LinkRow& link) {
    if (neighbours <= detail::SmallLink::capacity) return detail::SmallLink(neighbours, link).is_open();
    large.build(link);
    return large.is_open();
  }
};

}  // namespace

Array<std::uint8_t, HostMemory> surface_vertices(const Mesh& mesh) {
  const auto on_surface = allocate<Array<std::uint8_t, HostMemory>>("GALE::on_surface", mesh.vertices());
  const SweepOptions options;
  std::vector<std::unique_ptr<SurfaceFinder>> finders(options.threads);
  if (mesh.owned_vertices().size() < mesh.vertices())
    fill("GALE::ghosts_on_surface", HostExecutionSpace(), on_surface, std::uint8_t(0));
  detail::sweep(mesh.owned_segments(), options, [&](int consumer, Id segment) {
    auto& finder = finders[consumer];
    if (!finder) finder = std::make_unique<SurfaceFinder>(mesh);
    const SegmentRows rows = finder->worker.compute(segment);
    for (const Id v : rows.interval(Relation::VV)) {
      on_surface(v) = finder->is_on_surface(rows[Relation::VV][v].size(), rows.links()[v]);
    }
  });
  return on_surface;
}

}  // namespace gale
