#pragma once

#include <memory>
#include <string>

#include <gale/app/report.hpp>
#include <gale/runtime/device_sweep_options.hpp>
#include <gale/runtime/structure.hpp>

namespace CLI {
class App;
}

namespace gale::app {

/// --structure, which way to compute relations, and the options that tune it.
struct StructureOption {
  std::string name = "gale";  ///< of a Way, or "task-parallel"
  StructureOptions options;

  /// --consumers, "host" or "device"; empty: on the device where the mesh is there and `name` doesn't say otherwise.
  std::string consumers;

  void add_to(CLI::App& command);

  /// For commands whose consumers may be kernels.
  void add_consumers_to(CLI::App& command);

  /// Throws UsageError where --consumers asks for a device that isn't there, or that --structure has no use for. To be
  /// called before the work.
  void require_consumers() const;

  /// Should consumers be kernels on the device that the mesh is on? Throws gale::Error where --consumers says so and
  /// the mesh doesn't fit it.
  bool on_device(const Mesh& mesh) const;

  /// How these go through the mesh.
  DeviceSweepOptions device_sweep() const;

  bool is_explicit() const { return name == "explicit"; }

  /// The structure, preconditioned for `relations`.
  std::unique_ptr<Structure> make(const Mesh& mesh, RelationSet relations) const;
};

/// Puts into the report how the structure worked, and how many edges and triangles it had to enumerate; not its
/// notices.
void report_structure(const Structure& structure, Report& report);

}  // namespace gale::app
