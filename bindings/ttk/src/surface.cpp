#include <gale/algorithms/surface_vertices.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

void Connectivity::need_surface(int dimension) {
  if (on_surface_[dimension].data() != nullptr) return;
  if (dimension != 0) {
    need_triangles();
    if (dimension == 1) need_edges();
    set_surface(dimension, surface_from_triangles(dimension));
  } else if (triangles_.is_there()) {
    set_surface(0, surface_from_triangles(0));
  } else if (wanted_rows_.has(Relation::VV)) {
    set_surface(0, find_surface_in_sweep());
  } else {
    surface_waits_ = true;
  }
}

void Connectivity::set_surface(int dimension, const Flags& flags) const {
  on_surface_[dimension] = flags;
  surface_flags_[dimension].store(flags.data(), std::memory_order_release);
}

/// Of vertices whose surface still waits.
const std::uint8_t* Connectivity::late_surface(int dimension) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (dimension != 0 || !surface_waits_) throw Error("what is on the boundary was not preconditioned");
  if (on_surface_[0].data() == nullptr) {
    const auto flags = allocate<Flags>("GALE::ttk_surface", counts_[0]);
    const auto vertices = surface_vertices(mesh_);
    parallel_for("GALE::ttk_surface", HostSpace(), counts_[0],
                 [&](Offset i) { flags(vertex_input_[i]) = vertices(i); });
    set_surface(0, flags);
  }
  return on_surface_[0].data();
}

/// The triangles with one cell, or their vertices or edges.
Connectivity::Flags Connectivity::surface_from_triangles(int dimension) const {
  const HostSpace host;
  const auto flags = allocate<Flags>("GALE::ttk_surface", counts_[dimension]);
  fill("GALE::ttk_clear_surface", host, flags, 0);
  parallel_for("GALE::ttk_surface", host, counts_[2], [&](Offset i) {
    const Id triangle = static_cast<Id>(i);
    if (triangles_.second(triangle) != no_id) return;
    if (dimension == 2) {
      flags(triangle) = 1;
      return;
    }
    const auto parts =
        dimension == 1 ? edges_of_triangle(triangle) : part_of_cell(triangles_, triangle_corners, triangle);
    for (const Id part : parts) atomic_write(&flags(part), std::uint8_t(1));
  });
  return flags;
}

}  // namespace gale::ttk
