#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>

#include <gale/base/bits.hpp>
#include <gale/base/hash_table.hpp>

namespace gale::detail {

/// Keys that threads add side by side. It takes memory once there is a first one.
class SharedSet {
 public:
  static constexpr int part_bits = 6, parts = 1 << part_bits;

  /// Which part of the set has a key: threads that add to different ones don't wait for each other.
  static int part_of(std::uint64_t key) { return static_cast<int>(spread(key) >> (spread_bits - part_bits)); }

  /// Adds a key; false where it was there.
  bool insert(std::uint64_t key) {
    std::call_once(is_made_, [this] { parts_ = std::make_unique<std::array<Part, parts>>(); });
    Part& part = (*parts_)[part_of(key)];
    const std::lock_guard<std::mutex> lock(part.mutex);
    return part.keys.insert(key).second;
  }

 private:
  struct Nothing {};

  struct alignas(64) Part {
    std::mutex mutex;
    HashTable<Nothing> keys{16};
  };

  std::once_flag is_made_;
  std::unique_ptr<std::array<Part, parts>> parts_;
};

}  // namespace gale::detail
