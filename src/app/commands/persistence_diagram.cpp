#include <CLI/CLI.hpp>

#include <gale/algorithms/persistence.hpp>
#include <gale/app/commands/commands.hpp>
#include <gale/app/drawing/diagram_plot.hpp>
#include <gale/app/drawing/scene.hpp>
#include <gale/app/options/parse.hpp>
#include <gale/app/options/persistence_option.hpp>
#include <gale/app/output_file.hpp>
#include <gale/app/session.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/persistence.hpp>

namespace gale::app {

namespace {

void tell(const outputs::DiagramCounts& counts, Session& session) {
  static const char* const names[] = {"minimum-saddle", "saddle-saddle", "saddle-maximum"};
  for (int type = 0; type < 3; ++type) session.console().say(names[type], grouped(counts.pairs[type]));
  std::string essential;
  for (const Id count : counts.essential) essential += (essential.empty() ? "" : ", ") + grouped(count);
  session.console().say("essential", essential);
  session.report().result = {{"pairs", counts.pairs}, {"essential", counts.essential}};
}

class FindPersistenceDiagram final : public Command {
 public:
  explicit FindPersistenceDiagram(CLI::App& app) : Command(app, outputs::analysis_named("persistence-diagram")) {
    segmentation_.add_to(subcommand());
    structure_.add_to(subcommand());
    structure_.add_consumers_to(subcommand());
    subcommand().add_option("-o,--output", output_, "The diagram, a line a pair: .vtu");
    add_encoding();
    subcommand().add_option("--curve", curve_,
                            "How many pairs have at least a persistence, for each that occurs: .csv");
    add_persistence(subcommand(), persistence_,
                    outputs::analysis_named("persistence-diagram").option("persistence").help);
    subcommand().add_option("--render", render_, "Draw diagram and curve to this .png")->type_name("FILE.png");
  }

  void run() const override {
    structure_.require_consumers();
    require_extension("--output", output_, {".vtu"});
    require_extension("--curve", curve_, {".csv"});
    require_extension("--render", render_, {".png"});
    if (!render_.empty()) require_drawing();
    Session session(input(), common(), {output_, render_, curve_});
    session.warm_up(structure_, [](const VertexOrder& order) { find_discrete_gradient(order); });
    const FieldOnMesh on = session.read_field(segmentation_);
    Computed computed;
    const DiscreteGradient gradient =
        find_discrete_gradient(on.order, session.compute(structure_, "gradient"), &computed);
    const auto diagram = find(gradient, on, session);
    tell(outputs::counts_of(diagram), session);
    session.write(output_, [&](const io::AtomicFile& file) {
      io::write_lines(file, outputs::to_lines(on.dataset, on.field, diagram));
    });
    session.write(curve_, [&](const io::AtomicFile& file) {
      write_text(file, [&](std::ostream& out) { out << outputs::to_csv(outputs::persistence_curve(diagram)); });
    });
    session.write(render_, [&](const io::AtomicFile& file) { draw(file, plot_of(diagram, on.field.name)); });
    session.finish(structure_, computed);
  }

 private:
  std::vector<outputs::DiagramPoint> find(const DiscreteGradient& gradient, const FieldOnMesh& on,
                                          Session& session) const {
    const Stopwatch watch(session.report().seconds.run);
    const double least = persistence_ ? threshold_of_option(*persistence_, on.field) : 0;
    const PersistencePairs pairs = find_persistence_pairs(gradient, session.sweep("pairs"));
    return outputs::persistence_diagram(gradient, pairs, on.field, least);
  }

  SegmentationOptions segmentation_;
  StructureOption structure_;
  std::optional<outputs::Persistence> persistence_;
  std::string output_, curve_, render_;
};

}  // namespace

std::unique_ptr<Command> add_persistence_diagram(CLI::App& app) {
  return std::make_unique<FindPersistenceDiagram>(app);
}

}  // namespace gale::app
