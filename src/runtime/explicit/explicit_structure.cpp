#include <gale/runtime/explicit/explicit_structure.hpp>

namespace gale {

ExplicitStructure::ExplicitStructure(const Mesh& mesh, RelationSet wanted)
    : Structure(mesh, wanted, Way::explicit_), all_(detail::explicit_relations(mesh, wanted)) {}

Id ExplicitStructure::count(int dimension) const { return all_.count[dimension]; }

std::unique_ptr<Structure::Sweep> ExplicitStructure::begin_sweep(RelationSet wanted, int consumers,
                                                                 const SegmentBody&) {
  class ExplicitSweep : public Sweep {
   public:
    ExplicitSweep(const detail::ExplicitRelations& all, RelationSet wanted, int consumers)
        : Sweep(consumers), all_(all), wanted_(wanted) {}

    void visit(int consumer, Id segment, const SegmentBody& body) override {
      body(consumer, all_.rows(wanted_, segment, all_.intervals_of(segment)));
    }

   private:
    const detail::ExplicitRelations& all_;
    const RelationSet wanted_;
  };
  return std::make_unique<ExplicitSweep>(all_, wanted, consumers);
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
    return structure_.all_.rows(one, no_id, structure_.all_.intervals());
  }

  const ExplicitStructure& structure_;
};

std::unique_ptr<Consumer> ExplicitStructure::consumer() { return std::make_unique<ExplicitConsumer>(*this); }

}  // namespace gale
