#pragma once

#include <cstddef>
#include <memory>

#include <gale/base/types.hpp>

namespace gale::python {

/// Memory for entries. The system gives its pages before they are written: many at a time, on so many threads.
class Entries {
 public:
  Entries(std::size_t count, int threads);
  ~Entries();
  Entries(const Entries&) = delete;
  Entries& operator=(const Entries&) = delete;

  Id* ids() { return ids_; }

  /// The first ones stay as they are.
  void resize(std::size_t count);

  std::shared_ptr<Id> release();

 private:
  Id* ids_ = nullptr;
};

/// Likewise memory for where rows begin.
std::shared_ptr<std::int64_t[]> new_begins(std::size_t count, int threads);

}  // namespace gale::python
