#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/mesh/ranks.hpp>

namespace gale {

/// The ranks of an MPI communicator, of which this is a duplicate of GALE's own, so that its messages meet no others.
/// Copies share it. It must go before MPI_Finalize is called, on one thread; so must all that was made with it. What is
/// collective is called on the thread that MPI was initialized on (MPI_THREAD_FUNNELED or more).
class GALE_EXPORT Communicator final : public Ranks {
 public:
  /// MPI counts bytes by an int.
  static constexpr std::size_t most_bytes_a_message = std::size_t(1) << 30;

  /// Duplicates `comm`. Messages of more than `largest_message` bytes are cut. Throws gale::Error if MPI is not
  /// initialized, and for a limit below 1 byte or above most_bytes_a_message.
  explicit Communicator(MPI_Comm comm, std::size_t largest_message = most_bytes_a_message);

  using Ranks::sum;
  int rank() const override;
  int size() const override;
  void sum(std::int64_t* values, int count) const override;
  std::int64_t least(std::int64_t value) const override;
  double least(double value) const override;
  std::vector<std::int64_t> all(std::int64_t value) const override;
  std::int64_t sum_before(std::int64_t value) const override;
  std::string broadcast(const std::string& text, int from) const override;
  std::vector<std::int64_t> exchange_counts(const std::vector<std::int64_t>& counts) const override;
  void exchange_bytes(const char* from, const std::vector<std::int64_t>& send_begin, char* to,
                      const std::vector<std::int64_t>& receive_begin) const override;
  void exchange_blocks(const char* from, char* to, std::int64_t size) const override;
  const SentMessages& sent() const override;
  void note_gathered(std::int64_t bytes) const override;
  void note_sent(std::int64_t messages, std::int64_t bytes) const override;

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

}  // namespace gale
