#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/app/commands/commands.hpp>
#include <gale/app/critical_counts.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/app/session.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/separatrices1.hpp>
#include <gale/outputs/separatrices2.hpp>

namespace gale::app {

namespace {

using Json = nlohmann::ordered_json;

/// The files to write; empty where there is nothing to be in them.
struct Files {
  std::string critical_points, separatrices1, separatrices2, segmentation;

  explicit Files(const Options& options) {
    if (options.output.empty()) return;
    const MorseSmaleParts& parts = options.parts;
    critical_points = options.output + "_critical_points.vtp";
    if (parts.descending_separatrices || parts.ascending_separatrices || parts.saddle_connectors)
      separatrices1 = options.output + "_separatrices1.vtp";
    if (parts.separatrices2) separatrices2 = options.output + "_separatrices2.vtp";
    if (parts.descending_manifolds || parts.ascending_manifolds) segmentation = options.output + "_segmentation.vtu";
  }

  std::vector<std::string> all(const std::string& picture) const {
    return {critical_points, separatrices1, separatrices2, segmentation, picture};
  }
};

/// What has to be found for what is wanted: a simplification needs all paths, and the walls' arrays the connectors.
MorseSmaleParts needed_parts(const Options& options) {
  MorseSmaleParts parts = options.parts;
  if (options.persistence) parts.descending_separatrices = parts.ascending_separatrices = true;
  if (options.persistence || parts.separatrices2) parts.saddle_connectors = true;
  return parts;
}

/// Which saddles connectors join, without the way.
Separatrices<TriangleVertices> ends_of(const Separatrices<TriangleVertices>& connectors) {
  Separatrices<TriangleVertices> ends;
  ends.sources = connectors.sources;
  ends.destinations = connectors.destinations;
  return ends;
}

/// Without the separatrices that were found for others alone.
void leave_out_unwanted(const MorseSmaleParts& wanted, MorseSmaleComplex& complex) {
  if (!wanted.descending_separatrices) complex.descending = {};
  if (!wanted.ascending_separatrices) complex.ascending = {};
  if (!wanted.saddle_connectors) complex.connectors = {};
}

/// The complex, found on the structure that --structure names.
class Analysis {
 public:
  Analysis(const FieldOnMesh& input, const io::PointArray& field, Session& session)
      : options_(session.options()),
        session_(session),
        structure_(session.make_structure(input.mesh, morse_smale_relations)) {
    const Stopwatch watch(session.report().seconds.run);
    const DiscreteGradient gradient = find_discrete_gradient(*structure_, input.order, session.sweep("gradient"));
    complex_ = std::make_unique<MorseSmaleComplex>(
        find_morse_smale_complex(*structure_, gradient, needed_parts(options_), session.sweep("complex")));
    if (!options_.persistence) return;
    const Heights heights(input.mesh, input.order, field);
    *complex_ = simplify(
        *complex_, [&](Id vertex) { return heights.value(vertex); }, threshold_of(*options_.persistence, field));
  }

  const Structure& structure() const { return *structure_; }

  /// With what was found for others alone.
  MorseSmaleComplex& complex() { return *complex_; }

  SimplexNumbers number(const NamedSimplices& named) {
    const Stopwatch watch(session_.report().seconds.run);
    return number_simplices(*structure_, named, session_.sweep("numbers"));
  }

