#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <gale/algorithms/excerpt/received_numbers.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/export.hpp>

namespace gale::detail {

/// The whole of a mesh that lies on several ranks, on the first one; an empty mesh on the others. Its input ids ascend
/// with the global ids, and segments are those of the ranks. Cells of a grid with all its cubes aren't gathered: it is
/// a grid there, too.
class GALE_EXPORT WholeMesh {
 public:
  /// Gathers 16 bytes for each vertex that a rank holds, and 24 a cell. Collective. Throws gale::Error on all ranks,
  /// before anything is sent, if that is more than `most_bytes`, or for 0 than the first rank's share of what its
  /// machine has left: `what` it is, and how much.
  explicit WholeMesh(const VertexOrder& order, const char* what, std::size_t most_bytes = 0);

  const Mesh& mesh() const { return order_->mesh(); }

  /// The order of all vertices, which is that of the ranks.
  const VertexOrder& order() const { return *order_; }

  /// What the first rank knows of all vertices, by input id of the whole, for those that this rank holds, by input id
  /// of its part. Collective.
  template <class T>
  std::vector<T> given_back(const std::vector<T>& of_all) const {
    EntriesByRank<T> sent, received;
    std::vector<T> here;
    together(ranks_, [&] {
      sent = {allocate<Array<T, HostMemory>>("GALE::given_back", numbers_->begin().back()), numbers_->begin()};
      parallel_for("GALE::given_back", HostExecutionSpace(), sent.count(),
                   [&](Offset i) { sent.entries(i) = of_all[(*numbers_)[i]]; });
      received = room_by_rank<T>("GALE::brought_back", to_first(part_.vertices()));
      here.resize(part_.vertices());
    });
    exchange(ranks_, sent, received);
    const OtherIds input = part_.vertices_in_input();
    parallel_for("GALE::take_back", HostExecutionSpace(), part_.vertices(),
                 [&](Offset v) { here[input[static_cast<Id>(v)]] = received.entries(v); });
    return here;
  }

 private:
  std::vector<std::int64_t> to_first(std::int64_t count) const {
    std::vector<std::int64_t> counts(ranks_.size(), 0);
    counts[0] = count;
    return counts;
  }

  const Mesh part_;
  const Ranks& ranks_;
  std::optional<ReceivedNumbers<ReceivedVertex>> numbers_;  ///< input ids of the whole, by rank and GALE's id there
  std::optional<VertexOrder> order_;
};

}  // namespace gale::detail
