#pragma once

#include <memory>
#include <string>

#include <gale/app/report.hpp>
#include <gale/runtime/structure.hpp>

namespace CLI {
class App;
}

namespace gale::app {

/// --structure, which way to compute relations, and the options that tune it.
struct StructureOption {
  std::string name = "gale";  ///< the name of a Way
  StructureOptions options;

  void add_to(CLI::App& command);

  bool is_explicit() const { return name == "explicit"; }

  /// The structure, preconditioned for `relations`.
  std::unique_ptr<Structure> make(const Mesh& mesh, RelationSet relations) const;
};

/// Puts into the report how the structure worked, and how many edges and triangles it had to enumerate; not its
/// notices.
void report_structure(const Structure& structure, Report& report);

}  // namespace gale::app
