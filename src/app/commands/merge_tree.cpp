#include <array>

#include <CLI/CLI.hpp>

#include <gale/algorithms/surface_vertices.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/app/drawing/drawer.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/merge_tree.hpp>

namespace gale::app {

namespace {

void tell(const MergeTree& tree, int top, Session& session) {
  std::array<std::int64_t, 5> counts{};
  for (const CriticalType type : tree.types) ++counts[static_cast<int>(type)];
  session.tell("nodes", "nodes", static_cast<std::int64_t>(tree.vertices.size()));
  session.tell("arcs", "arcs", static_cast<std::int64_t>(tree.arcs.size()));
  tell_types(counts, top, session);
}

class FindMergeTree final : public AnalysisCommand {
 public:
  explicit FindMergeTree(CLI::App& app) : AnalysisCommand(app, "merge-tree", Works::on_many_ranks) {
    const outputs::AnalysisOption& type = analysis_.option("type");
    type_ = type.choices.front();
    subcommand().add_option("--type", type_, type.help)->check(CLI::IsMember(type.choices));
    add_persistence();
    subcommand()
        .add_option("--arc-samples", arc_samples_, analysis_.option("arc_samples").help)
        ->check(CLI::Range(0, 1000));
    subcommand()
        .add_option("-o,--output", output_, "Write P_nodes.vtp, P_arcs.vtp and P_segmentation.vtu")
        ->type_name("P");
    add_format();
    add_render(render_, "Draw the tree, beside the mesh in the colours of its arcs, to this {}");
  }

 private:
  std::vector<std::string> more_files() const override {
    if (output_.empty()) return {"", "", ""};
    return {with_extension(output_ + "_nodes", io::written_points, false),
            with_extension(output_ + "_arcs", io::written_surfaces, false),
            with_extension(output_ + "_segmentation", io::written_meshes | io::written_pieces)};
  }

  void require_usage() const override { require_format(); }

  Session::Keep keep() const override {
    if (!output_.empty()) return Session::Keep::cells;
    return persistence_ ? Session::Keep::values : Session::Keep::nothing;
  }

  void warm_up(const VertexOrder& order) const override { find_merge_tree(order, outputs::tree_named(type_)); }

  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    MergeTreeOptions options;
    static_cast<ComputeOptions&>(options) = session.compute(structure_, "merge tree");
    options.threshold = threshold_for(on.field);
    const MergeTree tree = find(on, options, computed);
    tell(tree, on.mesh.dimension(), session);
    if (!output_.empty()) write(on, tree, session);
    if (render_.empty()) return;
    const FieldOnMesh whole = session.whole(on);
    session.write(render_, [&](const io::AtomicFile& file) {
      Computed again;
      const MergeTree drawn = Launch::are_several() ? find(whole, options, again) : tree;
      draw(file, picture_of(whole.dataset, whole.field, whole.mesh, drawn, type_, surface_vertices(whole.mesh)));
    });
  }

  void write(const FieldOnMesh& on, const MergeTree& tree, Session& session) const {
    const std::vector<std::string> files = more_files();
    const OnExcerpt at(tree.excerpt ? *tree.excerpt : on.mesh, on);
    session.write(files[0], [&](const io::AtomicFile& to) {
      io::write_points(to, outputs::tree_nodes(at.dataset(), at.field(), tree));
    });
    const auto gathered = outputs::gather_arc_vertices(on.mesh, on.dataset, on.field, tree, arc_samples_);
    session.write(files[1], [&](const io::AtomicFile& to) {
      io::write_surface(to, outputs::tree_arcs(at.dataset(), at.field(), tree, arc_samples_, gathered));
    });
    session.write_mesh(files[2], on, [&] { return outputs::tree_segmentation(at.dataset(), tree); });
  }

  MergeTree find(const FieldOnMesh& on, MergeTreeOptions options, Computed& computed) const {
    options.value = [&](Id vertex) { return outputs::value_at(on.field, vertex); };
    return find_merge_tree(on.order, outputs::tree_named(type_), options, &computed);
  }

  std::string type_;
  int arc_samples_ = 0;
  std::string output_, render_;
};

}  // namespace

std::unique_ptr<Command> add_merge_tree(CLI::App& app) { return std::make_unique<FindMergeTree>(app); }

}  // namespace gale::app
