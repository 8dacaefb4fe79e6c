#pragma once

#include <string>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/io/dataset.hpp>

#include "mesh.hpp"

namespace gale::python {

/// A copy of the field on the host, as the outputs take it. Throws gale::Error unless it has one dimension, and numbers
/// of up to 8 bytes. To be called within a `Call`, since it may be on a device.
io::PointArray field_of(const Array1& values, const std::string& name);

VertexOrder order_of(const Mesh& mesh, const io::PointArray& field);

}  // namespace gale::python
