#include <cstring>

#include <gale/base/stop.hpp>
#include <gale/mesh/ranks.hpp>

namespace gale {

namespace {

class ProcessAlone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void sum(std::int64_t*, int) const override {}
  std::int64_t least(std::int64_t value) const override { return value; }
  double least(double value) const override { return value; }
  std::vector<std::int64_t> all(std::int64_t value) const override { return {value}; }
  std::int64_t sum_before(std::int64_t) const override { return 0; }
  std::string broadcast(const std::string& text, int) const override { return text; }
  std::vector<std::int64_t> exchange_counts(const std::vector<std::int64_t>& counts) const override { return counts; }
  void exchange_bytes(const char* from, const std::vector<std::int64_t>& send_begin, char* to,
                      const std::vector<std::int64_t>&) const override {
    if (send_begin.back() > 0) std::memcpy(to, from, static_cast<std::size_t>(send_begin.back()));
  }
  void exchange_blocks(const char* from, char* to, std::int64_t size) const override {
    std::memcpy(to, from, static_cast<std::size_t>(size));
  }
  const SentMessages& sent() const override { return sent_; }

 private:
  SentMessages sent_;
};

}  // namespace

const Ranks& Ranks::alone() {
  static const ProcessAlone process;
  return process;
}

namespace detail {

void fail_together(const Ranks& ranks, const Outcome& outcome) {
  const std::int64_t first = ranks.least(std::int64_t(outcome.has_failed ? ranks.rank() : ranks.size()));
  if (first == ranks.size()) return;
  const std::string message = ranks.broadcast(outcome.failure, static_cast<int>(first));
  if (outcome.was_stopped) throw Stopped();
  throw SharedError(ranks.size() == 1 ? message : "rank " + std::to_string(first) + ": " + message);
}

}  // namespace detail

}  // namespace gale
