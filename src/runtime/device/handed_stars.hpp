#pragma once

#include <algorithm>
#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/transfer.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// What the lanes of kernels append to, in no order, as long as there is room; the count goes on. Copies share it.
template <class T>
class DeviceList {
 public:
  DeviceList() = default;

  /// Empty. Throws OutOfMemory.
  DeviceList(const char* label, Offset capacity)
      : items_(allocate<Array<T, WorkerMemory>>(label, capacity)), count_("GALE::list_count", 1) {}

  KOKKOS_FUNCTION void add(const T& item) const {
    const Offset at = atomic_add(count_.data(), Offset(1));
    if (at < static_cast<Offset>(items_.extent(0))) items_(at) = item;
  }

  /// How many were appended, more than there is room for perhaps. Waits for all kernels.
  Offset count() const {
    Offset count = 0;
    Kokkos::deep_copy(count, Kokkos::subview(count_, 0));
    return count;
  }

  KOKKOS_FUNCTION const T& operator[](Offset i) const { return items_(i); }

  bool overflowed() const { return count() > static_cast<Offset>(items_.extent(0)); }

  /// The items that there was room for.
  std::vector<T> to_host() const {
    const auto size = std::min(static_cast<std::size_t>(count()), items_.extent(0));
    const auto there = on_host(first_of(items_, size));
    std::vector<T> items;
    reserve(items, size);
    items.assign(there.data(), there.data() + size);
    return items;
  }

 private:
  Array<T, WorkerMemory> items_;
  Array<Offset, WorkerMemory> count_;
};

/// Stars that a lane can't hold, or shouldn't while others wait for it: handed on with their rows, which outlive the
/// batch that way. Kernels append them, in no order, as long as there is room.
class HandedStars {
 public:
  /// Where the rows of one begin among the words, and how long they are.
  struct Place {
    Id vertex, neighbours, cells, link;
    int width, others;
    Offset begin;
  };

  /// Room for so many stars, and words of their rows. Throws OutOfMemory.
  HandedStars(Offset stars, Offset words)
      : places_("GALE::handed_stars", stars),
        words_(allocate<Array<Id, WorkerMemory>>("GALE::handed_rows", words)),
        used_("GALE::handed_rows_used", 2) {}

  KOKKOS_FUNCTION void add(const VertexStar& star) const {
    const Offset bytes = Offset(star.link.others) * star.link.size() * star.link.width;
    const Offset size = Offset(star.neighbours.size()) + star.cells.size() + (bytes + 3) / 4;
    const Offset begin = atomic_add(used_.data(), size);
    if (begin + size > static_cast<Offset>(words_.extent(0))) {
      atomic_add(used_.data() + 1, Offset(1));
      return;
    }
    Id* to = words_.data() + begin;
    for (const Id id : star.neighbours) *to++ = id;
    for (const Id id : star.cells) *to++ = id;
    const auto* const from = static_cast<const std::uint8_t*>(star.link.places);
    auto* const places = reinterpret_cast<std::uint8_t*>(to);
    for (Offset i = 0; i < bytes; ++i) places[i] = from[i];
    places_.add({star.vertex, star.neighbours.size(), star.cells.size(), star.link.size(), star.link.width,
                 star.link.others, begin});
  }

  /// How many there are. Waits for all kernels.
  Offset count() const { return places_.count(); }

  /// Was there too little room? If so, `stars` and `words` become at least what there was to be.
  bool overflowed(Offset& stars, Offset& words) const {
    const auto used = Kokkos::create_mirror_view_and_copy(HostMemory(), used_);
    const bool lacked = used(1) > 0 || places_.overflowed();
    words = std::max(words, used(0));
    if (lacked) stars = std::max(stars, count() + used(1));
    return lacked;
  }

  /// The i-th, for kernels.
  KOKKOS_FUNCTION VertexStar operator[](Offset i) const { return star_at(places_[i], words_.data()); }

  /// All of them there.
  class OnHost {
   public:
    Offset size() const { return static_cast<Offset>(places_.size()); }
    VertexStar operator[](Offset i) const { return star_at(places_[i], words_.data()); }

   private:
    friend class HandedStars;
    std::vector<Place> places_;
    Array<const Id, HostMemory> words_;
  };

  OnHost to_host() const {
    OnHost copy;
    copy.places_ = places_.to_host();
    const auto used = Kokkos::create_mirror_view_and_copy(HostMemory(), used_);
    const std::size_t words = std::min(static_cast<std::size_t>(used(0)), words_.extent(0));
    copy.words_ = on_host(first_of(words_, words));
    return copy;
  }

 private:
  KOKKOS_FUNCTION static VertexStar star_at(const Place& place, const Id* words) {
    const Id* const neighbours = words + place.begin;
    const Id* const cells = neighbours + place.neighbours;
    return {place.vertex,
            {neighbours, place.neighbours},
            {cells, place.cells},
            {cells + place.cells, place.link, place.width, place.others}};
  }

  DeviceList<Place> places_;
  Array<Id, WorkerMemory> words_;
  Array<Offset, WorkerMemory> used_;  // words, and the stars whose rows found no room
};

}  // namespace gale::detail
