#include <gale/baselines/oracle.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>

namespace gale::baselines {

namespace {

class ExplicitOracle : public Oracle {
 public:
  ExplicitOracle(const Mesh& mesh, Relation relation, int threads) : relation_(relation), structure_(mesh, relation) {
    for (int thread = 0; thread < threads; ++thread) consumers_.push_back(structure_.consumer());
  }

  std::string name() const override { return "the explicit structure"; }
  Id rows() const override { return structure_.count(row_dimension(relation_)); }

  void read(Id simplex, int thread, std::vector<Id>& row) override {
    const Row found = consumers_[thread]->row(relation_, simplex);
    row.assign(found.begin(), found.end());
  }

 private:
  Relation relation_;
  ExplicitStructure structure_;
  std::vector<std::unique_ptr<Consumer>> consumers_;
};

}  // namespace

std::unique_ptr<Oracle> make_oracle(const Mesh& mesh, Relation relation, [[maybe_unused]] int threads,
                                    [[maybe_unused]] bool is_explicit) {
#ifdef GALE_ENABLE_KOKKOS_KERNELS
  if (!is_explicit) return std::make_unique<ExplicitOracle>(mesh, relation, threads);
#endif
  return make_brute_force(mesh, relation);
}

}  // namespace gale::baselines
