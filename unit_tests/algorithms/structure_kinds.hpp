#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/runtime/structure.hpp>

#include "support/with_threads.hpp"

namespace gale::test {

/// A structure that algorithms must give the same result on as on any other.
struct StructureKind {
  std::string name;
  std::function<std::unique_ptr<Structure>(const Mesh&, RelationSet)> make;
};

/// The kinds that this build has.
std::vector<StructureKind> structure_kinds();

}  // namespace gale::test
