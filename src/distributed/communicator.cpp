#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>

#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/distributed/communicator.hpp>

namespace gale {

namespace {

constexpr int tag = 1;

MPI_Comm duplicate(MPI_Comm comm) {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  if (finalized) throw Error("MPI is finalized: gale::distributed comes before MPI_Finalize");
  if (!initialized) throw Error("MPI is not initialized: call MPI_Init_thread before using gale::distributed");
  MPI_Comm own;
  MPI_Comm_dup(comm, &own);
  return own;
}

/// Has the system wake this thread when it wants to be, where it may come 50 us later otherwise.
class PunctualSleep {
 public:
#if defined(__linux__)
  PunctualSleep() : slack_(prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL)) {
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  }
  ~PunctualSleep() {
    if (slack_ > 0) prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(slack_), 0UL, 0UL, 0UL);
  }

 private:
  const int slack_;  // ns
#else
  ~PunctualSleep() {}
#endif
};

}  // namespace

struct Communicator::Data {
  MPI_Comm comm;
  std::size_t largest_message;
  int rank = 0, size = 1;
  SentMessages sent;

  Data(MPI_Comm whose, std::size_t limit) : comm(duplicate(whose)), largest_message(limit) {
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
  }
  ~Data() {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (!finalized) MPI_Comm_free(&comm);
  }

