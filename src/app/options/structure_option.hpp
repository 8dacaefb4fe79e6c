#pragma once

#include <memory>
#include <string>

#include <gale/app/report.hpp>
#include <gale/runtime/computation.hpp>

namespace CLI {
class App;
}

namespace gale::app {

/// --structure, which way to compute relations, the options that tune it, and --consumers.
struct StructureOption {
  ComputeOptions options;  ///< but for threads and progress

  void add_to(CLI::App& command);

  /// For commands whose consumers may be kernels.
  void add_consumers_to(CLI::App& command);

  /// Throws UsageError where --consumers asks for a device that isn't there, or that --structure has no use for. To be
  /// called before the work.
  void require_consumers() const;

  /// What --structure says: the name of a Way, or "task-parallel".
  std::string name = name_of(Way::gale);

  bool is_explicit() const { return options.structure.way == Way::explicit_; }

  /// The structure, preconditioned for `relations`.
  std::unique_ptr<Structure> make(const Mesh& mesh, RelationSet relations) const;

 private:
  void set(const std::string& named);
};

/// Puts into the report how the structure worked, and how many edges and triangles it had to enumerate; not its
/// notices.
void report_structure(const Structure& structure, Report& report);

}  // namespace gale::app
