#include <CLI/CLI.hpp>

#include <gale/app/commands/commands.hpp>
#include <gale/app/session.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

namespace {

class Generate final : public Command {
 public:
  explicit Generate(CLI::App& app) : Command(app, "generate", "Writes the tetrahedral mesh that an input stands for") {
    subcommand().add_option("-o,--output", output_, ".vtu or .vtk")->required();
    add_encoding();
  }

  void run() const override {
    require_extension("--output", output_, {".vtu", ".vtk"});
    Session session(input(), common(), {output_});
    const io::Dataset dataset = session.read();
    session.write(output_, [&](const io::AtomicFile& file) { io::write_mesh(file, dataset); });
    session.finish();
  }

 private:
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> add_generate(CLI::App& app) { return std::make_unique<Generate>(app); }

}  // namespace gale::app
