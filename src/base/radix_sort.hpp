#pragma once

#include <cstdint>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

namespace gale {

/// Sorts `keys` ascending and carries `values` along; equal keys keep their order. Both arrays are overwritten.
/// O(n) a pass of 11 bits of the key; on the host, passes whose bits are the same in all keys are left out. Uses as
/// much memory again. Enqueued on the instance of a device, as loops are.
template <class Space>
GALE_EXPORT void stable_sort_by_key(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& keys,
                                    const Array<Id, MemoryOf<Space>>& values);

}  // namespace gale
