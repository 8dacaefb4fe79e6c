#include <gale/relations/relation.hpp>

namespace gale {

std::string name_of(Relation relation) { return traits_of(relation).name; }

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
  const auto add = [&names](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const Relation relation : members_of(relations)) add(name_of(relation));
  if (relations.has_links()) add("link");
  return names;
}

}  // namespace gale
