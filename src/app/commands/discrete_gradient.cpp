#include <gale/app/commands/commands.hpp>
#include <gale/app/critical_counts.hpp>
#include <gale/app/session.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/outputs/arrows.hpp>
#include <gale/outputs/critical_simplices.hpp>

namespace gale::app {

namespace {

/// What the command's structure is preconditioned for.
RelationSet relations_for(const Options& options) {
  const RelationSet gradient =
      options.formulation == "cells" ? discrete_gradient_from_cells_relations : discrete_gradient_relations;
  return options.output.empty() ? gradient : gradient | simplex_numbers_relations;
}

}  // namespace

void discrete_gradient(const Options& options) {
  require_extension(options, {".vtp"});
  require_extension(options, "--arrows", options.arrows, {".vtp"});
  Session session(options);
  const FieldOnMesh input = session.read_field();
  const auto structure = session.make_structure(input.mesh, relations_for(options));
  double& run = session.report().seconds.run;
  const DiscreteGradient gradient = [&] {
    const Stopwatch watch(run);
    const auto find = options.formulation == "cells" ? find_discrete_gradient_from_cells : find_discrete_gradient;
    return find(*structure, input.order, session.sweep("gradient"));
  }();
  const CriticalSimplices& critical = gradient.critical();
  tell(critical, session);
  if (!options.output.empty()) {
    SimplexNumbers numbers;
    {
      const Stopwatch watch(run);
      numbers = number_simplices(*structure, {critical.edges, critical.triangles}, session.sweep("numbers"));
    }
    session.write(options.output, [&](const std::string& path) {
      io::write_points(path, to_point_set(input.dataset, known_simplices(gradient, critical, numbers)));
    });
  }
  session.write(options.arrows,
                [&](const std::string& path) { io::write_points(path, arrows_of(input.dataset, gradient)); });
  session.finish(structure.get());
}

}  // namespace gale::app
