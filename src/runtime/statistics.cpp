#include <cmath>

#include <gale/runtime/statistics.hpp>

namespace gale {

WaitingTimes& WaitingTimes::operator+=(const WaitingTimes& other) {
  push += other.push;
  queue += other.queue;
  preparation += other.preparation;
  kernel_and_transfer += other.kernel_and_transfer;
  integration += other.integration;
  return *this;
}

ConsumerStatistics& ConsumerStatistics::operator+=(const ConsumerStatistics& other) {
  hits += other.hits;
  requests += other.requests;
  waiting += other.waiting;
  segments_computed += other.segments_computed;
  seconds_computing += other.seconds_computing;
  return *this;
}

HelperStatistics& HelperStatistics::operator+=(const HelperStatistics& other) {
  segments_computed += other.segments_computed;
  seconds_computing += other.seconds_computing;
  return *this;
}

ConsumerStatistics StructureStatistics::all_consumers() const {
  ConsumerStatistics sum;
  for (const auto& one : consumers) sum += one;
  return sum;
}

void QueueLengths::add(std::size_t length) {
  if (times.size() <= length) times.resize(length + 1);
  ++times[length];
}

double QueueLengths::mean() const {
  double sum = 0, count = 0;
  for (std::size_t length = 0; length < times.size(); ++length) {
    sum += static_cast<double>(length) * static_cast<double>(times[length]);
    count += static_cast<double>(times[length]);
  }
  return count > 0 ? sum / count : 0;
}

double QueueLengths::deviation() const {
  double squares = 0, count = 0;
  const double middle = mean();
  for (std::size_t length = 0; length < times.size(); ++length) {
    const double off = static_cast<double>(length) - middle;
    squares += off * off * static_cast<double>(times[length]);
    count += static_cast<double>(times[length]);
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

std::int64_t QueueLengths::median() const {
  std::int64_t count = 0, below = 0;
  for (const std::int64_t here : times) count += here;
  for (std::size_t length = 0; length < times.size(); ++length) {
    below += times[length];
    if (below > 0 && 2 * below >= count) return static_cast<std::int64_t>(length);
  }
  return 0;
}

}  // namespace gale
