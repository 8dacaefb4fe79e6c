#include <CLI/CLI.hpp>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/app/drawing/drawer.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/outputs/manifolds.hpp>
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
  const auto here = complex.own_counts();
  std::array<std::int64_t, 4> critical{here[0], here[1], here[2], here[3]};
  std::int64_t paths[] = {complex.descending.count(), complex.ascending.count(), complex.connectors.count()};
  session.ranks().sum(critical.data(), 4);
  session.ranks().sum(paths, 3);
  const int top = complex.critical.dimension;
  tell_simplices(critical, top, session);
  tell("1-separatrices", "separatrices",
       {{"descending", "descending", wanted.descending_separatrices, paths[0]},
        {"ascending", "ascending", wanted.ascending_separatrices, paths[1]},
        {"saddle connectors", "saddle_connectors", wanted.saddle_connectors, paths[2]}},
       session);
  tell("manifolds", "manifolds",
       {{"ascending", "ascending", wanted.ascending_manifolds, critical[top]},
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

/// The files of the command but for the picture. A name is empty where the file isn't wanted or nothing would be in it.
struct ComplexFiles {
  std::string critical_points, separatrices1, separatrices2, segmentation;
};

class FindMorseSmale final : public AnalysisCommand {
 public:
  explicit FindMorseSmale(CLI::App& app) : AnalysisCommand(app, "morse-smale", Works::on_many_ranks) {
    subcommand()
        .add_option("-o,--output", output_,
                    "Write P_critical_points.vtp, P_separatrices1.vtp, P_segmentation.vtu and, if wanted, "
                    "P_separatrices2.vtp; on several ranks .pvtp and .pvtu, with a piece a rank")
        ->type_name("P");
    add_format();
    for (const outputs::PartOfComplex& part : outputs::parts_of_complexes)
      add_flag(part.option, parts_.*part.is_wanted);
    add_persistence();
    add_flag("extrema_only", extrema_only_);
    add_render(render_,
               "Draw the complex to this {}: an octant cut out of the segmented mesh, and there the 1-separatrices");
  }

 private:
  /// Names the files for the parts that are wanted, none without -o.
  ComplexFiles files() const {
    if (output_.empty()) return {};
    const auto name = [&](bool is_wanted, const char* what, unsigned written) {
      return is_wanted ? with_extension(output_ + what, written) : "";
    };
    return {name(true, "_critical_points", io::written_points),
            name(parts_.descending_separatrices || parts_.ascending_separatrices || parts_.saddle_connectors,
                 "_separatrices1", io::written_surfaces),
            name(parts_.separatrices2, "_separatrices2", io::written_surfaces),
            name(parts_.descending_manifolds || parts_.ascending_manifolds, "_segmentation",
                 io::written_meshes | io::written_pieces)};
  }

  std::vector<std::string> more_files() const override {
    const ComplexFiles all = files();
    return {all.critical_points, all.separatrices1, all.separatrices2, all.segmentation};
  }

  Session::Keep keep() const override {
    if (!files().segmentation.empty()) return Session::Keep::cells;
    return persistence_ ? Session::Keep::values : Session::Keep::nothing;
  }

  void warm_up(const VertexOrder& order) const override { find_morse_smale_complex(find_discrete_gradient(order)); }

  void require_usage() const override {
    require_format();
    if (extrema_only_ && !persistence_) throw UsageError("--extrema-only: it goes with --persistence");
  }

  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    const ComputeOptions options = session.compute(structure_, "complex");
    outputs::MorseSmaleRequest request{parts_, persistence_, extrema_only_};
    if (persistence_) request.persistence = outputs::Persistence{threshold_for(on.field), false};
    MorseSmaleComplex complex = find(on, request, options, computed);
    tell(complex, parts_, session);
    if (persistence_) tell(complex.kept_below, session);
    if (output_.empty() && (render_.empty() || Launch::are_several())) return draw_whole(on, request, options, session);
    const outputs::ShownComplex shown(complex, parts_, on.dataset, on.field, options, computed,
                                      session.report().seconds.write);
    write(on, shown, session);
    if (Launch::are_several()) return draw_whole(on, request, options, session);
    session.write(render_, [&](const io::AtomicFile& file) { draw(file, picture(on, shown)); });
  }

  /// Draws on the first rank of several, where all is gathered and found again.
  void draw_whole(const FieldOnMesh& on, const outputs::MorseSmaleRequest& request, const ComputeOptions& options,
                  Session& session) const {
    if (render_.empty()) return;
    const FieldOnMesh whole = session.whole(on);
    session.write(render_, [&](const io::AtomicFile& file) {
      Computed computed;
      double seconds = 0;
      MorseSmaleComplex complex = find(whole, request, options, computed);
      draw(file, picture(whole, outputs::ShownComplex(complex, parts_, whole.dataset, whole.field, options, computed,
                                                      seconds)));
    });
  }

  static Scene picture(const FieldOnMesh& on, const outputs::ShownComplex& shown) {
    return picture_of(on.dataset, on.field, shown.complex, shown.numbers, shown.critical_points, shown.separatrices1);
  }

  /// The complex, simplified if that is wanted, with the needed parts.
  static MorseSmaleComplex find(const FieldOnMesh& on, const outputs::MorseSmaleRequest& request,
                                const ComputeOptions& options, Computed& computed) {
    return outputs::find_complex(find_discrete_gradient(on.order, options, &computed), on.field, request, options,
                                 &computed);
  }

  void write(const FieldOnMesh& on, const outputs::ShownComplex& shown, Session& session) const {
    const ComplexFiles to = files();
    session.write_result(to.critical_points, [&]() -> const io::PointSet& { return shown.critical_points; });
    session.write_result(to.separatrices1, [&]() -> const io::Surface& { return shown.separatrices1; });
    session.write_result(to.separatrices2, [&] { return shown.separatrices2(); });
    session.write_mesh(to.segmentation, on, [&] { return outputs::manifold_arrays(shown.complex); });
  }

  MorseSmaleParts parts_;  ///< that are wanted
  bool extrema_only_ = false;
  std::string output_, render_;
};

}  // namespace

std::unique_ptr<Command> add_morse_smale(CLI::App& app) { return std::make_unique<FindMorseSmale>(app); }

}  // namespace gale::app
