#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// What a block begins with; a message that fits into the block follows.
struct BlockHead {
  std::int64_t bytes;     ///< of the message to this rank
  std::int64_t greatest;  ///< bytes of all messages of the rank that sends it; below 0 where it has failed
};

/// How many bytes a block has: less where there are many ranks.
std::int64_t block_size(int ranks) { return std::clamp<std::int64_t>(65536 / ranks, 64, 1024); }

}  // namespace

ReceivedBytes exchange_pieces(const Ranks& ranks, const char* label,
                              const std::function<std::vector<PackedPieces>()>& pack) {
  if (ranks.is_alone()) {
    pack();  // nothing: its own stay
    return {{}, {0}, {0}};
  }
  const int size = ranks.size();
  const std::int64_t block = block_size(size), head = sizeof(BlockHead);
  std::vector<PackedPieces> pieces;
  std::vector<std::int64_t> counts;
  std::vector<char> sent(size * block, 0);
  const Outcome outcome = tried([&] {
    pieces = pack();
    for (int rank = 0; rank < size; ++rank) {
      counts.push_back(bytes_of(pieces[rank]));
      if (counts[rank] > 0 && counts[rank] <= block - head) write_pieces(pieces[rank], &sent[rank * block + head]);
    }
  });
  const std::int64_t greatest = outcome.has_failed ? -1 : *std::max_element(counts.begin(), counts.end());
  for (int rank = 0; rank < size; ++rank) {
    const BlockHead mine{outcome.has_failed ? 0 : counts[rank], greatest};
    std::memcpy(&sent[rank * block], &mine, sizeof(mine));
  }
  const auto blocks = allocate<Array<char, HostMemory>>(label, size * block);
  ranks.exchange_blocks(sent.data(), blocks.data(), block);

  ReceivedBytes received{blocks, {}, {}};
  bool has_one_failed = false;
  for (int rank = 0; rank < size; ++rank) {
    BlockHead theirs;
    std::memcpy(&theirs, blocks.data() + rank * block, sizeof(theirs));
    received.begin.push_back(rank * block + head);
    received.counts.push_back(theirs.bytes);
    received.greatest = std::max(received.greatest, theirs.greatest);
    has_one_failed = has_one_failed || theirs.greatest < 0;
  }
  if (has_one_failed) fail_together(ranks, outcome);
  if (received.greatest <= block - head) {
    ranks.note_sent(std::count_if(counts.begin(), counts.end(), [](std::int64_t count) { return count > 0; }),
                    std::accumulate(counts.begin(), counts.end(), std::int64_t(0)));
    return received;
  }

  EntriesByRank<char> packed, there;
  together(ranks, [&] {
    packed = room_by_rank<char>(label, counts);
    for (int rank = 0; rank < size; ++rank) write_pieces(pieces[rank], packed.entries.data() + packed.begin[rank]);
    pieces.clear();
    there = room_to_receive<char>(label, received.counts);
  });
  exchange(ranks, packed, there);
  received.bytes = there.entries;
  received.begin.assign(there.begin.begin(), there.begin.end() - 1);
  return received;
}

}  // namespace gale::detail
