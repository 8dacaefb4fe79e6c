#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/export.hpp>

namespace gale::detail {

/// Some of the workers' memory that is kept for whoever wants so much for a moment, from where it goes back when the
/// last copy is gone; null for nothing, for more than a piece of it has, and where all is in use or memory is short.
GALE_EXPORT std::shared_ptr<void> take_kept_bytes(std::size_t bytes);

/// An array that is wanted for a moment, uninitialized. On a device it is kept memory, where there is some: to allocate
/// little and to free it takes longer than what is done with it. Whoever has work done on it waits for that before it
/// goes. Throws OutOfMemory.
template <class T, class Memory>
class Momentary {
 public:
  Momentary(const char* label, std::size_t count) { make(label, count); }

  /// Copies what the host has; on the host it refers to that.
  Momentary(const char* label, const Array<const T, HostMemory>& entries) {
    if constexpr (is_device_memory<Memory>) {
      copy_to_device(make(label, entries.extent(0)), entries.data(), entries.extent(0) * sizeof(T));
    } else {
      array_ = entries;
    }
  }

  const Array<T, Memory>& array() const { return array_; }

 private:
  using Entry = std::remove_const_t<T>;

  Entry* make(const char* label, std::size_t count) {
    if constexpr (is_device_memory<Memory>) kept_ = take_kept_bytes(count * sizeof(T));
    if (kept_) {
      array_ = Array<T, Memory>(static_cast<Entry*>(kept_.get()), count);
      return static_cast<Entry*>(kept_.get());
    }
    const TrackedViews tracked;
    const auto made = allocate<Array<Entry, Memory>>(label, count);
    array_ = made;
    return made.data();
  }

  std::shared_ptr<void> kept_;
  Array<T, Memory> array_;
};

/// Reads an entry.
template <class T, class Memory>
struct EntryAt {
  Array<const T, Memory> entries;
  KOKKOS_FUNCTION T operator()(Id place) const { return entries(place); }
};

/// Writes value(place) for some places.
template <class T, class Memory, class Value>
struct WriteValues {
  Value value;
  Array<const Id, Memory> places;
  Array<T, Memory> values;
  KOKKOS_FUNCTION void operator()(Offset i) const { values(i) = value(places(i)); }
};

/// value(place), a functor's for kernels in a space, for each of some places.
template <class Space, class Value>
auto results_at(const char* label, const Space& space, const Array<const Id, HostMemory>& places, const Value& value) {
  using T = std::decay_t<std::invoke_result_t<const Value&, Id>>;
  using Memory = MemoryOf<Space>;
  auto values = unwritten<T>(places.extent(0));
  if (values.empty()) return values;
  const auto write_on = [&](const Array<const Id, Memory>& from, const Array<T, Memory>& to) {
    parallel_for(label, space, static_cast<Offset>(from.extent(0)), WriteValues<T, Memory, Value>{value, from, to});
  };
  if constexpr (is_device<Space>) {
    const Momentary<const Id, Memory> from(label, places);
    const Momentary<T, Memory> to(label, values.size());
    write_on(from.array(), to.array());
    space.fence();
    copy_from_device(values.data(), to.array().data(), values.size() * sizeof(T));
  } else {
    write_on(places, Array<T, Memory>(values.data(), values.size()));
  }
  return values;
}

template <class Space, class Value>
auto results_at(const char* label, const Space& space, const std::vector<Id>& places, const Value& value) {
  return results_at(label, space, Array<const Id, HostMemory>(places.data(), places.size()), value);
}

/// Some of the entries, read where all were made.
template <class T>
std::vector<T> entries_at(const Mirrored<T>& all, const std::vector<Id>& places) {
  return in_worker_or_host_space(all.on_device(), [&](const auto& space) -> std::vector<T> {
    using Memory = MemoryOf<std::decay_t<decltype(space)>>;
    return results_at("GALE::entries_at", space, places, EntryAt<T, Memory>{all.template in<Memory>()});
  });
}

}  // namespace gale::detail
