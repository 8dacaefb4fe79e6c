#include <CLI/CLI.hpp>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/commands/commands.hpp>
#include <gale/app/commands/morse_smale_files.hpp>
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

using Json = nlohmann::ordered_json;

/// How many there are of something; reported as null where that is switched off.
struct Count {
  const char *name, *key;
  bool is_on;
  std::int64_t count;
};

/// Says the counts of one kind in one line, and reports them under `key`.
void tell(const std::string& title, const char* key, const std::vector<Count>& counts, Session& session) {
  Json json = Json::object();  // at once: the library crashes where memory for a later one lacks
  std::string said;
  for (const Count& one : counts) {
    json[one.key] = one.is_on ? Json(one.count) : Json(nullptr);
    if (one.is_on) said += (said.empty() ? "" : ", ") + grouped(one.count) + ' ' + one.name;
  }
  if (!said.empty()) session.console().say(title, said);
  session.report().result[key] = json;
}

void tell(const MorseSmaleComplex& complex, const MorseSmaleParts& wanted, Session& session) {
  const auto here = complex.critical.counts();
  std::array<std::int64_t, 4> critical{here[0], here[1], here[2], here[3]};
  std::int64_t paths[] = {complex.descending.count(), complex.ascending.count(), complex.connectors.count()};
  session.ranks().sum(critical.data(), 4);
  session.ranks().sum(paths, 3);
  tell_simplices(critical, session);
  tell("1-separatrices", "separatrices",
       {{"descending", "descending", wanted.descending_separatrices, paths[0]},
        {"ascending", "ascending", wanted.ascending_separatrices, paths[1]},
        {"saddle connectors", "saddle_connectors", wanted.saddle_connectors, paths[2]}},
       session);
  tell("manifolds", "manifolds",
       {{"ascending", "ascending", wanted.ascending_manifolds, critical[3]},
        {"descending", "descending", wanted.descending_manifolds, critical[0]},
        {"Morse-Smale", "morse_smale", wanted.ascending_manifolds && wanted.descending_manifolds,
         complex.morse_smale_manifolds}},
       session);
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
  explicit FindMorseSmale(CLI::App& app) : Command(app, outputs::analysis_named("morse-smale"), Works::on_many_ranks) {
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

  void run() const override {
    structure_.require_consumers();
    refuse_whole();
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
  /// On several ranks, what follows walls or pairs is refused: both want the whole mesh.
  void refuse_whole() const {
    if (Launch::are_several() && parts_.saddle_connectors) {
      throw UsageError(
          "saddle connectors: not on several ranks, where walls can't be followed: switch them off by "
          "--no-saddle-connectors");
    }
    refuse_on_ranks({{"--separatrices2", parts_.separatrices2},
                     {"--persistence", bool(persistence_)},
                     {"--extrema-only", extrema_only_},
                     {"--render", !render_.empty()}});
  }

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
