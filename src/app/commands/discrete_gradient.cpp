#include <CLI/CLI.hpp>

#include <gale/app/commands/commands.hpp>
#include <gale/app/critical_counts.hpp>
#include <gale/app/session.hpp>
#include <gale/app/usage_error.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/outputs/arrows.hpp>
#include <gale/outputs/critical_simplices.hpp>

namespace gale::app {

namespace {

class FindDiscreteGradient final : public Command {
 public:
  explicit FindDiscreteGradient(CLI::App& app)
      : Command(app, outputs::analysis_named("discrete-gradient"), Works::on_many_ranks) {
    segmentation_.add_to(subcommand());
    structure_.add_to(subcommand());
    structure_.add_consumers_to(subcommand());
    subcommand().add_option("-o,--output", output_,
                            "The critical simplices: .vtp; on several ranks .pvtp, with a .vtp a rank");
    add_encoding();
    subcommand()
        .add_option("--formulation", formulation_,
                    "stars (from VV, VT and link) or cells (from VE, VF and VT, as other programs do; slower): the "
                    "same result")
        ->check(CLI::IsMember({"stars", "cells"}));
    subcommand().add_option("--arrows", arrows_, outputs::analysis_named("discrete-gradient").option("arrows").help);
  }

  void run() const override {
    structure_.require_consumers();
    refuse_on_ranks({{"--arrows", !arrows_.empty()}, {"--formulation cells", is_from_cells()}});
    if (is_from_cells() && structure_.options.consumers == ConsumerPlace::device)
      throw UsageError("--consumers device: not with --formulation cells");
    require_points_extension("--output", output_);
    require_extension("--arrows", arrows_, {".vtp"});
    Session session(input(), common(), {output_, arrows_});
    session.warm_up(structure_, [](const VertexOrder& order) { find_discrete_gradient(order); });
    const FieldOnMesh on = session.read_field(segmentation_);
    Computed computed;
    const DiscreteGradient gradient = find(on, session, computed);
    tell_simplices(gradient.counts(), session);
    if (!output_.empty()) write_critical(on, gradient, session, computed);
    session.write(
        arrows_, [&](const io::AtomicFile& file) { io::write_points(file, outputs::arrows_of(on.dataset, gradient)); });
    session.finish(structure_, computed);
  }

 private:
  bool is_from_cells() const { return formulation_ == "cells"; }

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

  SegmentationOptions segmentation_;
  StructureOption structure_;
  std::string output_, arrows_;
  std::string formulation_ = "stars";
};

}  // namespace

std::unique_ptr<Command> add_discrete_gradient(CLI::App& app) { return std::make_unique<FindDiscreteGradient>(app); }

}  // namespace gale::app
