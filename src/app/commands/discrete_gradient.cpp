#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/outputs/arrows.hpp>
#include <gale/outputs/critical_simplices.hpp>

namespace gale::app {

namespace {

class FindDiscreteGradient final : public AnalysisCommand {
 public:
  explicit FindDiscreteGradient(CLI::App& app) : AnalysisCommand(app, "discrete-gradient", Works::on_many_ranks) {
    add_file("-o,--output", output_, "The critical simplices: {}", io::written_points);
    subcommand()
        .add_option("--formulation", formulation_,
                    "stars (from VV, VT and link) or cells (from VE, VF and VT, as other programs do; slower): the "
                    "same result")
        ->check(CLI::IsMember({"stars", "cells"}));
    add_file("--arrows", arrows_, analysis_.option("arrows").help, io::written_arrows);
  }

 private:
  bool is_from_cells() const { return formulation_ == "cells"; }

  void require_usage() const override {
    refuse_on_ranks({{"--formulation cells", is_from_cells()}});
    if (is_from_cells() && structure_.options.consumers == ConsumerPlace::device)
      throw UsageError("--consumers device: not with --formulation cells");
  }

  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    const DiscreteGradient gradient = find(on, session, computed);
    tell_simplices(gradient.counts(), on.mesh.dimension(), session);
    if (!output_.empty()) write_critical(on, gradient, session, computed);
    session.write_result(arrows_, [&] {
      io::PointSet arrows;
      gale::detail::together(session.ranks(), [&] { arrows = outputs::arrows_of(on.dataset, gradient); });
      return arrows;
    });
  }

  DiscreteGradient find(const FieldOnMesh& on, Session& session, Computed& computed) const {
    if (!is_from_cells()) return find_discrete_gradient(on.order, session.compute(structure_, "gradient"), &computed);
    const RelationSet numbers = output_.empty() ? RelationSet() : simplex_numbers_relations;
    computed.structure = session.make_structure(structure_, on.mesh, discrete_gradient_from_cells_relations | numbers);
    const Stopwatch watch(session.report().seconds.run);
    return find_discrete_gradient_from_cells(*computed.structure, on.order, session.sweep("gradient"));
  }

  void write_critical(const FieldOnMesh& on, const DiscreteGradient& gradient, Session& session,
                      Computed& computed) const {
    const CriticalSimplices& critical = gradient.critical();
    const SimplexNumbers numbers = number_simplices(gradient.mesh(), {critical.edges, critical.triangles},
                                                    session.compute(structure_, "numbers"), &computed);
    session.write_result(output_, [&] {
      return outputs::to_point_set(on.dataset, outputs::known_simplices(gradient, critical, numbers),
                                   on.mesh.exchange());
    });
  }

  std::string output_, arrows_;
  std::string formulation_ = "stars";
};

}  // namespace

std::unique_ptr<Command> add_discrete_gradient(CLI::App& app) { return std::make_unique<FindDiscreteGradient>(app); }

}  // namespace gale::app
