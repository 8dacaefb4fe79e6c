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

}  // namespace gale
