#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/io/bytes/text.hpp>

namespace gale::app {

namespace {

class Generate final : public Command {
 public:
  explicit Generate(CLI::App& app) : Command(app, "generate", "Writes the mesh that an input stands for") {
    constexpr unsigned all = io::written_meshes | io::written_triangles;
    add_file("-o,--output", output_,
             io::detail::joined(io::extensions_written(io::written_meshes), ", ") + " or, of triangles, " +
                 io::extensions_written(all).back(),
             all)
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
