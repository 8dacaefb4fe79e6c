#include <algorithm>

#include <gale/app/commands/morse_smale_files.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/manifolds.hpp>
#include <gale/outputs/mesh_piece.hpp>
#include <gale/outputs/morse_smale.hpp>
#include <gale/outputs/named_simplices.hpp>
#include <gale/outputs/separatrices1.hpp>
#include <gale/outputs/separatrices2.hpp>

namespace gale::app {

namespace {

/// What `make` makes, whose time is added to `seconds`.
template <class Make>
auto timed(double& seconds, const Make& make) {
  const Stopwatch watch(seconds);
  return make();
}

}  // namespace

MorseSmaleFiles::MorseSmaleFiles(const std::string& prefix, const MorseSmaleParts& wanted, const std::string& picture)
    : picture(picture) {
  if (prefix.empty()) return;
  const std::string points = Launch::are_several() ? ".pvtp" : ".vtp", mesh = Launch::are_several() ? ".pvtu" : ".vtu";
  critical_points = prefix + "_critical_points" + points;
  if (wanted.descending_separatrices || wanted.ascending_separatrices || wanted.saddle_connectors)
    separatrices1 = prefix + "_separatrices1" + points;
  if (wanted.separatrices2) separatrices2 = prefix + "_separatrices2" + points;
  if (wanted.descending_manifolds || wanted.ascending_manifolds) segmentation = prefix + "_segmentation" + mesh;
}

std::vector<std::string> MorseSmaleFiles::all() const {
  return {critical_points, separatrices1, separatrices2, segmentation, picture};
}

bool MorseSmaleFiles::any() const {
  const auto files = all();
  return std::any_of(files.begin(), files.end(), [](const std::string& file) { return !file.empty(); });
}

void write(const MorseSmaleFiles& files, const MorseSmaleParts& wanted, const FieldOnMesh& on,
           MorseSmaleComplex& complex, const StructureOption& option, Session& session, Computed& computed) {
  const io::Dataset& dataset = on.dataset;
  const auto connectors = outputs::ends_of(complex.connectors);  // of all, wanted or not: they bound walls
  outputs::leave_out_unwanted(wanted, complex);
  Seconds& seconds = session.report().seconds;
  const NamedSimplices named = timed(seconds.write, [&] { return outputs::named_simplices(complex); });
  const SimplexNumbers numbers = number_simplices(on.mesh, named, session.compute(option, "numbers"), &computed);
  const outputs::KnownSimplices critical =
      timed(seconds.write, [&] { return outputs::known_simplices(complex.gradient, complex.critical, numbers); });
  const io::PointSet points = timed(seconds.write, [&] {
    io::PointSet set = outputs::to_point_set(dataset, critical, on.mesh.exchange());
    set.arrays.push_back(outputs::manifold_sizes(complex));
    return set;
  });
  const io::Surface lines = timed(
      seconds.write, [&] { return outputs::separatrices1(dataset, on.field, complex, named, numbers, critical); });
  session.write_result(files.critical_points, [&]() -> const io::PointSet& { return points; });
  session.write_result(files.separatrices1, [&]() -> const io::Surface& { return lines; });
  session.write_result(files.separatrices2,
                       [&] { return outputs::separatrices2(dataset, on.field, complex, connectors, critical); });
  if (on.mesh.is_part()) {
    session.write_result(files.segmentation, [&] {
      io::MeshPiece piece;
      detail::together(session.ranks(), [&] {
        piece = outputs::piece_of(on.order, dataset, outputs::manifold_arrays(complex), on.has_ids);
      });
      return piece;
    });
    return;
  }
  session.write(files.segmentation,
                [&](const io::AtomicFile& file) { io::write_mesh(file, dataset, outputs::manifold_arrays(complex)); });
  session.write(files.picture, [&](const io::AtomicFile& file) {
    draw(file, picture_of(dataset, on.field, complex, numbers, points, lines));
  });
}

}  // namespace gale::app
