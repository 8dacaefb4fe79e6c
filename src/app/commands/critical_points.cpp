#include <CLI/CLI.hpp>

#include <gale/algorithms/critical_points.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/outputs/critical_points.hpp>

namespace gale::app {

namespace {

class FindCriticalPoints final : public AnalysisCommand {
 public:
  explicit FindCriticalPoints(CLI::App& app) : AnalysisCommand(app, "critical-points", Works::on_many_ranks) {
    add_file("-o,--output", output_, "The critical points: {}", io::written_points);
  }

 private:
  void warm_up(const VertexOrder& order) const override { find_critical_points(order); }

  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    const CriticalPoints points =
        find_critical_points(on.order, session.compute(structure_, "critical points"), &computed);
    tell_types(points.counts, on.mesh.dimension(), session);
    session.write_result(output_, [&] { return outputs::to_point_set(on.dataset, points, on.mesh.exchange()); });
  }

  std::string output_;
};

}  // namespace

std::unique_ptr<Command> add_critical_points(CLI::App& app) { return std::make_unique<FindCriticalPoints>(app); }

}  // namespace gale::app
