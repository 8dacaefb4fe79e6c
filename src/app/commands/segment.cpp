#include <algorithm>

#include <gale/app/commands/commands.hpp>
#include <gale/app/session.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

/// The segment of each input vertex.
std::vector<std::int32_t> segments_of(const Mesh& mesh) {
  std::vector<std::int32_t> segments(mesh.vertices());
  const auto& begin = mesh.vertex_begin();
  const auto& input = mesh.vertex_input();
  for (Id s = 0; s < mesh.segments(); ++s) {
    for (Id v = begin(s); v < begin(s + 1); ++v) segments[input(v)] = s;
  }
  return segments;
}

void tell(const Mesh& mesh, Session& session) {
  const auto& begin = mesh.vertex_begin();
  Id smallest = mesh.vertices(), largest = 0;
  for (Id s = 0; s < mesh.segments(); ++s) {
    smallest = std::min(smallest, begin(s + 1) - begin(s));
    largest = std::max(largest, begin(s + 1) - begin(s));
  }
  const auto external = mesh.external_begin()(mesh.segments());
  const double mean = static_cast<double>(mesh.vertices()) / mesh.segments();
  session.console().say("vertices each", grouped(smallest) + " to " + grouped(largest));
  session.console().say("external", grouped(external) + " tetrahedra");
  session.report().result = {
      {"smallest", smallest}, {"largest", largest}, {"mean", mean}, {"external_tetrahedra", external}};
}

}  // namespace

void segment(const Options& options) {
  require_extension(options, {".vtu", ".vtk"});
  Session session(options);
  io::Dataset dataset = session.read();
  const Mesh mesh = session.encode(dataset, Session::Keep::tetrahedra);
  tell(mesh, session);
  session.write(options.output, [&](const std::string& path) {
    io::write_mesh(path, dataset, {{segments_name, 1, segments_of(mesh)}});
  });
  session.finish(nullptr);
}

}  // namespace gale::app
