#pragma once

#include <functional>
#include <thread>

#include <gale/algorithms/vertex_order.hpp>

namespace gale::app {

/// Has the device do all that a command does, once, on a tiny mesh, while the input is read: the first time in a
/// process costs tens of milliseconds that have nothing to do with the input (kernels are loaded, memory is locked and
/// mapped). Where there is no device, nothing.
class WarmUp {
 public:
  WarmUp() = default;
  WarmUp(const WarmUp&) = delete;
  WarmUp& operator=(const WarmUp&) = delete;
  ~WarmUp() { wait(); }

  /// Begins, on a thread of its own; `run` gets the order of the tiny mesh' vertices, which are on the device. What
  /// fails here fails in the work, too, and is said there.
  void begin(std::function<void(const VertexOrder&)> run);

  void wait();

 private:
  std::thread thread_;
};

}  // namespace gale::app
