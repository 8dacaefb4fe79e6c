#include <algorithm>

#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/outputs/segmentation.hpp>

namespace gale::app {

namespace {

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

class Segment final : public Command {
 public:
  explicit Segment(CLI::App& app) : Command(app, "segment", "Divides a mesh into segments") {
    segmentation_.add_to(subcommand());
    add_file("-o,--output", output_, "The mesh with its segments as a point array: {}", io::written_meshes);
    add_encoding();
  }

  void run() const override {
    Session session = begin();
    io::Dataset dataset = session.read();
    io::write_out_cells(dataset);  // the segments of a grid are its own alone: others want those of an octree
    const Mesh mesh = session.encode(dataset, segmentation_, Session::Keep::cells);
    tell(mesh, session);
    session.write(output_,
                  [&](const io::AtomicFile& file) { io::write_mesh(file, dataset, {outputs::segments_of(mesh)}); });
    session.finish();
  }

 private:
  SegmentationOptions segmentation_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> add_segment(CLI::App& app) { return std::make_unique<Segment>(app); }

}  // namespace gale::app
