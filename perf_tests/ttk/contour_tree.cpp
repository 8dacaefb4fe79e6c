#include "contour_tree.hpp"

#include <FTMTree.h>

#include <algorithm>
#include <array>

namespace gale::perf {

ModuleResult contour_tree(const Fields& fields, ::ttk::AbstractTriangulation& mesh) {
  ::ttk::ftm::FTMTree module;
  prepare(module, fields.threads);
  ModuleResult result;
  result.precondition.time([&] { module.preconditionTriangulation(&mesh); });
  auto values = fields.values;  // a copy: the module wants an array that isn't const
  module.setVertexScalars(values.data());
  module.setVertexSoSoffsets(fields.order.data());
  module.setTreeType(static_cast<int>(::ttk::ftm::TreeType::Contour));
  module.setSegmentation(true);
  result.run.time([&] { module.build<float>(&mesh); });
  auto* const tree = module.getTree(::ttk::ftm::TreeType::Contour);
  std::vector<std::array<double, 3>> arcs;
  for (::ttk::ftm::idSuperArc i = 0; i < tree->getNumberOfSuperArcs(); ++i) {
    const auto* const arc = tree->getSuperArc(i);
    arcs.push_back({double(tree->getNode(arc->getDownNodeId())->getVertexId()),
                    double(tree->getNode(arc->getUpNodeId())->getVertexId()), double(arc->size())});
  }
  std::sort(arcs.begin(), arcs.end());
  std::vector<double> flat;
  for (const auto& arc : arcs) flat.insert(flat.end(), arc.begin(), arc.end());
  result.add("arcs and their vertices", flat);
  return result;
}

}  // namespace gale::perf
