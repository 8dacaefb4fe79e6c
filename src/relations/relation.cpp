#include <gale/relations/relation.hpp>

namespace gale {

std::string name_of(Relation relation) {
  static const char* const names[relation_count] = {"EV", "FV", "FE", "TV", "TE", "TF", "VE", "VF",  "VT",
                                                    "EF", "ET", "FT", "VV", "EE", "FF", "TT", "link"};
  return names[static_cast<int>(relation)];
}

std::optional<Relation> relation_named(const std::string& name) {
  for (const Relation relation : members_of(all_relations)) {
    if (name_of(relation) == name) return relation;
  }
  return std::nullopt;
}

std::vector<Relation> members_of(RelationSet relations) {
  std::vector<Relation> members;
  for (int i = 0; i < relation_count; ++i) {
    if (relations.has(static_cast<Relation>(i))) members.push_back(static_cast<Relation>(i));
  }
  return members;
}

std::string name_of(RelationSet relations) {
  std::string names;
  for (const Relation relation : members_of(relations)) names += (names.empty() ? "" : ", ") + name_of(relation);
  return names;
}

}  // namespace gale
