#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/key_table.hpp>
#include <gale/base/transfer.hpp>

namespace gale::test {

namespace {

/// Inserts each key, and notes where it is and whether it was new.
struct InsertKeys {
  detail::KeyTable table;
  Array<const std::uint64_t, WorkerMemory> keys;
  Array<std::uint64_t, WorkerMemory> places;
  Array<char, WorkerMemory> are_new;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    bool is_new = false;
    places(i) = table.insert(keys(i), is_new);
    are_new(i) = is_new;
  }
};

struct FindKeys {
  detail::KeyTable table;
  Array<const std::uint64_t, WorkerMemory> keys;
  Array<std::uint64_t, WorkerMemory> places;

  KOKKOS_FUNCTION void operator()(Offset i) const { places(i) = table.find(keys(i)); }
};

template <class T>
std::vector<T> here(const Array<T, WorkerMemory>& array) {
  const auto copy = on_host(array);
  return {copy.data(), copy.data() + copy.extent(0)};
}

}  // namespace

TEST(KeyTable, has_each_key_once_at_a_place_of_its_own) {
  const WorkerSpace space;
  std::vector<std::uint64_t> keys;
  for (Id i = 0; i < 20000; ++i) keys.push_back(pair_key(i % 3000, 7 * (i % 3000)));
  const detail::KeyTable table(space, 4096);
  const InsertKeys insert{table, in_memory<WorkerMemory>(keys),
                          allocate<Array<std::uint64_t, WorkerMemory>>("places", keys.size()),
                          allocate<Array<char, WorkerMemory>>("new", keys.size())};
  parallel_for("insert", space, static_cast<Offset>(keys.size()), insert);
  space.fence();
  const auto places = here(insert.places);
  const auto are_new = here(insert.are_new);
  EXPECT_EQ(std::count(are_new.begin(), are_new.end(), 1), 3000);
  std::set<std::uint64_t> different(places.begin(), places.end());
  EXPECT_EQ(different.size(), 3000u);
  EXPECT_LT(*different.rbegin(), 4096u);
  for (std::size_t i = 3000; i < keys.size(); ++i) ASSERT_EQ(places[i], places[i - 3000]) << i;

  std::vector<std::uint64_t> asked(keys.begin(), keys.begin() + 3000);
  for (Id i = 0; i < 3000; ++i) asked.push_back(pair_key(i, 7 * i + 1));
  const FindKeys find{table, in_memory<WorkerMemory>(asked),
                      allocate<Array<std::uint64_t, WorkerMemory>>("places", asked.size())};
  parallel_for("find", space, static_cast<Offset>(asked.size()), find);
  space.fence();
  const auto found = here(find.places);
  for (std::size_t i = 0; i < asked.size(); ++i)
    ASSERT_EQ(found[i], i < 3000 ? places[i] : detail::KeyTable::none) << i;
}

/// Claims places for two keys that are looked for at the same one, after both were seen empty.
struct ClaimTwice {
  detail::KeyTable table;
  std::uint64_t first, second;
  Array<std::uint64_t, WorkerMemory> places;  ///< and whether each was new

  KOKKOS_FUNCTION void operator()(Offset) const {
    std::uint64_t there[] = {table.first_there(first), table.first_there(second)};
    there[0] = table.claim(first, there[0]);
    there[1] = table.claim(second, there[1]);
    bool is_new = false;
    places(0) = table.insert(first, there[0], is_new);
    places(1) = is_new;
    places(2) = table.insert(second, there[1], is_new);
    places(3) = is_new;
  }
};

TEST(KeyTable, gives_places_of_their_own_to_keys_that_claim_the_same) {
  const WorkerSpace space;
  constexpr Offset size = 64;
  const auto place_of = [](std::uint64_t key) { return spread(key) % size; };
  std::uint64_t other = 2;
  while (place_of(other) != place_of(1)) ++other;
  for (const std::uint64_t second : {other, std::uint64_t(1)}) {
    const ClaimTwice claim{detail::KeyTable(space, size), 1, second,
                           allocate<Array<std::uint64_t, WorkerMemory>>("places", 4)};
    parallel_for("claim", space, 1, claim);
    space.fence();
    const auto places = here(claim.places);
    EXPECT_EQ(places[0], place_of(1));
    EXPECT_EQ(places[1], 1u);
    EXPECT_EQ(places[2] == places[0], second == 1);
    EXPECT_EQ(places[3], second == 1 ? 0u : 1u);
  }
}

TEST(KeyTable, without_places_has_no_key) {
  const std::vector<std::uint64_t> asked = {0, 1, pair_key(3, 4)};
  const FindKeys find{
      {}, in_memory<WorkerMemory>(asked), allocate<Array<std::uint64_t, WorkerMemory>>("places", asked.size())};
  parallel_for("find", WorkerSpace(), static_cast<Offset>(asked.size()), find);
  Kokkos::fence();
  for (const std::uint64_t place : here(find.places)) EXPECT_EQ(place, detail::KeyTable::none);
}

/// Sets the ids of keys 3i, and asks for those of all keys.
struct SetIds {
  detail::IdTable table;
  KOKKOS_FUNCTION void operator()(Offset i) const { table.set(3 * std::uint64_t(i), static_cast<Id>(-i)); }
};
struct GetIds {
  detail::IdTable table;
  Array<std::uint64_t, WorkerMemory> found;  ///< the id of each key, or none
  KOKKOS_FUNCTION void operator()(Offset key) const {
    const std::uint64_t place = table.find(static_cast<std::uint64_t>(key));
    found(key) = place == detail::KeyTable::none ? place : static_cast<std::uint64_t>(-table.at(place));
  }
};

TEST(IdTable, has_the_id_of_each_key) {
  const WorkerSpace space;
  for (const Offset keys : {0, 1, 1000}) {
    const detail::IdTable table("test", space, keys);
    parallel_for("set", space, keys, SetIds{table});
    const GetIds get{table, allocate<Array<std::uint64_t, WorkerMemory>>("found", 3 * keys + 3)};
    parallel_for("get", space, 3 * keys + 3, get);
    space.fence();
    const auto found = here(get.found);
    for (std::size_t key = 0; key < found.size(); ++key) {
      const bool is_there = key % 3 == 0 && key / 3 < static_cast<std::size_t>(keys);
      ASSERT_EQ(found[key], is_there ? key / 3 : detail::KeyTable::none) << key;
    }
  }
}

TEST(BitsFor, numbers_below_a_count) {
  EXPECT_EQ(detail::bits_for(1), 1);
  EXPECT_EQ(detail::bits_for(2), 1);
  EXPECT_EQ(detail::bits_for(3), 2);
  EXPECT_EQ(detail::bits_for(4), 2);
  EXPECT_EQ(detail::bits_for(5), 3);
  EXPECT_EQ(detail::bits_for((Offset(1) << 40) + 1), 41);
}

}  // namespace gale::test
