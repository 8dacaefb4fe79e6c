#include <array>

#include <CLI/CLI.hpp>

#include <gale/algorithms/surface_vertices.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/merge_tree.hpp>

namespace gale::app {

namespace {

void tell(const MergeTree& tree, Session& session) {
  std::array<std::int64_t, 5> counts{};
  for (const CriticalType type : tree.types) ++counts[static_cast<int>(type)];
  session.tell("nodes", "nodes", static_cast<std::int64_t>(tree.vertices.size()));
  session.tell("arcs", "arcs", static_cast<std::int64_t>(tree.arcs.size()));
  tell_types(counts, session);
}

class FindMergeTree final : public Command {
 public:
  explicit FindMergeTree(CLI::App& app) : Command(app, "merge-tree", outputs::analysis_named("merge-tree").help) {
    segmentation_.add_to(subcommand());
    structure_.add_to(subcommand());
    const outputs::AnalysisOption& type = analysis_.option("type");
    type_ = type.choices.front();
    subcommand().add_option("--type", type_, type.help)->check(CLI::IsMember(type.choices));
    add_persistence(subcommand(), persistence_, analysis_.option("persistence").help);
    subcommand()
        .add_option("--arc-samples", arc_samples_, analysis_.option("arc_samples").help)
        ->check(CLI::Range(0, 1000));
    subcommand()
        .add_option("-o,--output", output_, "Write P_nodes.vtp, P_arcs.vtp and P_segmentation.vtu")
        ->type_name("P");
    add_file("--render", render_, "Draw the tree, beside the mesh in the colours of its arcs, to this .png", {".png"})
        ->type_name("FILE.png");
    add_encoding();
  }

  void run() const override {
    const auto file = [&](const char* end) { return output_.empty() ? output_ : output_ + end; };
    const std::string nodes = file("_nodes.vtp"), arcs = file("_arcs.vtp"), segmentation = file("_segmentation.vtu");
    Session session = begin({nodes, arcs, segmentation});
    const FieldOnMesh on =
        session.read_field(segmentation_, output_.empty() ? Session::Keep::nothing : Session::Keep::tetrahedra);
    Computed computed;
    const MergeTree tree = find(on, session, computed);
    tell(tree, session);
    session.write_result(nodes, [&] { return outputs::tree_nodes(on.dataset, on.field, tree); });
    session.write_result(arcs, [&] { return outputs::tree_arcs(on.dataset, on.field, tree, arc_samples_); });
    session.write(segmentation, [&](const io::AtomicFile& to) {
      io::write_mesh(to, on.dataset, outputs::tree_segmentation(on.dataset, tree));
    });
    session.write(render_, [&](const io::AtomicFile& file) {
      draw(file, picture_of(on.dataset, on.field, on.mesh, tree, type_, surface_vertices(on.mesh)));
    });
    session.finish(structure_, computed);
  }

 private:
  MergeTree find(const FieldOnMesh& on, const Session& session, Computed& computed) const {
    MergeTreeOptions options;
    static_cast<ComputeOptions&>(options) = session.compute(structure_, "merge tree");
    options.value = [&](Id vertex) { return outputs::value_at(on.field, vertex); };
    if (persistence_) options.threshold = threshold_of_option(*persistence_, on.field);
    return find_merge_tree(on.order, outputs::tree_named(type_), options, &computed);
  }

  const outputs::Analysis& analysis_ = outputs::analysis_named("merge-tree");
  SegmentationOptions segmentation_;
  StructureOption structure_;
  std::string type_;
  std::optional<outputs::Persistence> persistence_;
  int arc_samples_ = 0;
  std::string output_, render_;
};

}  // namespace

std::unique_ptr<Command> add_merge_tree(CLI::App& app) { return std::make_unique<FindMergeTree>(app); }

}  // namespace gale::app
