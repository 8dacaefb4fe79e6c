#pragma once

#include <gale/relations/relation.hpp>

namespace gale::test {

/// What a star kernel may be asked for.
inline constexpr RelationSet star_subsets[] = {
    Relation::VV,
    Relation::VT,
    Relation::link,
    Relation::VV | Relation::VT,
    Relation::VV | Relation::link,
    Relation::VT | Relation::link,
    star_relations,
};

}  // namespace gale::test
