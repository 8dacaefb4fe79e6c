#include <gale/runtime/explicit/explicit_structure.hpp>
#include <gale/runtime/explicit/global_relations.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale {

struct ExplicitStructure::Data {
  Mesh mesh;
  RelationSet relations;
  detail::GlobalRelations global;

  Data(const Mesh& given, RelationSet wanted)
      : mesh(given), relations(wanted), global(detail::global_relations(mesh, wanted)) {}

  /// Rows of the simplices given; those of all lie together, so there is nothing to compute.
  SegmentRows rows(RelationSet wanted, Id segment, const Intervals& simplices) const {
    SegmentRows rows(segment, simplices);
    for (int i = 0; i < relation_count; ++i) {
      const auto relation = static_cast<Relation>(i);
      if (wanted.has(relation) && relation != Relation::link) rows.set(relation, global.rows[i].rows());
    }
    if (wanted.has(Relation::link))
      rows.set(global.links.rows(global.rows[static_cast<int>(Relation::VT)].offsets.data()));
    return rows;
  }

  Intervals intervals_of(Id segment) const {
    Intervals intervals;
    for (int dimension = 0; dimension < 4; ++dimension) {
      const auto& begin = global.segment_begin[dimension];
      if (begin.extent(0) != 0) intervals[dimension] = {begin(segment), begin(segment + 1)};
    }
    return intervals;
  }

  /// All simplices.
  Intervals intervals() const {
    Intervals intervals;
    for (int dimension = 0; dimension < 4; ++dimension) {
      if (global.count[dimension] != no_id) intervals[dimension] = {0, global.count[dimension]};
    }
    return intervals;
  }
};

ExplicitStructure::ExplicitStructure(const Mesh& mesh, RelationSet wanted)
    : data_(std::make_unique<const Data>(mesh, wanted)) {}
ExplicitStructure::~ExplicitStructure() = default;

const Mesh& ExplicitStructure::mesh() const { return data_->mesh; }
RelationSet ExplicitStructure::relations() const { return data_->relations; }
Id ExplicitStructure::count(int dimension) const { return data_->global.count[dimension]; }

void ExplicitStructure::for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) {
  require_preconditioned(data_->relations, wanted);
  detail::sweep(data_->mesh.segments(), options, [&](int consumer, Id segment) {
    body(consumer, data_->rows(wanted, segment, data_->intervals_of(segment)));
  });
}

/// Loads once: all rows.
class ExplicitStructure::ExplicitConsumer : public Consumer {
 public:
  explicit ExplicitConsumer(const ExplicitStructure& structure) : structure_(structure) {}

 private:
  SegmentRows load(Relation relation, Id simplex) override {
    require_preconditioned(structure_.relations(), relation);
    const int dimension = row_dimension(relation);
    require_simplex(structure_.count(dimension), dimension, simplex);
    return structure_.data_->rows(relation, no_id, structure_.data_->intervals());
  }

  const ExplicitStructure& structure_;
};

std::unique_ptr<Consumer> ExplicitStructure::consumer() { return std::make_unique<ExplicitConsumer>(*this); }

}  // namespace gale
