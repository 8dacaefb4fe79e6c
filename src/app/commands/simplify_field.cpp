#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/simplified_field.hpp>

namespace gale::app {

namespace {

void tell(const SimplifiedField& field, const Mesh& mesh, Session& session) {
  const Mesh& named_in = field.excerpt ? *field.excerpt : mesh;
  std::int64_t moved = 0;
  for (const Id v : mesh.owned_vertices()) {
    const Id input = mesh.vertices_in_input()[v];
    moved += named_in.vertex_id(field.value_of[input]) != mesh.vertex_id(input);
  }
  moved = session.ranks().sum(moved);
  session.console().say("minima", grouped(field.minima));
  session.console().say("maxima", grouped(field.maxima));
  session.console().say("moved", grouped(moved) + " vertices");
  if (field.kept_below > 0)
    session.console().say("kept below", grouped(field.kept_below) + " extrema of parts that hang on one vertex");
  session.report().result = {
      {"minima", field.minima}, {"maxima", field.maxima}, {"moved", moved}, {"kept_below", field.kept_below}};
}

class SimplifyField final : public AnalysisCommand {
 public:
  explicit SimplifyField(CLI::App& app) : AnalysisCommand(app, "simplify-field", Works::on_many_ranks) {
    add_persistence();
    add_file("-o,--output", output_, "The mesh with the simplified field and the order of its vertices, NAME_Order: {}",
             io::written_meshes | io::written_pieces);
  }

 private:
  Session::Keep keep() const override { return output_.empty() ? Session::Keep::values : Session::Keep::cells; }

  void warm_up(const VertexOrder& order) const override {
    simplify_field(
        order, [](Id vertex) { return vertex; }, order.mesh().vertices());
  }

  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    const double threshold = threshold_for(on.field);
    const SimplifiedField field = simplify_field(
        on.order, [&](Id vertex) { return outputs::value_at(on.field, vertex); }, threshold,
        session.compute(structure_, "simplified field"), &computed);
    tell(field, on.mesh, session);
    if (output_.empty()) return;
    const OnExcerpt at(field.excerpt ? *field.excerpt : on.mesh, on, true);
    session.write_mesh(output_, on, [&] { return outputs::simplified_arrays(at.field(), field); });
  }

  std::string output_;
};

}  // namespace

std::unique_ptr<Command> add_simplify_field(CLI::App& app) { return std::make_unique<SimplifyField>(app); }

}  // namespace gale::app
