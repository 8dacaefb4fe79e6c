#include <CLI/CLI.hpp>

#include <gale/app/commands/commands.hpp>
#include <gale/app/critical_counts.hpp>
#include <gale/app/session.hpp>
#include <gale/outputs/critical_points.hpp>

namespace gale::app {

namespace {

class FindCriticalPoints final : public Command {
 public:
  explicit FindCriticalPoints(CLI::App& app)
      : Command(app, outputs::analysis_named("critical-points"), Works::on_many_ranks) {
    segmentation_.add_to(subcommand());
    structure_.add_to(subcommand());
    structure_.add_consumers_to(subcommand());
    subcommand().add_option("-o,--output", output_,
                            "The critical points: .vtp; on several ranks .pvtp, with a .vtp a rank");
    add_encoding();
  }

  void run() const override {
    structure_.require_consumers();
    require_points_extension("--output", output_);
    Session session(input(), common(), {output_});
    session.warm_up(structure_, [](const VertexOrder& order) { find_critical_points(order); });
    const FieldOnMesh on = session.read_field(segmentation_);
    Computed computed;
    const CriticalPoints points =
        find_critical_points(on.order, session.compute(structure_, "critical points"), &computed);
    tell_points(points.counts, session);
    session.write_result(output_, [&] { return outputs::to_point_set(on.dataset, points, on.mesh.exchange()); });
    session.finish(structure_, computed);
  }

 private:
  SegmentationOptions segmentation_;
  StructureOption structure_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> add_critical_points(CLI::App& app) { return std::make_unique<FindCriticalPoints>(app); }

}  // namespace gale::app
