#include <gale/app/complex_counts.hpp>
#include <gale/app/critical_counts.hpp>
#include <gale/app/ranks/complex_pieces.hpp>
#include <gale/app/ranks/rank_session.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/distributed/together.hpp>

namespace gale::app {

namespace {

/// The parts that were wanted; the others are empty.
struct Complex {
  DistributedGradient gradient;
  DistributedSeparatrices descending, ascending;
  DistributedManifolds manifolds;
};

bool any_separatrices(const MorseSmaleParts& wanted) {
  return wanted.descending_separatrices || wanted.ascending_separatrices;
}

bool any_manifolds(const MorseSmaleParts& wanted) { return wanted.descending_manifolds || wanted.ascending_manifolds; }

Complex find_parts(const DistributedGradient& gradient, const MorseSmaleParts& wanted, RankSession& session) {
  const Stopwatch watch(session.report().seconds.run);
  begin_step("following paths");
  Complex complex{gradient, {}, {}, {}};
  if (wanted.descending_separatrices) complex.descending = find_descending_separatrices(gradient);
  if (wanted.ascending_separatrices) complex.ascending = find_ascending_separatrices(gradient);
  if (any_manifolds(wanted)) complex.manifolds = find_manifolds(gradient);
  return complex;
}

void tell(const Complex& complex, const MorseSmaleParts& wanted, RankSession& session) {
  const auto& counts = complex.gradient.counts;
  tell_simplices({counts.begin(), counts.end()}, session.console(), session.report());
  std::int64_t paths[] = {complex.descending.count(), complex.ascending.count()};
  session.ranks().sum(paths, 2);
  app::tell({paths[0], paths[1], 0, counts[3], counts[0], complex.manifolds.morse_smale_manifolds}, wanted,
            session.console(), session.report());
}

/// The files that begin with a prefix; a name is empty where nothing would be in it.
struct Files {
  std::string critical_points, separatrices1, segmentation;

  Files(const std::string& prefix, const MorseSmaleParts& wanted) {
    if (prefix.empty()) return;
    critical_points = prefix + "_critical_points.pvtp";
    if (any_separatrices(wanted)) separatrices1 = prefix + "_separatrices1.pvtp";
    if (any_manifolds(wanted)) segmentation = prefix + "_segmentation.pvtu";
  }
};

void write(const Files& files, const FieldOnRanks& on, const Complex& complex, const MorseSmaleParts& wanted,
           const StructureOption& structure, RankSession& session) {
  DistributedNamedSimplices named = named_simplices(complex.gradient);
  append(complex.descending, complex.ascending, named);
  const DistributedNumbers numbers = session.number(structure, on.mesh, named);
  io::PointSet points = to_point_set(on, complex.gradient, numbers);
  points.arrays.push_back(manifold_sizes(complex.gradient, complex.manifolds, wanted));
  session.write_pieces(files.critical_points, points);
  if (!files.separatrices1.empty()) {
    session.write_pieces(files.separatrices1,
                         separatrices1(on, complex.gradient, complex.descending, complex.ascending, numbers));
  }
  if (files.segmentation.empty()) return;
  io::MeshPiece piece;
  detail::together(session.ranks(), [&] { piece = segmentation(on, complex.manifolds, wanted); });
  session.write_pieces(files.segmentation, piece);
}

}  // namespace

void morse_smale_on_ranks(const InputOptions& input, const CommonOptions& common,
                          const SegmentationOptions& segmentation, const StructureOption& structure,
                          const MorseSmaleParts& wanted, const std::string& prefix) {
  const Files files(prefix, wanted);
  RankSession session(input, common, {files.critical_points, files.separatrices1, files.segmentation});
  const FieldOnRanks on = session.read_field(segmentation);
  const DistributedGradient gradient = session.find_gradient(structure, on);
  const Complex complex = find_parts(gradient, wanted, session);
  tell(complex, wanted, session);
  if (!prefix.empty()) write(files, on, complex, wanted, structure, session);
  session.finish(on.mesh);
}

}  // namespace gale::app
