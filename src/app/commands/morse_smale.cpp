#include <CLI/CLI.hpp>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/commands/commands.hpp>
#include <gale/app/commands/morse_smale_files.hpp>
#include <gale/app/complex_counts.hpp>
#include <gale/app/critical_counts.hpp>
#include <gale/app/drawing/scene.hpp>
#include <gale/app/options/persistence_option.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/app/session.hpp>
#include <gale/app/usage_error.hpp>
#include <gale/base/error.hpp>
#include <gale/outputs/morse_smale.hpp>

namespace gale::app {

namespace {

void tell(const MorseSmaleComplex& complex, const MorseSmaleParts& parts, Session& session) {
  tell(complex.critical, session);
  const auto critical = complex.critical.counts();
  tell({complex.descending.count(), complex.ascending.count(), complex.connectors.count(), critical[3], critical[0],
        complex.morse_smale_manifolds},
       parts, session.console(), session.report());
}

/// How many pairs are left although their persistence is below the threshold.
void tell(const KeptBelow& kept, Session& session) {
  if (kept.count() != 0) {
    session.console().say(
        "kept below", grouped(kept.count()) + " pairs of saddles below the threshold: " + grouped(kept.several_paths) +
                          " with several paths between them, " + grouped(kept.no_path) + " with none");
  }
  session.report().result["kept_below"] = {{"several_paths", kept.several_paths}, {"no_path", kept.no_path}};
}

void require_png(const std::string& file) {
  const std::string extension = file.size() > 4 ? file.substr(file.size() - 4) : "";
  if (extension != ".png" && extension != ".PNG")
    throw UsageError("--render " + file + ": gale morse-smale draws .png");
}

/// Finds the complex of a tiny mesh.
void find_small_complex(const VertexOrder& order) { find_morse_smale_complex(find_discrete_gradient(order)); }

class FindMorseSmale final : public Command {
 public:
  explicit FindMorseSmale(CLI::App& app) : Command(app, outputs::analysis_named("morse-smale")) {
    segmentation_.add_to(subcommand());
    structure_.add_to(subcommand());
    structure_.add_consumers_to(subcommand());
    subcommand()
        .add_option("-o,--output", output_,
                    "Write P_critical_points.vtp, P_separatrices1.vtp, P_segmentation.vtu and, if wanted, "
                    "P_separatrices2.vtp; on several ranks .pvtp and .pvtu, with a piece a rank")
        ->type_name("P");
    add_encoding();
    add_parts();
    add_persistence(subcommand(), persistence_, analysis_.option("persistence").help);
    add_flag(analysis_.option("extrema_only"), extrema_only_);
    subcommand()
        .add_option(
            "--render", render_,
            "Draw the complex to this .png: an octant cut out of the segmented mesh, and there the 1-separatrices")
        ->type_name("FILE.png");
  }

  /// On several ranks, what follows walls or pairs is refused: both want the whole mesh.
  void run_on_ranks() const override {
    structure_.require_consumers();
    if (parts_.saddle_connectors) {
      throw UsageError(
          "saddle connectors: not on several ranks, where walls can't be followed: switch them off by "
          "--no-saddle-connectors");
    }
    for (const auto& [option, is_given] :
         {std::make_pair("--separatrices2", parts_.separatrices2), std::make_pair("--persistence", bool(persistence_)),
          std::make_pair("--extrema-only", extrema_only_), std::make_pair("--render", !render_.empty())}) {
      if (is_given) throw UsageError(std::string(option) + ": not on several ranks");
    }
    morse_smale_on_ranks(input(), common(), segmentation_, structure_, parts_, output_);
  }

  void run() const override {
    structure_.require_consumers();
    if (extrema_only_ && !persistence_) throw UsageError("--extrema-only: it goes with --persistence");
    if (!render_.empty()) {
      require_png(render_);
      require_drawing();
    }
    const MorseSmaleFiles files(output_, parts_, render_);
    Session session(input(), common(), files.all());
    session.warm_up(structure_, find_small_complex);
    const FieldOnMesh on = session.read_field(
        segmentation_, files.segmentation.empty() ? Session::Keep::nothing : Session::Keep::tetrahedra);
    Computed computed;
    const DiscreteGradient gradient =
        find_discrete_gradient(on.order, session.compute(structure_, "gradient"), &computed);
    MorseSmaleComplex complex = find(gradient, on, session, computed);
    tell(complex, parts_, session);
    if (persistence_) tell(complex.kept_below, session);
    if (files.any()) write(files, parts_, on, complex, structure_, session, computed);
    session.finish(structure_, computed);
  }

 private:
  void add_parts() {
    for (const outputs::PartOfComplex& part : outputs::parts_of_complexes)
      add_flag(analysis_.option(part.option), parts_.*part.is_wanted);
  }

  /// The complex, simplified if that is wanted, with the needed parts.
  MorseSmaleComplex find(const DiscreteGradient& gradient, const FieldOnMesh& on, Session& session,
                         Computed& computed) const {
    outputs::MorseSmaleRequest request{parts_, persistence_, extrema_only_};
    if (persistence_) request.persistence = outputs::Persistence{threshold_of_option(*persistence_, on.field), false};
    return outputs::find_complex(gradient, on.field, request, session.compute(structure_, "complex"), &computed);
  }

  const outputs::Analysis& analysis_ = outputs::analysis_named("morse-smale");
  SegmentationOptions segmentation_;
  StructureOption structure_;
  MorseSmaleParts parts_;  ///< that are wanted
  std::optional<outputs::Persistence> persistence_;
  bool extrema_only_ = false;
  std::string output_, render_;
};

}  // namespace

std::unique_ptr<Command> add_morse_smale(CLI::App& app) { return std::make_unique<FindMorseSmale>(app); }

}  // namespace gale::app
