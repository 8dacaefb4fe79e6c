#include <algorithm>
#include <numeric>

#include <gale/algorithms/merge_tree/assemble.hpp>

namespace gale::detail {

namespace {

CriticalType type_of_node(int lower_arcs, int upper_arcs) {
  if (lower_arcs == 0 && upper_arcs == 1) return CriticalType::minimum;
  if (lower_arcs == 1 && upper_arcs == 0) return CriticalType::maximum;
  if (lower_arcs == 2 && upper_arcs == 1) return CriticalType::saddle1;
  if (lower_arcs == 1 && upper_arcs == 2) return CriticalType::saddle2;
  return CriticalType::degenerate;
}

}  // namespace

MergeTree tree_of(const Mesh& mesh, const std::vector<Id>& nodes, const std::vector<std::pair<Id, Id>>& ends,
                  std::vector<Id>& place) {
  MergeTree tree;
  for (const Id vertex : nodes) tree.vertices.push_back(mesh.vertices_in_input()[vertex]);
  std::vector<Id> sorted(ends.size());
  std::iota(sorted.begin(), sorted.end(), Id(0));
  std::sort(sorted.begin(), sorted.end(), [&](Id a, Id b) { return ends[a] < ends[b]; });
  std::vector<int> lower_arcs(nodes.size(), 0), upper_arcs(nodes.size(), 0);
  place.resize(ends.size());
  for (const Id arc : sorted) {
    place[arc] = static_cast<Id>(tree.arcs.size());
    tree.arcs.push_back({ends[arc].first, ends[arc].second, 0});
    ++upper_arcs[ends[arc].first];
    ++lower_arcs[ends[arc].second];
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) tree.types.push_back(type_of_node(lower_arcs[i], upper_arcs[i]));
  return tree;
}

void set_arcs(MergeTree& tree, std::vector<Id> arc_of) {
  for (const Id vertex : tree.vertices) arc_of[vertex] = no_id;
  const std::vector<Id> sizes =
      sizes_of(tree.arcs.size(), static_cast<Offset>(arc_of.size()), [&](Offset i) { return arc_of[i]; });
  for (std::size_t i = 0; i < tree.arcs.size(); ++i) {
    tree.arcs[i].size = sizes[i];
    arc_of[tree.vertices[tree.arcs[i].lower]] = arc_of[tree.vertices[tree.arcs[i].upper]] = static_cast<Id>(i);
  }
  tree.arc_of = std::move(arc_of);
}

}  // namespace gale::detail
