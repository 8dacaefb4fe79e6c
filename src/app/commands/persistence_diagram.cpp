#include <CLI/CLI.hpp>

#include <gale/algorithms/persistence.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/app/drawing/drawer.hpp>
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
  explicit FindPersistenceDiagram(CLI::App& app) : AnalysisCommand(app, "persistence-diagram", Works::on_many_ranks) {
    add_file("-o,--output", output_, "The diagram, a line a pair: {}", io::written_lines);
    add_file("--curve", curve_, "How many pairs have at least a persistence, for each that occurs: {}",
             io::written_tables);
    add_persistence();
    add_render(render_, "Draw diagram and curve to this {}");
  }

 private:
  Session::Keep keep() const override { return Session::Keep::owned_values; }

  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    const double least = threshold_for(on.field);
    on.order.bring_keys_to_host();
    const DiscreteGradient found = find_discrete_gradient(on.order, session.compute(structure_, "gradient"), &computed);
    const SweepOptions sweep = session.sweep("pairs");
    const GatheredPairs gathered =
        timed(session.report().seconds.run, [&] { return gather_persistence_pairs(found, sweep); });
    const OnExcerpt at(gathered.mesh, on, output_.empty());
    std::vector<outputs::DiagramPoint> diagram;
    detail::together(session.ranks(), [&] {
      const Stopwatch watch(session.report().seconds.run);
      diagram = outputs::persistence_diagram(gathered.highest, gathered.pairs, at.field(), least);
    });
    tell(outputs::counts_of(diagram), on.mesh.dimension(), session);
    session.write(output_, [&](const io::AtomicFile& file) {
      io::write_lines(file, outputs::to_lines(at.dataset(), at.field(), diagram, gathered.mesh.exchange()));
    });
    session.write(curve_, [&](const io::AtomicFile& file) {
      write_table(file, outputs::curve_table(outputs::persistence_curve(diagram)));
    });
    session.write(render_, [&](const io::AtomicFile& file) { draw(file, plot_of(diagram, on.field.name)); });
  }

  std::string output_, curve_, render_;
};

}  // namespace

std::unique_ptr<Command> add_persistence_diagram(CLI::App& app) {
  return std::make_unique<FindPersistenceDiagram>(app);
}

}  // namespace gale::app
