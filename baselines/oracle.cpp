#include <gale/baselines/brute_force.hpp>
#include <gale/baselines/oracle.hpp>
#include <gale/runtime/make_structure.hpp>

namespace gale::baselines {

namespace {

class ExplicitOracle : public Oracle {
 public:
  ExplicitOracle(const Mesh& mesh, Relation relation, int threads) : relation_(relation) {
    StructureOptions options;
    options.way = Way::explicit_;
    structure_ = make_structure(mesh, relation, options);
    for (int thread = 0; thread < threads; ++thread) consumers_.push_back(structure_->consumer());
  }

  std::string name() const override { return "the explicit structure"; }
  Id rows() const override { return structure_->count(row_dimension(relation_)); }

  void read(Id simplex, int thread, std::vector<Id>& row) override {
    const Row found = consumers_[thread]->row(relation_, simplex);
    row.assign(found.begin(), found.end());
  }

 private:
  Relation relation_;
  std::unique_ptr<Structure> structure_;
  std::vector<std::unique_ptr<Consumer>> consumers_;
};

class BruteForceOracle : public Oracle {
 public:
  BruteForceOracle(const Mesh& mesh, Relation relation)
      : all_(mesh.dimension() == 3 ? BruteForce(mesh.vertices(), cells_of<4>(mesh))
                                   : BruteForce(mesh.vertices(), cells_of<3>(mesh))),
        rows_(all_.rows(relation)) {}

  std::string name() const override { return "brute force"; }
  Id rows() const override { return static_cast<Id>(rows_.size()); }
  void read(Id simplex, int, std::vector<Id>& row) override { row = rows_[simplex]; }

 private:
  template <int corners>
  static std::vector<std::array<Id, corners>> cells_of(const Mesh& mesh) {
    const auto& encoded = mesh.encoded().cells;
    std::vector<std::array<Id, corners>> cells(mesh.cells());
    for (Id t = 0; t < mesh.cells(); ++t) {
      for (int corner = 0; corner < corners; ++corner) cells[t][corner] = encoded(t, corner);
    }
    return cells;
  }

  BruteForce all_;
  const BruteForce::Table& rows_;
};

}  // namespace

std::unique_ptr<Oracle> make_oracle(const Mesh& mesh, Relation relation, [[maybe_unused]] int threads,
                                    [[maybe_unused]] bool is_explicit) {
#ifdef GALE_ENABLE_KOKKOS_KERNELS
  if (!is_explicit) return std::make_unique<ExplicitOracle>(mesh, relation, threads);
#endif
  return std::make_unique<BruteForceOracle>(mesh, relation);
}

}  // namespace gale::baselines
