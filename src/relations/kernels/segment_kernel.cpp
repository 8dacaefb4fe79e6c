#include <utility>
#include <variant>

#include <gale/base/error.hpp>
#include <gale/relations/kernels/grid_star_kernel.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/relations/kernels/row_kernel.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/relations/kernels/star_kernel.hpp>
#include <gale/relations/preconditioning.hpp>

namespace gale {

namespace {

/// The kernel of any relation: that of stars, of tetrahedra, triangles or a grid, or the row kernel of one that isn't a
/// star's.
template <class Memory, class Places>
struct AnyKernel;

template <class Memory, std::size_t... places>
struct AnyKernel<Memory, std::index_sequence<places...>> {
  static constexpr bool is_row(std::size_t place) {
    return traits_of(static_cast<Relation>(place)).computed_by != ComputedBy::star_kernel;
  }

  /// The kernel of the relation at a place of the table; where a star kernel makes it, the one of the first, which no
  /// one asks for.
  template <std::size_t place>
  using RowKernelAt = RowKernel<static_cast<Relation>(is_row(place) ? place : 0), Memory>;

  using OrStar =
      std::variant<StarKernel<Memory, 4>, StarKernel<Memory, 3>, GridStarKernel<Memory>, RowKernelAt<places>...>;

  /// Makes `kernel` the row kernel of a relation; set(kernel) is called with it.
  template <class Set>
  static void make_row(Relation relation, OrStar& kernel, const Set& set) {
    ((static_cast<std::size_t>(relation) == places ? set(kernel.template emplace<places + 3>()) : void()), ...);
  }
};

template <class Memory>
using Kernels = AnyKernel<Memory, std::make_index_sequence<relation_count>>;

}  // namespace

std::vector<RelationSet> kernels_for(RelationSet relations, int dimension) {
  const RelationSet stars = star_relations_of(dimension);
  std::vector<RelationSet> kernels;
  for (const Relation relation : members_of(relations - stars)) kernels.push_back(relation);
  if (!(relations & stars).empty()) kernels.push_back(relations & stars);
  return kernels;
}

bool are_there(const Batch<HostMemory>& batch) {
  bool all = true;
  const Offset blocks = batch.relations.count();
  for (Offset i = 0; i < batch.count * blocks; ++i) {
    if (batch.directory[i] == BlockPool::uncountable) {
      throw Error("segment " + std::to_string(batch.segments[i / blocks]) + " has more than 2147483647 entries of " +
                  name_of(batch.relations) + ": use smaller segments");
    }
    all &= batch.directory[i] != BlockPool::missing;
  }
  return all;
}

template <class Memory>
struct SegmentKernel<Memory>::Any {
  Mesh mesh;
  RelationSet wanted;
  typename Kernels<Memory>::OrStar kernel;

  Any(const Mesh& given, RelationSet relations) : mesh(given), wanted(relations) {
    if (makes_stars() && mesh.grid() != nullptr) {
      kernel = GridStarKernel<Memory>(mesh, wanted);
    } else if (makes_stars()) {
      mesh.dimension() == 3 ? make_star<4>() : make_star<3>();
    } else {
      SimplexNeeds needs = needs_of(wanted, mesh.dimension());
      needs.cells = true;
      Kernels<Memory>::make_row(members_of(wanted).front(), kernel, [this, needs](auto& row) {
        row.simplices = mesh.simplices<Memory>(needs);
        row.vertex_begin = mesh.interval_begin<Memory>(0);
      });
    }
  }

  bool makes_stars() const { return star_relations_of(mesh.dimension()).contains(wanted); }

  template <int corners>
  void make_star() {
    StarKernel<Memory, corners> star;
    star.mesh = mesh.encoded<Memory>();
    star.wanted = wanted;
    kernel = star;
  }

  void set(const KernelTask& task) {
    std::visit(
        [&task](auto& one) {
          one.segments = task.segments;
          one.sizes = task.sizes;
          one.scratch_level = task.scratch_level;
          one.pool = task.pool;
        },
        kernel);
  }
};

template <class Memory>
SegmentKernel<Memory>::SegmentKernel(const Mesh& mesh, RelationSet wanted) : any_(new Any(mesh, wanted)) {}
template <class Memory>
SegmentKernel<Memory>::~SegmentKernel() = default;
template <class Memory>
SegmentKernel<Memory>::SegmentKernel(SegmentKernel&&) noexcept = default;
template <class Memory>
SegmentKernel<Memory>& SegmentKernel<Memory>::operator=(SegmentKernel&&) noexcept = default;

template <class Memory>
RelationSet SegmentKernel<Memory>::wanted() const {
  return any_->wanted;
}

template <class Memory>
StarSizes SegmentKernel<Memory>::bound(Id segment) const {
  const auto rows = [&](int dimension) {
    const auto& begin = any_->mesh.interval_begin(dimension);
    return begin(segment + 1) - begin(segment);
  };
  if (any_->makes_stars() && any_->mesh.grid() == nullptr) {
    const int dimension = any_->mesh.dimension();
    const auto& external = any_->mesh.external_begin();
    const Offset touching = external(segment + 1) - external(segment);
    // Its vertices have at most three neighbours for each corner of a tetrahedron there.
    require_ids("neighbours in one segment", 3 * (4 * Offset(rows(dimension)) + 3 * touching) + 2 * Offset(rows(0)));
    return dimension == 3 ? StarKernel<Memory, 4>::bound(rows(0), rows(3), touching, any_->wanted)
                          : StarKernel<Memory, 3>::bound(rows(0), rows(2), touching, any_->wanted);
  }
  return {rows(any_->makes_stars() ? 0 : row_dimension(members_of(any_->wanted).front())), 0, 0, 0};
}

template <class Memory>
std::size_t SegmentKernel<Memory>::scratch_bytes(const StarSizes& sizes, int warps) const {
  return std::visit(
      [&](const auto& kernel) { return gale::scratch_bytes<std::decay_t<decltype(kernel)>>(sizes, warps); },
      any_->kernel);
}

template <class Memory>
void SegmentKernel<Memory>::launch(const Space& instance, const KernelTask& task, int teams, TeamShape shape) {
  any_->set(task);
  std::visit([&](const auto& kernel) { gale::launch(instance, kernel, teams, shape); }, any_->kernel);
}

template <class Memory>
void SegmentKernel<Memory>::run(const KernelTask& task, char* scratch) {
  any_->set(task);
  if constexpr (!is_device_memory<Memory>)
    std::visit([&](const auto& kernel) { kernel(HostTeam(0, scratch)); }, any_->kernel);
}

#define GALE_INSTANTIATE(Space) template class SegmentKernel<MemoryOf<Space>>
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
