#pragma once

#include <DiscreteGradient.h>
#include <DiscreteMorseSandwich.h>
#include <ExTreeM.h>
#include <JacobiSet.h>
#include <MorseSmaleComplex.h>
#include <PathCompression.h>
#include <ScalarFieldCriticalPoints.h>
#include <ScalarFieldSmoother.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gale/ttk/essential_pairs.hpp>

#include "contour_tree.hpp"
#include "module_result.hpp"

// TTK's base modules on any triangulation, each with how long it took and all that it gave.

namespace gale::perf {

template <class Triangulation>
ModuleResult critical_points(const Fields& fields, Triangulation& mesh) {
  ::ttk::ScalarFieldCriticalPoints module;
  prepare(module, fields.threads);
  module.setDomainDimension(mesh.getDimensionality());
  std::vector<std::pair<::ttk::SimplexId, char>> found;
  module.setOutput(&found);
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  result.run.time([&] { module.execute(fields.order.data(), &mesh); });
  std::vector<double> flat;
  for (const auto& [vertex, type] : found) flat.insert(flat.end(), {double(vertex), double(type)});
  result.add("vertices and types", flat);
  return result;
}

template <class Triangulation>
ModuleResult discrete_gradient(const Fields& fields, Triangulation& mesh) {
  ::ttk::dcg::DiscreteGradient module;
  prepare(module, fields.threads);
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  module.setInputScalarField(fields.values.data(), 1);
  module.setInputOffsets(fields.order.data());
  result.run.time([&] { module.buildGradient(mesh, true); });
  std::array<std::vector<::ttk::SimplexId>, 4> critical;
  module.getCriticalPoints(critical, mesh);
  for (int dimension = 0; dimension < 4; ++dimension) {
    result.add("critical of dimension " + std::to_string(dimension), critical[dimension]);
    const auto count = module.getNumberOfCells(dimension, mesh);
    std::vector<double> pairs;
    for (::ttk::SimplexId i = 0; i < count; ++i) {
      for (const bool reverse : {false, true}) {
        pairs.push_back(module.getPairedCell(::ttk::dcg::Cell(dimension, i), mesh, reverse));
      }
    }
    result.add("pairs of dimension " + std::to_string(dimension), pairs);
  }
  return result;
}

/// With the 2-separatrices, too, if there are to be `walls`.
template <bool walls_too, class Triangulation>
ModuleResult morse_smale(const Fields& fields, Triangulation& mesh) {
  ::ttk::MorseSmaleComplex module;
  prepare(module, fields.threads);
  module.setComputeSeparatrices2(walls_too, walls_too);
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  ::ttk::MorseSmaleComplex::OutputCriticalPoints critical;
  ::ttk::MorseSmaleComplex::Output1Separatrices lines;
  ::ttk::MorseSmaleComplex::Output2Separatrices walls;
  std::vector<::ttk::SimplexId> ascending(fields.order.size()), descending(ascending), both(ascending);
  ::ttk::MorseSmaleComplex::OutputManifold manifolds{ascending.data(), descending.data(), both.data()};
  result.run.time(
      [&] { module.execute(critical, lines, walls, manifolds, fields.values.data(), 1, fields.order.data(), mesh); });
  result.add("critical dimensions", critical.cellDimensions_);
  result.add("critical cells", critical.cellIds_);
  result.add("critical on boundary", critical.isOnBoundary_);
  result.add("critical vertices", critical.PLVertexIdentifiers_);
  result.add("manifold sizes", critical.manifoldSize_);
  result.add("line points", lines.pt.points_);
  result.add("line cells", lines.pt.cellIds_);
  result.add("line dimensions", lines.pt.cellDimensions_);
  result.add("line connectivity", lines.cl.connectivity_);
  result.add("line sources", lines.cl.sourceIds_);
  result.add("line destinations", lines.cl.destinationIds_);
  result.add("line types", lines.cl.separatrixTypes_);
  result.add("line boundary", lines.cl.isOnBoundary_);
  result.add("wall points", walls.pt.points_);
  result.add("wall offsets", walls.cl.offsets_);
  result.add("wall connectivity", walls.cl.connectivity_);
  result.add("wall sources", walls.cl.sourceIds_);
  result.add("wall types", walls.cl.separatrixTypes_);
  result.add("ascending manifold", ascending);
  result.add("descending manifold", descending);
  result.add("both manifolds", both);
  return result;
}

/// All pairs by Discrete Morse Sandwich, the essential ones included.
template <class Triangulation>
ModuleResult persistence(const Fields& fields, Triangulation& mesh) {
  ::ttk::DiscreteMorseSandwich module;
  prepare(module, fields.threads);
  module.setComputeMinSad(true);
  module.setComputeSadSad(true);
  module.setComputeSadMax(true);
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  std::vector<::ttk::DiscreteMorseSandwich::PersistencePair> pairs;
  result.run.time([&] {
    module.buildGradient(fields.values.data(), 1, fields.order.data(), mesh);
    module.computePersistencePairs(pairs, fields.order.data(), mesh, false);
    ttk::add_essential_pairs(pairs, fields.values.data(), 1, fields.order.data(), mesh);
  });
  std::vector<std::array<double, 3>> sorted;
  for (const auto& pair : pairs) sorted.push_back({double(pair.type), double(pair.birth), double(pair.death)});
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> flat;
  for (const auto& pair : sorted) flat.insert(flat.end(), pair.begin(), pair.end());
  result.add("pairs", flat);
  return result;
}

template <class Triangulation>
ModuleResult smoother(const Fields& fields, Triangulation& mesh) {
  ::ttk::ScalarFieldSmoother module;
  prepare(module, fields.threads);
  auto values = fields.values, smooth = fields.values;
  module.setDimensionNumber(1);
  module.setInputDataPointer(values.data());
  module.setOutputDataPointer(smooth.data());
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  result.run.time([&] { module.smooth<float>(&mesh, 3); });
  result.add("values", smooth);
  return result;
}

/// The Jacobi set of the field and the square of the distance to the first vertex.
template <class Triangulation>
ModuleResult jacobi_set(const Fields& fields, Triangulation& mesh) {
  ::ttk::JacobiSet module;
  prepare(module, fields.threads);
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  std::vector<float> second(fields.values.size());
  std::vector<::ttk::SimplexId> places(second.size());
  for (std::size_t i = 0; i < second.size(); ++i) {
    float p[3];
    mesh.getVertexPoint(static_cast<::ttk::SimplexId>(i), p[0], p[1], p[2]);
    second[i] = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    places[i] = static_cast<::ttk::SimplexId>(i);
  }
  module.setSosOffsetsU(places.data());
  module.setSosOffsetsV(places.data());
  std::vector<std::pair<::ttk::SimplexId, char>> found;
  result.run.time([&] { module.execute(found, fields.values.data(), second.data(), mesh); });
  std::sort(found.begin(), found.end());
  std::vector<double> flat;
  for (const auto& [edge, type] : found) flat.insert(flat.end(), {double(edge), double(type)});
  result.add("edges and types", flat);
  return result;
}

template <class Triangulation>
ModuleResult path_compression(const Fields& fields, Triangulation& mesh) {
  ::ttk::PathCompression module;
  prepare(module, fields.threads);
  module.setComputeSegmentation(true, true, true);
  std::vector<::ttk::SimplexId> ascending(fields.order.size()), descending(ascending), both(ascending);
  ::ttk::PathCompression::OutputSegmentation segments{ascending.data(), descending.data(), both.data()};
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  result.run.time([&] { module.execute(segments, fields.order.data(), mesh); });
  result.add("ascending", ascending);
  result.add("descending", descending);
  result.add("both", both);
  return result;
}

/// By its name; an empty result for no module's name.
template <class Triangulation>
ModuleResult run_module(const std::string& name, const Fields& fields, Triangulation& mesh) {
  const std::map<std::string, ModuleResult (*)(const Fields&, Triangulation&)> modules = {
      {"contour-tree", [](const Fields& fields, Triangulation& mesh) { return contour_tree(fields, mesh); }},
      {"critical-points", critical_points<Triangulation>},
      {"discrete-gradient", discrete_gradient<Triangulation>},
      {"jacobi-set", jacobi_set<Triangulation>},
      {"morse-smale", morse_smale<false, Triangulation>},
      {"morse-smale-walls", morse_smale<true, Triangulation>},
      {"path-compression", path_compression<Triangulation>},
      {"persistence", persistence<Triangulation>},
      {"smoother", smoother<Triangulation>}};
  const auto found = modules.find(name);
  return found == modules.end() ? ModuleResult() : found->second(fields, mesh);
}

}  // namespace gale::perf
