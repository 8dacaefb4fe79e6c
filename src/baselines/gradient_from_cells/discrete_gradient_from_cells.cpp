#include <algorithm>

#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/baselines/gradient_from_cells/cell_sweep.hpp>
#include <gale/baselines/gradient_from_cells/face_look_ups.hpp>

namespace gale {

namespace {

constexpr RelationSet swept = discrete_gradient_from_cells_relations & coboundary_relations;
constexpr RelationSet looked_up = discrete_gradient_from_cells_relations & face_relations;

/// `faces()` makes a consumer's look-ups.
template <class MakeFaces>
void sweep(Structure& structure, detail::GradientStore& store, int consumers, const SweepOptions& options,
           const MakeFaces& faces) {
  using Sweep = detail::CellSweep<decltype(faces())>;
  std::vector<std::unique_ptr<Sweep>> sweeps;
  for (int i = 0; i < consumers; ++i) sweeps.push_back(std::make_unique<Sweep>(store, i, faces()));
  structure.for_each_segment(swept, options,
                             [&](int consumer, const SegmentRows& rows) { sweeps[consumer]->pair(rows); });
}

}  // namespace

DiscreteGradient find_discrete_gradient_from_cells(Structure& structure, const VertexOrder& order,
                                                   const SweepOptions& options) {
  const ThreadLimit limit(options.threads);
  require_preconditioned(structure.relations(), discrete_gradient_from_cells_relations);
  const int consumers = std::max(options.threads, 1);
  const auto store = std::make_shared<detail::GradientStore>(structure.mesh(), order, consumers);
  if (structure.keeps_all_rows()) {
    sweep(structure, *store, consumers, options, [&] { return detail::KeptFaces(structure); });
  } else {
    const auto simplices = structure.mesh().simplices(needs_of(looked_up));
    sweep(structure, *store, consumers, options, [&] { return detail::LookedUpFaces(simplices); });
  }
  store->finish();
  return DiscreteGradient(store);
}

}  // namespace gale
