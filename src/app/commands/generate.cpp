#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>

namespace gale::app {

namespace {

class Generate final : public Command {
 public:
  explicit Generate(CLI::App& app) : Command(app, "generate", "Writes the mesh that an input stands for") {
    add_file("-o,--output", output_, ".vtu, .vtk, .vtkhdf or, of triangles, .vtp", {".vtu", ".vtk", ".vtkhdf", ".vtp"})
        ->required();
    add_encoding();
  }

  void run() const override {
    Session session = begin();
    io::Dataset dataset = session.read();
    session.write(output_, [&](const io::AtomicFile& file) { io::write_mesh(file, dataset); });
    session.finish();
  }

 private:
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> add_generate(CLI::App& app) { return std::make_unique<Generate>(app); }

}  // namespace gale::app