  /// Waits for all, where `bytes` are sent or received. MPI's own functions would hold the core for as long as it
  /// takes: ranks that share a machine, and threads that compute, need it. So it looks again after an eighth of the
  /// time that it has waited, and at least every 2 ms, or 0.2 ms where messages are in pieces, as these go on only
  /// then. As long as they may be on their way, at 250 MB/s as where two ranks send to each other, it doesn't sleep,
  /// but lets others run: each look moves a piece. Each time it looks more than once, as MPI takes one step at each
  /// look, and a sum takes several.
  void wait(std::vector<MPI_Request>& requests, std::int64_t bytes) {
    if (size > 1) detail::await_ranks();
    using Clock = std::chrono::steady_clock;
    constexpr std::int64_t in_pieces = 1 << 20;
    constexpr int looks = 16;
    const std::chrono::microseconds longest(bytes < in_pieces ? 2000 : 200), patience(100 + bytes / 250);
    const auto begin = Clock::now();
    for (int done = 0;;) {
      for (int i = 0; i < looks && !done; ++i)
        MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
      if (done) break;
      const auto waited = Clock::now() - begin;
      if (waited > patience) {
        const PunctualSleep punctual;
        std::this_thread::sleep_for(std::min<Clock::duration>(waited / 8, longest));
      } else {
        std::this_thread::yield();
      }
    }
    sent.seconds_waiting += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  /// Begins something by begin(request), and waits for it.
  template <class Begin>
  void complete(const Begin& begin) {
    std::vector<MPI_Request> one(1);
    begin(&one[0]);
    wait(one, 0);
  }

  template <class T>
  T least(T value, MPI_Datatype type) {
    T least = 0;
    complete([&](MPI_Request* request) { MPI_Iallreduce(&value, &least, 1, type, MPI_MIN, comm, request); });
    return least;
  }

  /// Calls act(first byte, bytes) for each message that the bytes [begin, end) are cut into.
  template <class Act>
  void cut(std::int64_t begin, std::int64_t end, const Act& act) const {
    const auto limit = static_cast<std::int64_t>(largest_message);
    for (; begin < end; begin += limit) act(begin, static_cast<int>(std::min(limit, end - begin)));
  }
};

Communicator::Communicator(MPI_Comm comm, std::size_t largest_message) {
  if (largest_message < 1 || largest_message > most_bytes_a_message) {
    throw Error("messages can't be cut to " + std::to_string(largest_message) + " bytes: 1 to " +
                std::to_string(most_bytes_a_message) + " are possible");
  }
  data_ = std::make_shared<Data>(comm, largest_message);
}

int Communicator::rank() const { return data_->rank; }
int Communicator::size() const { return data_->size; }
void Communicator::note_gathered(std::int64_t bytes) const { data_->sent.gathered += bytes; }
void Communicator::note_sent(std::int64_t messages, std::int64_t bytes) const {
  data_->sent.messages += messages;
  data_->sent.bytes += bytes;
}
const SentMessages& Communicator::sent() const { return data_->sent; }

void Communicator::sum(std::int64_t* values, int count) const {
  data_->complete([&](MPI_Request* request) {
    MPI_Iallreduce(MPI_IN_PLACE, values, count, MPI_INT64_T, MPI_SUM, data_->comm, request);
  });
}

std::int64_t Communicator::least(std::int64_t value) const { return data_->least(value, MPI_INT64_T); }
double Communicator::least(double value) const { return data_->least(value, MPI_DOUBLE); }

std::vector<std::int64_t> Communicator::all(std::int64_t value) const {
  std::vector<std::int64_t> values(size());
  data_->complete([&](MPI_Request* request) {
    MPI_Iallgather(&value, 1, MPI_INT64_T, values.data(), 1, MPI_INT64_T, data_->comm, request);
  });
  return values;
}

std::int64_t Communicator::sum_before(std::int64_t value) const {
  std::int64_t sum = 0;
  data_->complete(
      [&](MPI_Request* request) { MPI_Iexscan(&value, &sum, 1, MPI_INT64_T, MPI_SUM, data_->comm, request); });
  return rank() == 0 ? 0 : sum;
}

std::string Communicator::broadcast(const std::string& text, int from) const {
  auto length = static_cast<std::int64_t>(text.size());
  data_->complete([&](MPI_Request* request) { MPI_Ibcast(&length, 1, MPI_INT64_T, from, data_->comm, request); });
  std::string all = text;
  all.resize(static_cast<std::size_t>(length));
  data_->cut(0, length, [&](std::int64_t begin, int bytes) {
    data_->complete(
        [&](MPI_Request* request) { MPI_Ibcast(&all[begin], bytes, MPI_BYTE, from, data_->comm, request); });
  });
  return all;
}

std::vector<std::int64_t> Communicator::exchange_counts(const std::vector<std::int64_t>& counts) const {
  std::vector<std::int64_t> theirs(counts.size());
  data_->complete([&](MPI_Request* request) {
    MPI_Ialltoall(counts.data(), 1, MPI_INT64_T, theirs.data(), 1, MPI_INT64_T, data_->comm, request);
  });
  return theirs;
}

void Communicator::exchange_blocks(const char* from, char* to, std::int64_t size) const {
  const int bytes = static_cast<int>(size);
  data_->complete(
      [&](MPI_Request* request) { MPI_Ialltoall(from, bytes, MPI_BYTE, to, bytes, MPI_BYTE, data_->comm, request); });
}

void Communicator::exchange_bytes(const char* from, const std::vector<std::int64_t>& send_begin, char* to,
                                  const std::vector<std::int64_t>& receive_begin) const {
  std::vector<MPI_Request> requests;
  // Each rank begins with the one after it, so that they don't all send to the first at once.
  for (int step = 1; step < size(); ++step) {
    const int source = (rank() + size() - step) % size();
    data_->cut(receive_begin[source], receive_begin[source + 1], [&](std::int64_t begin, int bytes) {
      MPI_Irecv(to + begin, bytes, MPI_BYTE, source, tag, data_->comm, &requests.emplace_back());
    });
  }
  for (int step = 1; step < size(); ++step) {
    const int target = (rank() + step) % size();
    data_->cut(send_begin[target], send_begin[target + 1], [&](std::int64_t begin, int bytes) {
      MPI_Isend(from + begin, bytes, MPI_BYTE, target, tag, data_->comm, &requests.emplace_back());
      ++data_->sent.messages;
      data_->sent.bytes += bytes;
    });
  }
  const std::int64_t own = send_begin[rank() + 1] - send_begin[rank()];
  if (own > 0) std::memcpy(to + receive_begin[rank()], from + send_begin[rank()], static_cast<std::size_t>(own));
  data_->wait(requests, std::max(send_begin.back(), receive_begin.back()) - own);
}

}  // namespace gale
