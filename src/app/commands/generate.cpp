#include <gale/app/commands/commands.hpp>
#include <gale/app/session.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

void generate(const Options& options) {
  require_extension(options, {".vtu", ".vtk"});
  Session session(options);
  const io::Dataset dataset = session.read();
  session.write(options.output, [&](const std::string& path) { io::write_mesh(path, dataset); });
  session.finish(nullptr);
}

}  // namespace gale::app
