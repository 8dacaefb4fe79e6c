#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <string_view>

#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/base/error.hpp>

namespace gale::detail {

namespace {

/// What memory the machine has left, in bytes; as much as there can be where the system doesn't say.
std::size_t available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    std::size_t kib = 0;
    if (word == "MemAvailable:" && file >> kib) return kib * 1024;
  }
  return std::numeric_limits<std::size_t>::max();
}

/// How many ranks are on this one's machine.
std::int64_t ranks_of_machine(const Ranks& ranks) {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  const auto mine = static_cast<std::int64_t>(std::hash<std::string_view>()(name) >> 1);
  const std::vector<std::int64_t> all = ranks.all(mine);
  return std::count(all.begin(), all.end(), mine);
}

}  // namespace

void require_room(const Ranks& ranks, const char* what, const std::vector<std::int64_t>& bytes, std::size_t most) {
  constexpr std::size_t copies = 6;  // of what comes, until it is in order
  const auto counts = ranks.exchange_counts(bytes);
  const auto share = static_cast<std::size_t>(ranks_of_machine(ranks));
  together(ranks, [&] {
    const auto incoming = static_cast<std::size_t>(std::accumulate(counts.begin(), counts.end(), std::int64_t(0)));
    const std::size_t room = most == 0 ? available_memory() / share / copies : most;
    if (incoming <= room) return ranks.note_gathered(static_cast<std::int64_t>(incoming));
    throw Error(std::string(what) + " would take " + grouped(static_cast<std::int64_t>(incoming)) +
                " bytes here, and there is room for " + grouped(static_cast<std::int64_t>(room)));
  });
}

}  // namespace gale::detail
