#include "algorithms/structure_kinds.hpp"

#include <gale/runtime/explicit/explicit_structure.hpp>
#include <gale/runtime/make_structure.hpp>

namespace gale::test {

namespace {

StructureKind runtime_kind(const char* name, Way production) {
  return {name, [production](const Mesh& mesh, RelationSet relations) {
            StructureOptions options;
            options.way = production;
            return make_structure(mesh, relations, options);
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

}  // namespace gale::test
