#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/simplified_field.hpp>

namespace gale::app {

namespace {

void tell(const SimplifiedField& field, Session& session) {
  Id moved = 0;
  for (std::size_t v = 0; v < field.value_of.size(); ++v) moved += field.value_of[v] != static_cast<Id>(v);
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
  explicit SimplifyField(CLI::App& app) : AnalysisCommand(app, "simplify-field") {
    add_persistence(subcommand(), persistence_, analysis_.option("persistence").help);
    add_file("-o,--output", output_,
             "The mesh with the simplified field and the order of its vertices, NAME_Order: .vtu or .vtk",
             {".vtu", ".vtk"});
  }

 private:
  Session::Keep keep() const override { return output_.empty() ? Session::Keep::nothing : Session::Keep::cells; }

  void warm_up(const VertexOrder& order) const override {
    simplify_field(
        order, [](Id vertex) { return vertex; }, order.mesh().vertices());
  }

  void analyse(const FieldOnMesh& on, Session& session, Computed& computed) const override {
    const double threshold = persistence_ ? threshold_of_option(*persistence_, on.field, session.ranks()) : 0;
    const SimplifiedField field = simplify_field(
        on.order, [&](Id vertex) { return outputs::value_at(on.field, vertex); }, threshold,
        session.compute(structure_, "simplified field"), &computed);
    tell(field, session);
    session.write(output_, [&](const io::AtomicFile& file) {
      io::write_mesh(file, on.dataset, outputs::simplified_arrays(on.field, field));
    });
  }

  std::optional<outputs::Persistence> persistence_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> add_simplify_field(CLI::App& app) { return std::make_unique<SimplifyField>(app); }

}  // namespace gale::app
