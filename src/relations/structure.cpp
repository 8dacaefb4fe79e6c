#include <gale/relations/structure.hpp>

#include <gale/base/error.hpp>

namespace gale {

void require_preconditioned(const Structure& structure, RelationSet wanted) {
  const RelationSet have = structure.relations();
  if (have.contains(wanted)) return;
  throw Error("the structure was preconditioned for " + (have.empty() ? std::string("no relation") : name_of(have)) + ", not for " +
              name_of(wanted) + ": name every relation that you read when you construct it");
}

}  // namespace gale
