#include <gale/algorithms/surface_vertices.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

void Connectivity::need_surface(int dimension) {
  if (on_surface_[dimension].data() != nullptr) return;
  if (dimension != 0) {
    need(facet_dimension());
    need(dimension);
    set_surface(dimension, dimension == this->dimension() ? no_flags(dimension) : surface_from_facets(dimension));
  } else if (facets().is_there()) {
    set_surface(0, surface_from_facets(0));
  } else if (wanted_rows_.has(Relation::VV)) {
    set_surface(0, find_surface_in_sweep());
  } else {
    surface_waits_ = true;
  }
}

Connectivity::Flags Connectivity::no_flags(int dimension) const {
  const auto flags = allocate<Flags>("GALE::ttk_surface", (Offset(counts_[dimension]) + 7) / 8);
  fill("GALE::ttk_clear_surface", HostExecutionSpace(), flags, 0);
  return flags;
}

void Connectivity::set_surface(int dimension, const Flags& flags) const {
  on_surface_[dimension] = flags;
  surface_flags_[dimension].store(flags.data(), std::memory_order_release);
}

/// Finds the surface of vertices that still waits.
const std::uint8_t* Connectivity::late_surface(int dimension) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (dimension != 0 || !surface_waits_) throw Error("what is on the boundary was not preconditioned");
  if (on_surface_[0].data() == nullptr) {
    const auto flags = no_flags(0);
    if (mesh_) {
      const auto vertices = surface_vertices(*mesh_);
      parallel_for("GALE::ttk_surface", HostExecutionSpace(), counts_[0], [&](Offset i) {
        if (vertices(i)) set_flag(flags, vertex_input_[i]);
      });
    } else {
      sweep_cells(flags, false);
    }
    set_surface(0, flags);
  }
  return on_surface_[0].data();
}

/// The facets with one cell, or their vertices or edges.
Connectivity::Flags Connectivity::surface_from_facets(int dimension) const {
  const auto flags = no_flags(dimension);
  const auto set_all = [&](const auto& parts) {
    for (const Id part : parts) set_flag(flags, part);
  };
  parallel_for("GALE::ttk_surface", HostExecutionSpace(), counts_[facet_dimension()], [&](Offset i) {
    const Id facet = static_cast<Id>(i);
    if (facets().second[facet] != no_id) return;
    if (dimension == facet_dimension()) {
      set_flag(flags, facet);
    } else if (dimension == 1) {
      set_all(edges_of_triangle(facet));
    } else if (facet_dimension() == 1) {
      set_all(part_of_cell(edges_, edge_corners, facet));
    } else {
      set_all(part_of_cell(triangles_, triangle_corners, facet));
    }
  });
  return flags;
}

}  // namespace gale::ttk
