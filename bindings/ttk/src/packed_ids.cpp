#include <algorithm>

#include <gale/base/parallel.hpp>
#include <gale/ttk/packed_ids.hpp>

namespace gale::ttk {

PackedIds::PackedIds(const Array<Id, HostMemory>& ids, Id least, Id greatest)
    : least_(least), size_(static_cast<Id>(ids.extent(0))) {
  const auto range = static_cast<std::uint64_t>(
      std::max(Offset(greatest) - least, Offset(0)));  // without ids the difference is below 0
  while (range >> bits_ > 0) ++bits_;
  mask_ = (std::uint64_t(1) << bits_) - 1;
  constexpr Offset together = 8;  // packed ids that fill whole bytes, so that no other thread writes there
  const Offset groups = (size_ + together - 1) / together;
  bytes_ = allocate<Array<std::uint8_t, HostMemory>>("GALE::ttk_packed", groups * bits_ + sizeof(std::uint64_t));
  parallel_for("GALE::ttk_pack", HostExecutionSpace(), groups, [&](Offset group) {
    std::uint32_t packed[together + 1];
    std::uint32_t* to = packed;
    std::uint64_t word = 0;  // its lowest `filled` bits are filled, less than 32
    std::uint32_t filled = 0;
    for (Offset i = group * together; i < (group + 1) * together; ++i) {
      if (i < size_) word |= static_cast<std::uint64_t>(Offset(ids(i)) - least_) << filled;
      filled += bits_;
      if (filled < 32) continue;
      *to++ = static_cast<std::uint32_t>(word);
      word >>= 32;
      filled -= 32;
    }
    *to = static_cast<std::uint32_t>(word);
    std::memcpy(bytes_.data() + group * bits_, packed, bits_);
  });
}

}  // namespace gale::ttk
