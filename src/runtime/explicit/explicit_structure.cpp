#include <gale/runtime/explicit/explicit_relations.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>

namespace gale {

struct ExplicitStructure::Data {
  detail::ExplicitRelations all;

  /// Rows of the simplices given; those of all lie together, so there is nothing to compute.
  SegmentRows rows(RelationSet wanted, Id segment, const Intervals& simplices) const {
    SegmentRows rows(segment, simplices);
    for (const Relation relation : members_of(wanted)) rows.set(relation, all.rows(relation));
    if (wanted.has_links()) rows.set(all.links());
    return rows;
  }

  Intervals intervals_of(Id segment) const {
    Intervals intervals;
    for (int dimension = 0; dimension < 4; ++dimension) {
      const auto& begin = all.segment_begin[dimension];
      if (begin.extent(0) != 0) intervals[dimension] = {begin(segment), begin(segment + 1)};
    }
    return intervals;
  }

  /// All simplices.
  Intervals intervals() const {
    Intervals intervals;
    for (int dimension = 0; dimension < 4; ++dimension) {
      if (all.count[dimension] != no_id) intervals[dimension] = {0, all.count[dimension]};
    }
    return intervals;
  }
};

ExplicitStructure::ExplicitStructure(const Mesh& mesh, RelationSet wanted)
    : Structure(mesh, wanted, Way::explicit_), data_(new Data{detail::explicit_relations(mesh, wanted)}) {}
ExplicitStructure::~ExplicitStructure() = default;

Id ExplicitStructure::count(int dimension) const { return data_->all.count[dimension]; }

std::unique_ptr<Structure::Sweep> ExplicitStructure::begin_sweep(RelationSet wanted, int consumers,
                                                                 const SegmentBody&) {
  class ExplicitSweep : public Sweep {
   public:
    ExplicitSweep(const Data& data, RelationSet wanted, int consumers)
        : Sweep(consumers), data_(data), wanted_(wanted) {}

    void visit(int consumer, Id segment, const SegmentBody& body) override {
      body(consumer, data_.rows(wanted_, segment, data_.intervals_of(segment)));
    }

   private:
    const Data& data_;
    const RelationSet wanted_;
  };
  return std::make_unique<ExplicitSweep>(*data_, wanted, consumers);
}

/// Loads once: all rows.
class ExplicitStructure::ExplicitConsumer : public Consumer {
 public:
  explicit ExplicitConsumer(const ExplicitStructure& structure) : structure_(structure) {}

 private:
  SegmentRows load(RelationSet one, Id simplex) override {
    require_preconditioned(structure_.relations(), one);
    const int dimension = row_dimension(one);
    require_simplex(structure_.count(dimension), dimension, simplex);
    return structure_.data_->rows(one, no_id, structure_.data_->intervals());
  }

  const ExplicitStructure& structure_;
};

std::unique_ptr<Consumer> ExplicitStructure::consumer() { return std::make_unique<ExplicitConsumer>(*this); }

}  // namespace gale
