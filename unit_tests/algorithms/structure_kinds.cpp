#include "algorithms/structure_kinds.hpp"

#include <gale/runtime/explicit/explicit_structure.hpp>
#include <gale/runtime/runtime.hpp>

namespace gale::test {

namespace {

StructureKind runtime_kind(const char* name, Way production) {
  return {name, [production](const Mesh& mesh, RelationSet relations) {
            RuntimeOptions options;
            options.way = production;
            return std::make_unique<Runtime>(mesh, relations, options);
          }};
}

}  // namespace

std::vector<StructureKind> structure_kinds() {
  std::vector<StructureKind> kinds = {runtime_kind("consumers", Way::inline_), runtime_kind("leaders", Way::leaders)};
#if defined(GALE_ENABLE_KOKKOS_KERNELS)
  kinds.push_back({"explicit", [](const Mesh& mesh, RelationSet relations) {
                     return std::make_unique<ExplicitStructure>(mesh, relations);
                   }});
#endif
  return kinds;
}

SweepOptions with_threads(int threads) {
  SweepOptions options;
  options.threads = threads;
  return options;
}

}  // namespace gale::test
