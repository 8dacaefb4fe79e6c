#include <gtest/gtest.h>

#include <gale/relations/relation.hpp>

namespace gale::test {

TEST(RelationSet, has_its_members_alone) {
  constexpr RelationSet set = Relation::VV | Relation::EV | link_form;
  for (int i = 0; i < relation_count; ++i) {
    const auto relation = static_cast<Relation>(i);
    EXPECT_EQ(set.has(relation), relation == Relation::VV || relation == Relation::EV);
  }
  EXPECT_TRUE(set.has_links());
  EXPECT_FALSE((set - link_form).has_links());
  EXPECT_EQ(set.count(), 3);
  EXPECT_FALSE(set.empty());
  EXPECT_TRUE(RelationSet().empty());
}

TEST(RelationSet, orders_its_members_as_the_enumeration) {
  constexpr RelationSet set = link_form | Relation::VV | Relation::VT;
  EXPECT_EQ(members_of(set), (std::vector<Relation>{Relation::VT, Relation::VV}));
  EXPECT_EQ(set.index_of(Relation::VT), 0);
  EXPECT_EQ(set.index_of(Relation::VV), 1);
  EXPECT_EQ(set.index_of_links(), 2);
}

TEST(RelationSet, contains_subsets) {
  EXPECT_TRUE(star_relations.contains(Relation::VV | Relation::VT));
  EXPECT_TRUE(star_relations.contains(RelationSet()));
  EXPECT_FALSE(star_relations.contains(Relation::VV | Relation::EV));
}

TEST(Relation, has_the_dimensions_that_its_name_says) {
  const std::string letters = "VEFT";
  for (const Relation relation : members_of(all_relations)) {
    const std::string name = name_of(relation);
    EXPECT_EQ(row_dimension(relation), static_cast<int>(letters.find(name[0]))) << name;
    EXPECT_EQ(entry_dimension(relation), static_cast<int>(letters.find(name[1]))) << name;
    EXPECT_EQ(face_relations.has(relation), row_dimension(relation) > entry_dimension(relation)) << name;
    EXPECT_EQ(coboundary_relations.has(relation), row_dimension(relation) < entry_dimension(relation)) << name;
    EXPECT_EQ(adjacency_relations.has(relation), row_dimension(relation) == entry_dimension(relation)) << name;
  }
  EXPECT_EQ(row_dimension(link_form), 0);
}

TEST(RelationNames, are_those_of_the_literature) {
  EXPECT_EQ(name_of(Relation::EV), "EV");
  EXPECT_EQ(name_of(Relation::TT), "TT");
  EXPECT_EQ(name_of(Relation::VT | link_form | Relation::VV), "VT, VV, link");
  EXPECT_EQ(name_of(RelationSet()), "");
}

}  // namespace gale::test
