#pragma once

#include <cstdint>
#include <cstring>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

namespace gale::ttk {

/// Ids in as many bits as the greatest needs. Immutable.
class GALE_EXPORT PackedIds {
 public:
  PackedIds() = default;

  /// Packs ids from `least` to `greatest`. O(n), on all our threads.
  PackedIds(const Array<Id, HostMemory>& ids, Id least, Id greatest);

  Id size() const { return size_; }
  Id operator[](Id i) const {
    const std::uint64_t bit = std::uint64_t(std::uint32_t(i)) * bits_;
    std::uint64_t word;
    std::memcpy(&word, bytes_.data() + bit / 8, sizeof word);
    return static_cast<Id>(least_ + static_cast<Offset>(word >> (bit % 8) & mask_));
  }

  std::size_t bytes() const { return bytes_.span(); }

 private:
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

  Array<std::uint8_t, HostMemory> bytes_;  ///< some more than the ids take, so that words may be read
  std::uint64_t mask_ = 0;
  std::uint32_t bits_ = 0;
  Id least_ = 0, size_ = 0;
};

}  // namespace gale::ttk
