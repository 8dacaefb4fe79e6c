#include <gale/relations/explicit_structure.hpp>

#include <gale/base/error.hpp>
#include <gale/relations/detail/global_links.hpp>
#include <gale/relations/detail/sweep.hpp>

namespace gale {

struct ExplicitStructure::Data {
  Mesh mesh;
  RelationSet relations;
  detail::GlobalStars stars;
  detail::GlobalLinks links;

  Data(const Mesh& given, RelationSet wanted) : mesh(given), relations(wanted) {
    const bool with_links = wanted.has(Relation::link);
    stars = detail::global_stars(mesh, with_links || wanted.has(Relation::VV));
    if (with_links) links = detail::global_links(mesh, stars);
    if (!wanted.has(Relation::VV)) stars.vv = {};
    if (!wanted.has(Relation::VT)) stars.vt.ids = {};
  }

  /// The rows of the vertices first to last - 1; those of all lie together, so there is nothing to compute.
  SegmentRows rows(RelationSet wanted, Id segment, Id first, Id last) const {
    SegmentRows rows(segment, {Interval{first, last}});
    if (wanted.has(Relation::VV)) rows.set(Relation::VV, stars.vv.rows());
    if (wanted.has(Relation::VT)) rows.set(Relation::VT, stars.vt.rows());
    if (wanted.has(Relation::link)) rows.set(links.rows(stars.vt.offsets.data()));
    return rows;
  }
};

namespace {

void require_stars(RelationSet wanted) {
  if (star_relations.contains(wanted)) return;
  for (const Relation relation : members_of(wanted)) {
    if (star_relations.has(relation)) continue;
    throw Error("the explicit structure has " + name_of(star_relations) + ", not " + name_of(relation));
  }
}

}  // namespace

ExplicitStructure::ExplicitStructure(const Mesh& mesh, RelationSet wanted) {
  require_stars(wanted);
  data_ = std::make_unique<const Data>(mesh, wanted);
}

ExplicitStructure::~ExplicitStructure() = default;

const Mesh& ExplicitStructure::mesh() const { return data_->mesh; }
RelationSet ExplicitStructure::relations() const { return data_->relations; }

void ExplicitStructure::for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) {
  require_preconditioned(data_->relations, wanted);
  const Id* const begin = data_->mesh.vertex_begin().data();
  detail::sweep(data_->mesh.segments(), options, [&](int consumer, Id segment) {
    body(consumer, data_->rows(wanted, segment, begin[segment], begin[segment + 1]));
  });
}

/// Loads once: all rows.
class ExplicitStructure::ExplicitConsumer : public Consumer {
 public:
  explicit ExplicitConsumer(const ExplicitStructure& structure) : structure_(structure) {}

 private:
  SegmentRows load(Relation relation, Id vertex) override {
    require_preconditioned(structure_.relations(), relation);
    require_simplex(structure_.mesh(), 0, vertex);
    return structure_.data_->rows(relation, no_id, 0, structure_.mesh().vertices());
  }

  const ExplicitStructure& structure_;
};

std::unique_ptr<Consumer> ExplicitStructure::consumer() { return std::make_unique<ExplicitConsumer>(*this); }

}  // namespace gale
