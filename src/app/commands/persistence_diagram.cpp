#include <CLI/CLI.hpp>

#include <gale/algorithms/persistence.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/app/drawing/picture.hpp>

namespace gale::app {

namespace {

void tell(const outputs::DiagramCounts& counts, int dimension, Session& session) {
  static const char* const names[] = {"minimum-saddle", "saddle-saddle", "saddle-maximum"};
  for (int type = 0; type < dimension; ++type)
    session.console().say(names[type + 1 == dimension ? 2 : type], grouped(counts.pairs[type]));
  std::string essential;
  for (const Id count : counts.essential) essential += (essential.empty() ? "" : ", ") + grouped(count);
  session.console().say("essential", essential);
  session.report().result = {{"pairs", counts.pairs}, {"essential", counts.essential}};
}

class FindPersistenceDiagram final : public AnalysisCommand {
 public:
  explicit FindPersistenceDiagram(CLI::App& app) : AnalysisCommand(app, "persistence-diagram") {
    add_file("-o,--output", output_, "The diagram, a line a pair: .vtu", {".vtu"});
    add_file("--curve", curve_, "How many pairs have at least a persistence, for each that occurs: .csv", {".csv"});
    add_persistence(subcommand(), persistence_, analysis_.option("persistence").help);
    add_file("--render", render_, "Draw diagram and curve to this .png", {".png"})->type_name("FILE.png");
  }

 private:
  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    const DiscreteGradient gradient =
        find_discrete_gradient(on.order, session.compute(structure_, "gradient"), &computed);
    const auto diagram = find(gradient, on, session);
    tell(outputs::counts_of(diagram), on.mesh.dimension(), session);
    session.write(output_, [&](const io::AtomicFile& file) {
      io::write_lines(file, outputs::to_lines(on.dataset, on.field, diagram));
    });
    session.write(curve_, [&](const io::AtomicFile& file) {
      write_text(file, [&](std::ostream& out) { out << outputs::to_csv(outputs::persistence_curve(diagram)); });
    });
    session.write(render_, [&](const io::AtomicFile& file) { draw(file, plot_of(diagram, on.field.name)); });
  }

  std::vector<outputs::DiagramPoint> find(const DiscreteGradient& gradient, const FieldOnMesh& on,
                                          Session& session) const {
    const Stopwatch watch(session.report().seconds.run);
    const double least = persistence_ ? threshold_of_option(*persistence_, on.field) : 0;
    const PersistencePairs pairs = find_persistence_pairs(gradient, session.sweep("pairs"));
    return outputs::persistence_diagram(gradient, pairs, on.field, least);
  }

  std::optional<outputs::Persistence> persistence_;
  std::string output_, curve_, render_;
};

}  // namespace

std::unique_ptr<Command> add_persistence_diagram(CLI::App& app) {
  return std::make_unique<FindPersistenceDiagram>(app);
}

}  // namespace gale::app
