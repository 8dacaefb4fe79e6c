#include <gale/base/parallel.hpp>
#include <gale/ttk/packed_ids.hpp>

namespace gale::ttk {

PackedIds::PackedIds(const Array<Id, HostMemory>& ids, Id least, Id greatest)
    : least_(least), size_(static_cast<Id>(ids.extent(0))) {
  const auto range = static_cast<std::uint64_t>(Offset(greatest) - least);
  while (range >> bits_ > 0) ++bits_;
  mask_ = (std::uint64_t(1) << bits_) - 1;
  constexpr Offset together = 8;  // they fill bytes, so that no other thread writes there
  const Offset groups = (size_ + together - 1) / together;
  bytes_ = allocate<Array<std::uint8_t, HostMemory>>("GALE::ttk_packed", groups * bits_ + sizeof(std::uint64_t));
  parallel_for("GALE::ttk_pack", HostSpace(), groups, [&](Offset group) {
    std::uint8_t packed[32 + sizeof(std::uint64_t)] = {};
    for (Offset i = group * together; i < (group + 1) * together && i < size_; ++i) {
      const std::uint64_t bit = (i % together) * bits_;
      std::uint64_t word;
      std::memcpy(&word, packed + bit / 8, sizeof word);
      word |= static_cast<std::uint64_t>(Offset(ids(i)) - least_) << (bit % 8);
      std::memcpy(packed + bit / 8, &word, sizeof word);
    }
    std::memcpy(bytes_.data() + group * bits_, packed, bits_);
  });
}

}  // namespace gale::ttk
