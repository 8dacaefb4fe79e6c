// The star kernels over a whole mesh, by threads per segment: their time beside that of copying what they make to the
// host.
//   usage: star_rates [N [CAPACITY]]

#include <cstdio>
#include <cstdlib>

#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/relations/kernels/star_kernel.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"

namespace {

using namespace gale;

Array<Id, WorkerMemory> all_segments(const Mesh& mesh) {
  const Array<Id, WorkerMemory> segments("segments", mesh.segments());
  parallel_for(
      "GALE::all_segments", WorkerSpace(), mesh.segments(),
      KOKKOS_LAMBDA(Offset s) { segments(s) = static_cast<Id>(s); });
  return segments;
}

/// Everything that one launch for all segments needs.
struct WholeMesh {
  Array<Id, WorkerMemory> segments, words;
  Array<Offset, WorkerMemory> directory, used;
  Array<StarSizes, WorkerMemory> needed;
  StarKernel<WorkerMemory, 4> kernel;

  WholeMesh(const Mesh& mesh, RelationSet wanted)
      : segments(all_segments(mesh)),
        words(allocate<Array<Id, WorkerMemory>>("words", words_for(mesh, wanted))),
        directory("directory", Offset(mesh.segments()) * wanted.count()),
        used("used", 1),
        needed("needed", 1) {
    kernel.mesh = mesh.encoded<WorkerMemory>();
    kernel.segments = segments.data();
    kernel.wanted = wanted;
    kernel.sizes = sizes_for(mesh, wanted);
    kernel.pool = {words.data(), static_cast<Offset>(words.extent(0)), used.data(), directory.data(), needed.data()};
  }

  /// Room for 20 neighbours and 30 tetrahedra a vertex.
  static Offset words_for(const Mesh& mesh, RelationSet wanted) {
    Offset words = 4096;
    if (wanted.has(Relation::VV)) words += Offset(22) * mesh.vertices();
    if (wanted.has(Relation::VT)) words += Offset(32) * mesh.vertices();
    if (wanted.has_links()) words += Offset(26) * mesh.vertices();
    return words;
  }

  static StarSizes sizes_for(const Mesh& mesh, RelationSet wanted) {
    const auto tetrahedra = on_host(mesh.encoded<WorkerMemory>().internal_begin);
    const auto external = on_host(mesh.encoded<WorkerMemory>().external_begin);
    StarSizes sizes;
    for (Id s = 0; s < mesh.segments(); ++s) {
      const Id rows = mesh.vertex_begin()(s + 1) - mesh.vertex_begin()(s);
      sizes = larger(sizes, StarKernel<WorkerMemory, 4>::bound(rows, tetrahedra(s + 1) - tetrahedra(s),
                                                               external(s + 1) - external(s), wanted));
    }
    return sizes;
  }

  void run(int warps) const {
    Kokkos::deep_copy(used, 0);
    launch(WorkerSpace(), kernel, static_cast<int>(segments.extent(0)), warps);
    WorkerSpace().fence();
  }
};

void measure(const Mesh& mesh, RelationSet wanted, double link) {
  const WholeMesh whole(mesh, wanted);
  for (const int warps : {1, 2, 4, 8, 16}) {
    if (!have_device && warps > 1) break;
    if (scratch_bytes<StarKernel<WorkerMemory, 4>>(whole.kernel.sizes, warps) > fast_scratch_bytes<WorkerSpace>()) {
      std::printf("%-14s %4d threads a segment: its scratch memory of %zu bytes isn't there\n", name_of(wanted).c_str(),
                  32 * warps, scratch_bytes<StarKernel<WorkerMemory, 4>>(whole.kernel.sizes, warps));
      continue;
    }
    const double seconds = perf::median_seconds_of(5, [&] { whole.run(warps); });
    const double bytes = 4.0 * on_host(whole.used)(0);
    std::printf("%-14s %4d threads a segment: %7.2f ms, %.2f GB, whose copy takes %.2f ms; %.1f M segments/s\n",
                name_of(wanted).c_str(), 32 * warps, 1e3 * seconds, bytes / 1e9, 1e3 * bytes / link,
                mesh.segments() / seconds / 1e6);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  const Mesh mesh = perf::encode(io::make_grid(n), argc > 2 ? std::atoi(argv[2]) : default_capacity);
  const double link = perf::link_bandwidth(std::size_t(16) << 20);
  std::printf("%s, grid:%d, %d segments\n", perf::context().c_str(), n, mesh.segments());
  for (const RelationSet wanted : {RelationSet(Relation::VT), RelationSet(Relation::VV), Relation::VV | link_form,
                                   Relation::VV | Relation::VT, star_relations}) {
    measure(mesh, wanted, link);
  }
}
