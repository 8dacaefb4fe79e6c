#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/export.hpp>

namespace gale {

/// An error that all ranks throw alike, so that each may end in its own time. Others leave the other ranks waiting:
/// then the application has to end them (MPI_Abort).
class GALE_EXPORT SharedError : public Error {
 public:
  using Error::Error;
};

/// What one rank has sent to others, and how long it has waited.
struct SentMessages {
  std::int64_t messages = 0;   ///< to other ranks
  std::int64_t bytes = 0;      ///< all of these together
  double seconds_waiting = 0;  ///< for messages, of itself and of others, from when it had nothing else to do
};

/// The ranks that a mesh lies on: an MPI communicator of GALE's own, so that its messages meet no others. Copies share
/// it. It must go before MPI_Finalize is called, on one thread; so must all that was made with it.
///
/// All functions but rank(), size() and sent() are collective: every rank calls them, in the same order, on the thread
/// that MPI was initialized on (MPI_THREAD_FUNNELED or more).
class GALE_EXPORT Communicator {
 public:
  /// MPI counts bytes by an int.
  static constexpr std::size_t most_bytes_a_message = std::size_t(1) << 30;

  /// Duplicates `comm`. Messages of more than `largest_message` bytes are cut. Throws gale::Error if MPI is not
  /// initialized, and for a limit below 1 byte or above most_bytes_a_message.
  explicit Communicator(MPI_Comm comm, std::size_t largest_message = most_bytes_a_message);

  /// This rank's number, from 0.
  int rank() const;

  /// How many ranks there are.
  int size() const;

  /// The sum of all ranks' values, on each rank.
  std::int64_t sum(std::int64_t value) const;
  void sum(std::int64_t* values, int count) const;  ///< each of several, in place

  /// The least of all ranks' values, on each rank.
  std::int64_t least(std::int64_t value) const;
  double least(double value) const;  ///< the least of real numbers

  /// All ranks' values, by rank, on each rank.
  std::vector<std::int64_t> all(std::int64_t value) const;

  /// The sum of the values of all ranks before this one.
  std::int64_t sum_before(std::int64_t value) const;

  /// A string of one rank, on each rank.
  std::string broadcast(const std::string& text, int from) const;

  /// Sends counts[r] to each rank r, and returns what each has sent here.
  std::vector<std::int64_t> exchange_counts(const std::vector<std::int64_t>& counts) const;

  /// Sends the bytes [send_begin[r], send_begin[r + 1]) of `from` to each rank r, and receives [receive_begin[r],
  /// receive_begin[r + 1]) of `to` from it: as many as that one sends. All at once; returns when all is done.
  void exchange_bytes(const char* from, const std::vector<std::int64_t>& send_begin, char* to,
                      const std::vector<std::int64_t>& receive_begin) const;

  /// What this rank has sent through exchange_bytes so far, and how long it has waited in all these functions.
  const SentMessages& sent() const;

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

}  // namespace gale
