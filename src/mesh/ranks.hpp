#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
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
  std::int64_t gathered = 0;   ///< bytes of what was gathered here, to be computed with on one rank
  double seconds_waiting = 0;  ///< for messages, of itself and of others, from when it had nothing else to do
};

/// The ranks that a mesh lies on, which send one another messages: a Communicator of MPI's, or a process alone.
///
/// All functions but rank(), size(), is_alone(), sent(), note_gathered() and note_sent() are collective: every rank
/// calls them, in the same order.
class GALE_EXPORT Ranks {
 public:
  virtual ~Ranks() = default;

  /// A process by itself, which sends nothing to anybody.
  static const Ranks& alone();

  /// Whether this is a process by itself: its errors are nobody else's.
  bool is_alone() const { return this == &alone(); }

  /// This rank's number, from 0.
  virtual int rank() const = 0;

  /// How many ranks there are.
  virtual int size() const = 0;

  /// The sum of all ranks' values, on each rank: of each of several, in place.
  virtual void sum(std::int64_t* values, int count) const = 0;

  /// The sum of all ranks' values, on each rank.
  std::int64_t sum(std::int64_t value) const {
    sum(&value, 1);
    return value;
  }

  /// The least of all ranks' values, on each rank.
  virtual std::int64_t least(std::int64_t value) const = 0;
  virtual double least(double value) const = 0;  ///< the least of real numbers

  /// All ranks' values, by rank, on each rank.
  virtual std::vector<std::int64_t> all(std::int64_t value) const = 0;

  /// The sum of the values of all ranks before this one.
  virtual std::int64_t sum_before(std::int64_t value) const = 0;

  /// A string of one rank, on each rank.
  virtual std::string broadcast(const std::string& text, int from) const = 0;

  /// Sends counts[r] to each rank r, and returns what each has sent here.
  virtual std::vector<std::int64_t> exchange_counts(const std::vector<std::int64_t>& counts) const = 0;

  /// Sends the bytes [send_begin[r], send_begin[r + 1]) of `from` to each rank r, and receives [receive_begin[r],
  /// receive_begin[r + 1]) of `to` from it: as many as that one sends. All at once; returns when all is done.
  virtual void exchange_bytes(const char* from, const std::vector<std::int64_t>& send_begin, char* to,
                              const std::vector<std::int64_t>& receive_begin) const = 0;

  /// Sends each rank r the `size` bytes from `from + r * size` on, and receives as many from each likewise. For little:
  /// all of it takes one step. sent() counts of them what note_sent() is told.
  virtual void exchange_blocks(const char* from, char* to, std::int64_t size) const = 0;

  /// What this rank has sent so far, by exchange_bytes or as note_sent() was told, and how long it has waited in all
  /// these functions.
  virtual const SentMessages& sent() const = 0;

  /// Adds to what sent() says was gathered. Not collective.
  virtual void note_gathered(std::int64_t) const {}

  /// Adds so many messages, and bytes of all together, to what sent() says. Not collective.
  virtual void note_sent(std::int64_t /*messages*/, std::int64_t /*bytes*/) const {}
};

namespace detail {

/// Several numbers of each rank, by rank, on each rank. Collective.
template <std::size_t count>
std::vector<std::array<std::int64_t, count>> all_numbers(const Ranks& ranks,
                                                         const std::array<std::int64_t, count>& mine) {
  std::vector<std::array<std::int64_t, count>> all(ranks.size(), std::array<std::int64_t, count>{});
  all[ranks.rank()] = mine;
  ranks.sum(all.front().data(), static_cast<int>(count) * ranks.size());
  return all;
}

/// What became of an action on this rank.
struct Outcome {
  bool has_failed = false;
  std::string failure;       ///< what the exception says that it threw
  bool was_stopped = false;  ///< as it was asked to be: it threw Stopped
};

/// Throws SharedError if one rank has failed: what the lowest such rank says, with its name. A rank that was stopped
/// itself throws Stopped.
GALE_EXPORT void fail_together(const Ranks& ranks, const Outcome& outcome);

/// Runs an action, which may throw: what becomes of it is told to other ranks.
template <class Action>
Outcome tried(const Action& action) {
  try {
    const StopsHere told;
    action();
    return {};
  } catch (const std::exception& error) {
    return {true, error.what()};
  } catch (const Stopped&) {
    return {true, "the computation was asked to stop", true};
  } catch (...) {
    return {true, "unknown exception"};
  }
}

/// Runs an action on each rank that sends nothing to others. If it throws on some, all ranks throw the same SharedError
/// when all have ended, but Stopped where it was that: nobody waits for a rank that has given up. A process alone just
/// runs it.
template <class Action>
void together(const Ranks& ranks, const Action& action) {
  if (ranks.is_alone()) return action();
  fail_together(ranks, tried(action));
}

}  // namespace detail

}  // namespace gale
