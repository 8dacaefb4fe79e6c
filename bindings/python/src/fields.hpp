#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/stop.hpp>
#include <gale/io/dataset.hpp>

#include "mesh.hpp"

namespace gale::python {

/// A copy of values on the host, which asks now and then whether to stop.
template <class T>
std::vector<T> vector_of(const T* values, std::size_t count) {
  std::vector<T> copy;
  copy.reserve(count);
  for (std::size_t done = 0; done < count;) {
    constexpr std::size_t at_once = 1 << 20;
    gale::detail::stop_if_asked();
    const std::size_t next = std::min(done + at_once, count);
    copy.insert(copy.end(), values + done, values + next);
    done = next;
  }
  return copy;
}

/// A copy of the field on the host, as the outputs take it. Throws gale::Error unless it has one dimension, and numbers
/// of up to 8 bytes. To be called within a `Call`, since it may be on a device.
io::PointArray field_of(const Array1& values, const std::string& name);

VertexOrder order_of(const Mesh& mesh, const io::PointArray& field);

}  // namespace gale::python
