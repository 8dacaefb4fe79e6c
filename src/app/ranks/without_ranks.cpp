#include <string>

#include <gale/app/ranks/launched_ranks.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

Ranks::Ranks(int&, char**&) {
  if (launched_ranks() == 1) return;
  throw Error("it was started on " + std::to_string(launched_ranks()) +
              " ranks, but built without MPI: build it with GALE_ENABLE_MPI=ON");
}
Ranks::~Ranks() = default;

bool Ranks::are_several() { return false; }
bool Ranks::is_first() { return true; }
int Ranks::threads(int alone) { return alone; }
void Ranks::require_same_arguments(int, char**) {}
void Ranks::end_all(int, bool) {}
bool Ranks::all_fail_alike() { return true; }

void critical_points_on_ranks(const InputOptions&, const CommonOptions&, const SegmentationOptions&,
                              const StructureOption&, const std::string&) {}
void discrete_gradient_on_ranks(const InputOptions&, const CommonOptions&, const SegmentationOptions&,
                                const StructureOption&, const std::string&) {}
void morse_smale_on_ranks(const InputOptions&, const CommonOptions&, const SegmentationOptions&, const StructureOption&,
                          const MorseSmaleParts&, const std::string&) {}

}  // namespace gale::app
