#include "fuzz/mutate.hpp"

#include "fuzz/gzip.hpp"

namespace gale::fuzz {

Mutation mutated(const std::vector<Case>& seeds, const std::vector<std::string>& names, std::uint64_t number) {
  Random random(number * 0xD1342543DE82EF95ull + 1);
  const std::size_t seed = random.below(seeds.size());
  Mutation mutation{seeds[seed], names[seed]};
  Case& one = mutation.result;
  one.options.simplices_alone = random.one_in(2);
  if (random.one_in(3)) one.options.above = 2;
  if (random.one_in(4)) one.options.time = 1;
  const Case& other = random.one_of(seeds);
  const int count = 1 + static_cast<int>(random.below(random.one_in(3) ? 6 : 2));
  const bool inside = one.extension == ".nii.gz" && !random.one_in(3);
  if (inside) one.content = unzipped(one.content);
  for (int i = 0; i < count; ++i) {
    const bool in_companion = !one.companion.empty() && random.one_in(4);
    std::string& content = in_companion ? one.companion : one.content;
    mutation.story += std::string("; ") + (in_companion ? "companion: " : "") + mutate(content, other.content, random);
  }
  if (inside) one.content = zipped(one.content);
  if (random.one_in(40)) one.extension = other.extension;
  return mutation;
}

}  // namespace gale::fuzz
