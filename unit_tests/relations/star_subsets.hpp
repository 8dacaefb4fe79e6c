#pragma once

#include <gale/relations/relation.hpp>

namespace gale::test {

/// What a star kernel may be asked for.
inline constexpr RelationSet star_subsets[] = {
    Relation::VV,
    Relation::VT,
    link_form,
    Relation::VV | Relation::VT,
    Relation::VV | link_form,
    Relation::VT | link_form,
    star_relations,
};

}  // namespace gale::test