 private:
  const Options& options_;
  Session& session_;
  std::unique_ptr<Structure> structure_;
  std::unique_ptr<MorseSmaleComplex> complex_;
};

/// One of several counts, null where it is switched off.
struct Count {
  const char *name, *key;
  bool is_on;
  Id count;
};

/// Says and reports those of one kind.
void tell(const std::string& title, const char* key, const std::vector<Count>& counts, Session& session) {
  Json json;
  std::string said;
  for (const Count& one : counts) {
    json[one.key] = one.is_on ? Json(one.count) : Json(nullptr);
    if (one.is_on) said += (said.empty() ? "" : ", ") + grouped(one.count) + ' ' + one.name;
  }
  if (!said.empty()) session.console().say(title, said);
  session.report().result[key] = json;
}

void tell(const MorseSmaleComplex& complex, Session& session) {
  const MorseSmaleParts& parts = session.options().parts;
  tell(complex.critical, session);
  tell("1-separatrices", "separatrices",
       {{"descending", "descending", parts.descending_separatrices, complex.descending.count()},
        {"ascending", "ascending", parts.ascending_separatrices, complex.ascending.count()},
        {"saddle connectors", "saddle_connectors", parts.saddle_connectors, complex.connectors.count()}},
       session);
  const auto counts = complex.critical.counts();
  tell("manifolds", "manifolds",
       {{"ascending", "ascending", parts.ascending_manifolds, counts[3]},
        {"descending", "descending", parts.descending_manifolds, counts[0]},
        {"Morse-Smale", "morse_smale", parts.ascending_manifolds && parts.descending_manifolds,
         complex.morse_smale_manifolds}},
       session);
}

using Manifold = Array<Id, HostMemory>;

std::vector<Id> to_vector(const Manifold& manifold) { return {manifold.data(), manifold.data() + manifold.extent(0)}; }

/// The manifolds as arrays of the mesh.
std::vector<io::PointArray> segmentation(const MorseSmaleComplex& complex) {
  std::vector<io::PointArray> arrays;
  const auto add = [&](const char* name, const Manifold& manifold) {
    if (manifold.extent(0) != 0) arrays.push_back({name, 1, to_vector(manifold)});
  };
  add("AscendingManifold", complex.ascending_manifold);
  add("DescendingManifold", complex.descending_manifold);
  add("MorseSmaleManifold", complex.morse_smale_manifold);
  return arrays;
}

/// How many vertices are in the manifold of each critical simplex: 0 of saddles, -1 where the manifolds are switched
/// off.
std::vector<Id> manifold_sizes(const MorseSmaleComplex& complex) {
  const auto counts = complex.critical.counts();
  std::vector<Id> sizes;
  const auto add = [&](Id count, const Manifold& manifold) {
    const std::size_t first = sizes.size();
    sizes.resize(first + count, manifold.extent(0) != 0 ? 0 : -1);
    for (std::size_t v = 0; v < manifold.extent(0); ++v) {
      if (manifold(v) != no_id) ++sizes[first + manifold(v)];
    }
  };
  add(counts[0], complex.descending_manifold);
  sizes.resize(sizes.size() + counts[1] + counts[2], 0);
  add(counts[3], complex.ascending_manifold);
  return sizes;
}

io::PointSet with_manifold_sizes(const io::Dataset& dataset, const MorseSmaleComplex& complex,
                                 const KnownSimplices& critical) {
  io::PointSet points = to_point_set(dataset, critical);
  points.arrays.push_back({"ManifoldSize", 1, manifold_sizes(complex)});
  return points;
}

/// What `make` makes, whose time is added to `seconds`.
template <class Make>
auto timed(double& seconds, const Make& make) {
  const Stopwatch watch(seconds);
  return make();
}

void write(const Files& files, const FieldOnMesh& input, const io::PointArray& field, Analysis& analysis,
           Session& session) {
  MorseSmaleComplex& complex = analysis.complex();
  const Heights heights(input.mesh, input.order, field);
  const io::Dataset& dataset = input.dataset;
  const auto connectors = ends_of(complex.connectors);  // of all: they bound walls, wanted or not
  leave_out_unwanted(session.options().parts, complex);
  double& seconds = session.report().seconds.write;
  const NamedSimplices named = timed(seconds, [&] { return named_simplices(complex); });
  const SimplexNumbers numbers = analysis.number(named);
  const KnownSimplices critical =
      timed(seconds, [&] { return known_simplices(complex.gradient, complex.critical, numbers); });
  const io::PointSet points = timed(seconds, [&] { return with_manifold_sizes(dataset, complex, critical); });
  const io::Surface lines =
      timed(seconds, [&] { return separatrices1(dataset, complex, named, numbers, critical, heights); });
  session.write(files.critical_points, [&](const std::string& path) { io::write_points(path, points); });
  session.write(files.separatrices1, [&](const std::string& path) { io::write_surface(path, lines); });
  session.write(files.separatrices2, [&](const std::string& path) {
    io::write_surface(path, separatrices2(dataset, complex, connectors, critical, heights));
  });
  session.write(files.segmentation,
                [&](const std::string& path) { io::write_mesh(path, dataset, segmentation(complex)); });
  session.write(session.options().render, [&](const std::string& path) {
    draw(path, picture_of(dataset, complex, numbers, points, lines, heights));
  });
}

void require_png(const std::string& file) {
  const std::string extension = file.size() > 4 ? file.substr(file.size() - 4) : "";
  if (extension != ".png" && extension != ".PNG")
    throw UsageError("--render " + file + ": gale morse-smale draws .png");
}

}  // namespace

void morse_smale(const Options& options) {
  if (!options.render.empty()) {
    require_png(options.render);
    require_drawing();
  }
  const Files files(options);
  Session session(options, files.all(options.render));
  const FieldOnMesh input =
      session.read_field(files.segmentation.empty() ? Session::Keep::nothing : Session::Keep::tetrahedra);
  const io::PointArray field = select_field(input.dataset, options.array);
  Analysis analysis(input, field, session);
  tell(analysis.complex(), session);
  if (!options.output.empty() || !options.render.empty()) write(files, input, field, analysis, session);
  session.finish(&analysis.structure());
}

}  // namespace gale::app
